// SPDX-License-Identifier: BSD-3-Clause
// Columns of names on their way through the tools: read, selected, carried to
// isopoints, held out, drawn, and written by every format.
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_labels {

/** Vertical holes in a square of five by five; the value is 10 minus the distance from
 * the middle, so that its level sets are spheres. */
std::string
makeHoles()
{
  std::ostringstream text;
  text << "x,y,z,grade,hole\n";
  for (int column = 0; column < 5; ++column)
    for (int row = 0; row < 5; ++row)
      for (int depth = 0; depth < 30; ++depth) {
        const double x = 2.0 * column, y = 2.0 * row, z = -0.25 * depth;
        text << x << ',' << y << ',' << z << ','
             << 10.0 - std::hypot(x - 4.1, y - 4.2, z + 3.9) << ',';
        if (column == 2) // names that are numbers, as in a table of several campaigns
          text << 34870 + row;
        else
          text << static_cast<char>('A' + column) << "-1" << row;
        text << '\n';
      }
  return text.str();
}

class Labels : public FolderTest {
protected:
  Labels()
  {
    write("holes.csv", makeHoles());
  }

  Dataset
  resultOf(const std::string& command, const std::string& output) const
  {
    const CommandResult result = runTool(command);
    EXPECT_EQ(0, result.exit_code) << command << ": " << result.err;
    return loadDataset(folder_ / output);
  }
};

const std::string iso = "isosurface holes.csv s.ply -iso 7 ";

TEST_F(Labels, AreReadInAlphabeticalOrder)
{
  const Dataset holes = loadDataset(folder_ / "holes.csv");
  ASSERT_EQ(1u, holes.labels.count("hole"));
  const auto& names = holes.labels.at("hole");
  ASSERT_EQ(25u, names.size());
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ("34870", names.front());
  EXPECT_EQ("E-14", names.back());
  EXPECT_TRUE(holes.notes.empty());
}

TEST_F(Labels, SelectPoints)
{
  const auto count = [&](const std::string& where) {
    return resultOf("convert holes.csv b.csv -where '" + where + "'", "b.csv")
        .cloud.width;
  };
  EXPECT_EQ(30u, count("hole=\"A-12\""));
  EXPECT_EQ(30u, count("hole=A-12"));
  EXPECT_EQ(30u, count("hole == 34871"));
  EXPECT_EQ(720u, count("hole!=\"A-12\""));
  EXPECT_EQ(20u, count("(hole=A-12 || hole=\"B-10\") && z>=-2.25"));
  EXPECT_NE(std::string::npos,
            readFile(folder_ / "b.csv").find("B-10")); // and not its number
  expectError("convert holes.csv b.csv -where hole=A-71",
              "unknown_name",
              R"("similar":"A-11")");
  expectError("convert holes.csv b.csv -where 'hole<A-12'", "names_not_compared");
}

TEST_F(Labels, MayHoldQuotationMarks)
{
  writeFile(folder_ / "pipes.csv",
            "x,y,z,pipe\n"
            "1,0,0,\"5\"\" steel\"\n2,0,0,\"5\"\" steel\"\n3,0,0,O'Hara\n");
  for (const auto& [where, count] : {std::pair(R"(pipe='5" steel')", 2u),
                                     std::pair(R"(pipe="5"" steel")", 2u),
                                     std::pair(R"(pipe!="O'Hara")", 2u),
                                     std::pair(R"(pipe='O''Hara' && x>2)", 1u)}) {
    writeFile(folder_ / "where", where);
    EXPECT_EQ(count,
              resultOf("convert pipes.csv b.csv -where \"$(cat where)\"", "b.csv")
                  .cloud.width)
        << where;
  }
  expectError("convert pipes.csv b.csv -where \"pipe='5\"", "quotation_not_closed");
}

TEST_F(Labels, AreCarriedToIsopointsAndWrittenByEveryFormat)
{
  const Dataset table = resultOf("isosurface holes.csv s.csv -iso 7", "s.csv");
  ASSERT_EQ(1u, table.labels.count("hole"));
  EXPECT_GT(table.labels.at("hole").size(), 5u);
  const CommandResult told = runTool(iso + " -json");
  EXPECT_TRUE(uvol_test::hasMessage(told, "numbered_names_listed") ||
              uvol_test::hasMessage(told, "numbered_names"))
      << told.out;
  for (const char* const format : {"s.ply", "s.pcd"}) {
    const Dataset points =
        resultOf(std::string("isosurface holes.csv ") + format + " -iso 7", format);
    EXPECT_EQ(25u, points.labels.at("hole").size()) << format;
    ASSERT_EQ(0, runTool(std::string("convert ") + format + " back.csv").exit_code);
    // The digits of floats are the same in all of them.
    EXPECT_EQ(readFile(folder_ / "s.csv"), readFile(folder_ / "back.csv")) << format;
  }
  ASSERT_EQ(0, runTool("isosurface holes.csv s.vtp -iso 7").exit_code);
  EXPECT_NE(std::string::npos, readFile(folder_ / "s.vtp").find("type=\"String\""));
}

TEST_F(Labels, DoNotDependOnThreadsAndMemory)
{
  ASSERT_EQ(0, runTool(iso + "-threads 1").exit_code);
  const std::string once = readFile(folder_ / "s.ply");
  ASSERT_EQ(0, runTool(iso + "-threads 3").exit_code);
  EXPECT_EQ(once, readFile(folder_ / "s.ply"));
  ASSERT_EQ(0, runTool(iso + "-interpolation fit").exit_code);
  const std::string all = readFile(folder_ / "s.ply");
  ASSERT_EQ(0, runTool(iso + "-interpolation fit -max-memory 500M").exit_code);
  EXPECT_EQ(all, readFile(folder_ / "s.ply"));
}

TEST_F(Labels, AreFoldsOfTheHoldOutTest)
{
  const CommandResult result =
      succeeded(runTool(iso + "-validate 5 -validate-by hole -json"));
  EXPECT_NE(std::string::npos, (result.out + result.err).find("side"));
}

TEST_F(Labels, AreColoursWithALegend)
{
  const CommandResult few =
      succeeded(runTool(iso + "-where 'hole=A-12||hole=B-12||hole=34872||"
                              "hole=D-12||hole=E-12||hole=B-11||hole=D-13' "
                              "-color hole -png a.png -size 256x256 -json"));
  EXPECT_FALSE(hasMessage(few, "repeated_colors")) << few.out;
  succeeded(runTool(iso + "-color hole -png a.png -size 256x256"));
}

TEST_F(Labels, AreListedAndAreNoField)
{
  const CommandResult info = runTool("info holes.csv");
  EXPECT_NE(std::string::npos,
            info.out.find("hole: 25 names: 34870, 34871, 34872, 34873 ... E-14"))
      << info.out;
  // The only candidate is grade, and probes answer numbers.
  const Dataset probed =
      resultOf("probe holes.csv p.csv -field all -grid 3x3x3", "p.csv");
  EXPECT_EQ(0u, probed.labels.count("hole"));
}

} // namespace test_labels
