// SPDX-License-Identifier: BSD-3-Clause
// uvol_info from the outside: what it tells of clouds and volumes, and what it refuses.
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

namespace test_uvol_info {

using uvol_test::runCommand;

class UvolInfo : public testing::Test {
protected:
  uvol_test::CommandResult
  runOn(const std::string& content, const std::string& options = "")
  {
    const std::string file = folder_ / "in.csv";
    uvol_test::writeFile(file, content);
    return runCommand("uvol_info '" + file + "' " + options);
  }

  void
  expectPrinted(const uvol_test::CommandResult& result,
                const std::vector<std::string>& texts) const
  {
    EXPECT_EQ(0, result.exit_code) << result.err;
    for (const auto& text : texts)
      EXPECT_NE(std::string::npos, (result.out + result.err).find(text))
          << text << " in\n"
          << result.out << result.err;
  }

  uvol_test::TemporaryFolder folder_;
};

const std::string cloud = "x,y,z,rho\n500000.5,0,0,1\n500001.5,0,0,2\n500001.5,0,0,3\n"
                          "500003.5,0,0,nan\nnan,0,0,10\n";

TEST_F(UvolInfo, WritesWhatTheSamplingIsLike)
{
  std::string text = "x,y,z,a\n";
  for (int i = 0; i < 20; ++i) // a line, beside a sheet, and something far off
    text += std::to_string(i) + ",0,300,1\n";
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      text += std::to_string(i) + "," + std::to_string(j) + ",0,1\n";
  text += "2000,0,0,1\nnan,0,0,1\n";
  const std::string out = folder_ / "out.csv";
  const auto result = runOn(text, "-out '" + out + "'");
  EXPECT_EQ(0, result.exit_code) << result.err;
  const std::string written = uvol_test::readFile(out);
  EXPECT_NE(std::string::npos, written.find("\n10,0,300,1,line,1,")) << written;
  EXPECT_NE(std::string::npos, written.find("\n10,10,0,1,sheet,1,")) << written;
  EXPECT_NE(std::string::npos, written.find("\n2000,0,0,1,isolated,")) << written;
  EXPECT_NE(std::string::npos, written.find("\n,0,0,1,,,\n")) << written;
  EXPECT_EQ(0, runOn(text, "-threads 1 -out '" + out + "'").exit_code);
  EXPECT_EQ(written, uvol_test::readFile(out));
}

TEST_F(UvolInfo, PrintsRangesSpacingAndWhatIsMissing)
{
  const auto result = runOn(cloud);
  expectPrinted(result,
                {"lower corner: 500000.5 0 0",
                 "upper corner: 500003.5 0 0",
                 "1, 1, 2", // spacing
                 "1 to 10, mean 4, 1 missing",
                 "suggested isovalues",
                 "histogram of rho"});
  EXPECT_EQ("", result.err);
}

TEST_F(UvolInfo, SelectsRowsFieldsAndColumns)
{
  expectPrinted(runOn(cloud, "-where 'rho>=2'"), {"2 to 10", "removed by where"});
  expectPrinted(runOn(cloud, "-field x"), {"histogram of x"});
  expectPrinted(runOn("a,b,c,d\n1,2,3,4\n5,6,7,8\n", "-xyz 1,2,3 -field a"),
                {"lower corner: 2 3 4"});
}

TEST_F(UvolInfo, DegenerateCloudsAreReported)
{
  const auto expectWarning = [&](const std::string& content, const char* code) {
    EXPECT_TRUE(uvol_test::hasMessage(runOn(content, "-json"), code)) << content;
  };
  expectWarning("x,y,z,f\n", "no_points_in_file");
  expectPrinted(runOn("x,y,z,f\n1,2,3,4\n"), {"lower corner: 1 2 3"});
  expectWarning("x,y,z,f\nnan,0,0,4\n0,nan,0,5\n", "no_finite_points");
  expectPrinted(runOn("x,y,z,f\n0,0,0,\n1,0,0,\n"), {"no finite value"});
  expectPrinted(runOn("x,y,z\n0,0,0\n0,0,0\n"), {"duplicates"});
}

/** The numbers x, y and z of points in a line, a sheet or a volume. */
std::string
latticeOf(int width, int height, int depth, double shift)
{
  std::string text;
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < height; ++j)
      for (int k = 0; k < depth; ++k)
        text += std::to_string(i + shift) + "," + std::to_string(j) + "," +
                std::to_string(k) + ",1\n";
  return text;
}

TEST_F(UvolInfo, ReportsTheSharesOfTheSampling)
{
  const std::string header = "x,y,z,a\n";
  expectPrinted(runOn(header + latticeOf(10, 10, 10, 0.0)),
                {"sampling: all around 100 %; spacing 1 to 1\n"});
  const auto mixed =
      runOn(header + latticeOf(8, 8, 8, 0.0) + latticeOf(400, 1, 1, 1000.0));
  expectPrinted(mixed, {"sampling: all around 5", " %, lines 4", " (all around)\n"});
  for (const char* const text : {"0.4,0.4,0.4,1\n", "0.4,0.4,0.4,1\n0.4,0.4,0.4,2\n"}) {
    const auto single = runOn(header + text);
    expectPrinted(single, {"sampling: one position, no spacing\n"});
    EXPECT_EQ(std::string::npos, single.out.find("distance to the nearest"));
  }
}

TEST_F(UvolInfo, CountsPointsWhosePositionIsTheLargestFloat)
{
  for (const char* const place : {"3.4028235e38", "-3.4028235e+38", "1e300"}) {
    const auto result =
        runOn("x,y,z,a\n0,0,0,1\n1,0,0,1\n0,1,0,1\n" + std::string(place) + ",0,0,1\n",
              "-json");
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_EQ((std::vector<double>{1.0, 1.0, 0.0}), report.at("upper_corner"));
    EXPECT_EQ(1, report.at("counts").at("non_finite"));
    EXPECT_EQ(1, uvol_test::warnedValues(report, "points_beyond_float").at("points"));
  }
  uvol_test::expectError(runOn("x,y,z,a\n1e39,0,0,1\n2e39,0,0,1\n", "-json"),
                         "coordinates_beyond_float");
}

TEST_F(UvolInfo, JsonIsOneObject)
{
  const auto result = runOn(cloud, "-json");
  EXPECT_EQ(0, result.exit_code);
  const auto report = nlohmann::json::parse(result.out);
  EXPECT_EQ(report["lower_corner"], (std::vector<double>{500000.5, 0.0, 0.0}));
  EXPECT_EQ(report["spacing"]["max"], 2);
  EXPECT_EQ(report["ranges"]["rho"]["mean"], 4);
  EXPECT_EQ(report["ranges"]["rho"]["missing"], 1);
  EXPECT_EQ(report["histogram"].size(), 16u);
  EXPECT_EQ(report["counts"]["non_finite"], 1);
  const auto unknown = runOn("x,y,z,f\n0,0,0,nan\n1,0,0,inf\n", "-json");
  EXPECT_TRUE(nlohmann::json::parse(unknown.out)["ranges"]["f"]["min"].is_null());
}

TEST_F(UvolInfo, PrintsSeveralFilesBelowTheirNames)
{
  const std::string a = folder_ / "a.csv", b = folder_ / "b.csv";
  uvol_test::writeFile(a, cloud);
  uvol_test::writeFile(b, "x,y,z,t\n0,0,0,7\n1,0,0,8\n");
  const auto alone = runCommand("uvol_info '" + a + "'");
  const auto other = runCommand("uvol_info '" + b + "'");
  const auto both = uvol_test::runWell("uvol_info '" + a + "' '" + b + "'");
  EXPECT_EQ(0u, both.out.find("file: " + a));
  EXPECT_EQ(alone.out + "\n" + other.out, both.out);
}

TEST_F(UvolInfo, JsonOfSeveralFilesIsAnObjectForEach)
{
  const std::string a = folder_ / "a.csv", b = folder_ / "b.csv";
  uvol_test::writeFile(a, cloud);
  uvol_test::writeFile(b, cloud);
  std::istringstream out(runCommand("uvol_info '" + a + "' '" + b + "' -json").out);
  for (const std::string& file : {a, b}) {
    nlohmann::json report;
    out >> report;
    EXPECT_EQ(file, report["file"]);
    EXPECT_EQ(5, report["counts"]["points"]);
  }
}

TEST_F(UvolInfo, FilesBehindOneThatFailsArePrinted)
{
  const std::string good = folder_ / "good.csv", field = folder_ / "other.csv";
  uvol_test::writeFile(good, cloud);
  uvol_test::writeFile(field, "x,y,z,t\n0,0,0,7\n1,0,0,8\n");
  const std::string none = folder_ / "none.csv";
  const auto result =
      runCommand("uvol_info '" + none + "' '" + field + "' '" + good + "' -field rho");
  EXPECT_EQ(1, result.exit_code);
  EXPECT_EQ(runCommand("uvol_info '" + good + "' -field rho").out, result.out);
  EXPECT_EQ(2, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  EXPECT_NE(std::string::npos, result.err.find(none)) << result.err;
  EXPECT_NE(std::string::npos, result.err.find(field)) << result.err;
}

TEST_F(UvolInfo, WritesTheSamplingOfOneFileOnly)
{
  const std::string file = folder_ / "a.csv", out = folder_ / "out.csv";
  uvol_test::writeFile(file, cloud);
  uvol_test::expectError(
      runCommand("uvol_info '" + file + "' '" + file + "' -json -out '" + out + "'"),
      "command_line",
      "-out");
}

TEST_F(UvolInfo, NamesNeedNotBeUtf8)
{
  const std::string latin1 = "x,y,z,T \xb0\n0,0,0,1\n1,0,0,2\n0,1,0,3\n";
  const auto result = runOn(latin1, "-json");
  EXPECT_EQ(0, result.exit_code) << result.err;
  EXPECT_TRUE(nlohmann::json::parse(result.out)["ranges"].contains("T \xef\xbf\xbd"));
  expectPrinted(runOn(latin1), {"T \\xb0"});
}

TEST_F(UvolInfo, NamesMayDifferInABlank)
{
  const auto result =
      runOn("x,y,z,a b,a_b\n0,0,0,1,3\n1,0,0,2,4\n0,1,0,3,5\n", "-json");
  const auto ranges = nlohmann::json::parse(result.out)["ranges"];
  EXPECT_EQ(2, ranges["a b"]["mean"]);
  EXPECT_EQ(4, ranges["a_b"]["mean"]);
}

TEST_F(UvolInfo, RefusesWhatIsWrong)
{
  for (const auto& [options, code, value] :
       {std::tuple("-field mass", "unknown_lone_field", "rho"),
        std::tuple("-where 'mass>1'", "unknown_operand", "mass"),
        std::tuple("-where 'rho>>1'", "operand_missing", "rho>>1"),
        std::tuple("-xyz 0,1", "command_line", "-xyz"),
        std::tuple("-xyz 0,1,1.5", "no_coordinate_column", "1.5"),
        std::tuple("-xyz 0,1,9", "no_coordinate_column", "9"),
        std::tuple("-bins 3", "command_line", "-bins")})
    uvol_test::expectError(runOn(cloud, std::string(options) + " -json"), code, value);
  EXPECT_EQ(2, runCommand("uvol_info").exit_code);
  EXPECT_EQ(1, runCommand("uvol_info none.nhdr").exit_code);
  EXPECT_EQ(1, runCommand("uvol_info none.vtk").exit_code);
}

TEST_F(UvolInfo, DamagedMetaImagesFailQuietly)
{
  const std::string header = "ObjectType = Image\nNDims = 3\nDimSize = 3 2 2\n";
  const std::string type = "ElementType = MET_UCHAR\nElementDataFile = ";
  const std::string files[] = {header + type + "LOCAL\nabc",
                               header + "CompressedData = True\n" + type + "LOCAL\nabc",
                               header + type + "gone.raw\n",
                               "not a volume\n"};
  for (const auto& content : files) {
    const std::string file = folder_ / "in.mha";
    uvol_test::writeFile(file, content);
    const auto result = runCommand("uvol_info '" + file + "'");
    EXPECT_EQ(1, result.exit_code) << content;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  }
}

TEST_F(UvolInfo, DescribesEveryRealVolume)
{
  const std::string data = uvol_test::dataFolder();
  if (data.empty())
    GTEST_SKIP() << "no real data";
  for (const auto& entry : std::filesystem::directory_iterator(data + "/volumes"))
    if (entry.path().extension() == ".nhdr" || entry.path().extension() == ".vtk")
      expectPrinted(runCommand("uvol_info '" + entry.path().string() + "'"),
                    {"size: ", "spacing: 1 1 1", "suggested isovalues"});
}

} // namespace test_uvol_info
