// SPDX-License-Identifier: BSD-3-Clause
// uvol_compare from the outside: distances of known planes, what it writes, refusals.
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace test_uvol_compare {

using Json = nlohmann::json;
using uvol_test::CommandResult;
using uvol_test::readFile;
using uvol_test::runCommand;

/** A triangle of side 1 at a height, with a field. */
std::string
makePly(double height, double value)
{
  const std::string rest = " " + std::to_string(height) + " " + std::to_string(value);
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nproperty float f\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n0 0" +
         rest + "\n1 0" + rest + "\n0 1" + rest + "\n3 0 1 2\n";
}

class CompareTool : public testing::Test {
protected:
  void
  SetUp() override
  {
    uvol_test::writeFile(low_, makePly(0.0, 5.0));
    uvol_test::writeFile(high_, makePly(0.25, 7.0));
  }

  CommandResult
  run(const std::string& arguments) const
  {
    return runCommand("uvol_compare " + arguments);
  }

  uvol_test::TemporaryFolder folder_;
  const std::string low_ = folder_ / "low.ply", high_ = folder_ / "high.ply",
                    out_ = folder_ / "out.ply";
};

TEST_F(CompareTool, PrintsDistancesInBothDirections)
{
  const Json report = uvol_test::jsonOf(run(low_ + " " + high_ + " -json"));
  for (const char* const way : {"a_to_b", "b_to_a"}) {
    for (const char* const name :
         {"mean", "root_mean_square", "percentile_99_9", "largest"})
      EXPECT_NEAR(0.25, report[way][name].get<double>(), 1e-12) << way << name;
    EXPECT_EQ(3u, report[way]["farthest"].size());
    EXPECT_NEAR(
        2.0, report[std::string("fields_") + way]["f"]["mean"].get<double>(), 1e-12);
  }
  EXPECT_EQ(0.25, report["largest_distance"].get<double>());
}

TEST_F(CompareTool, WritesTheDistanceOfVertices)
{
  ASSERT_EQ(0, run(low_ + " " + high_ + " " + out_).exit_code);
  std::vector<pcl_uvol::Triangle> triangles;
  const pcl_uvol::Dataset written = pcl_uvol::loadMesh(out_, triangles);
  EXPECT_EQ(1u, triangles.size());
  // Below what looks upwards.
  EXPECT_EQ((std::vector<double>{-0.25, -0.25, -0.25}),
            uvol_test::fieldOf(written, "distance"));
  EXPECT_EQ((std::vector<double>{5.0, 5.0, 5.0}), uvol_test::fieldOf(written, "f"));
}

TEST_F(CompareTool, WarnsWhereThereAreOnlyPoints)
{
  const std::string points = folder_ / "points.csv";
  uvol_test::writeFile(points, "x,y,z\n0,0,1\n0.25,0.25,3\n");
  const CommandResult result =
      uvol_test::succeeded(run(points + " " + low_ + " " + (folder_ / "out.csv")));
  EXPECT_NE(std::string::npos, result.out.find("a to b: mean 2,")) << result.out;
  EXPECT_TRUE(uvol_test::hasMessage(
      run(points + " " + low_ + " " + (folder_ / "out.csv") + " -json"),
      "no_triangles"));
  EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  EXPECT_NE(std::string::npos, readFile(folder_ / "out.csv").find("distance"));
}

TEST_F(CompareTool, Refuses)
{
  const auto refuses =
      [&](const std::string& arguments, const char* code, const char* value) {
        uvol_test::expectError(run(arguments + " -json"), code, value);
      };
  refuses(low_, "command_line", "<b>");
  refuses(low_ + " " + (folder_ / "none.ply"), "no_such_file", "none.ply");
  refuses(low_ + " " + high_ + " " + low_, "command_line", "low.ply");
  refuses(
      low_ + " " + high_ + " " + (folder_ / "out.csv"), "unwritten_ending", "meshes");
  const std::string cut = folder_ / "cut.ply";
  uvol_test::writeFile(cut, makePly(0.0, 0.0).substr(0, 150));
  refuses(low_ + " " + cut, "missing_part", "cut.ply");
}

/** As many as a stranger's file may have: each is not looked for among all. */
TEST_F(CompareTool, AThousandOfVeryManyFieldsAreListed)
{
  std::string names = "x,y,z", row;
  for (int i = 0; i < 20000; ++i) {
    names += ",f" + std::to_string(i);
    row += ",1";
  }
  const std::string path = folder_ / "many.csv";
  uvol_test::writeFile(path, names + "\n0,0,0" + row + "\n1,0,0" + row + '\n');
  const Json report =
      uvol_test::jsonOf(runCommand("uvol_compare " + path + ' ' + path + " -json"));
  EXPECT_EQ(1000u, report.at("fields_a_to_b").size());
  const Json told = uvol_test::warnedValues(report, "many_common_fields");
  ASSERT_TRUE(told.is_object());
  EXPECT_EQ(20000, told.at("fields"));
  EXPECT_EQ(1000, told.at("listed"));
}

} // namespace test_uvol_compare
