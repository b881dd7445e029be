// SPDX-License-Identifier: BSD-3-Clause
// Level sets from the outside: uvol_levelset, and uvol_isosurface -smooth.
#include "common/scalar_field.h"
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace test_uvol_levelset {

using uvol_test::CommandResult;
using uvol_test::runCommand;

/** Noisy samples of a torus of radii 0.65 and 0.25, and where results go. */
class LevelSetTool : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder = new uvol_test::TemporaryFolder;
    ASSERT_EQ(0,
              runCommand("uvol_generate " + *folder / "in.pcd" +
                         " -field torus -n 60000 -noise 0.03")
                  .exit_code);
  }

  static void
  TearDownTestSuite()
  {
    delete folder;
    folder = nullptr;
  }

  static std::string
  path(const std::string& name)
  {
    return *folder / name;
  }

  static CommandResult
  run(const std::string& arguments)
  {
    return runCommand("uvol_levelset " + path("in.pcd") + " " + path("out.ply") +
                      " -field torus " + arguments);
  }

  /** Root mean square distance of a file's points to the torus. */
  static double
  deviation(const std::string& file)
  {
    const auto dataset = pcl_uvol::loadDataset(file);
    const auto view = pcl_uvol::viewOf(dataset.cloud);
    double squares = 0.0;
    for (std::size_t i = 0; i < view.count; ++i) {
      const float* const x = view.xyz(i);
      squares += std::pow(std::hypot(std::hypot(x[0], x[1]) - 0.65, x[2]) - 0.25, 2);
    }
    return std::sqrt(squares / static_cast<double>(view.count));
  }

  static void
  expectError(const std::string& arguments,
              const std::string& code,
              const std::string& value = "")
  {
    SCOPED_TRACE(arguments);
    std::remove(path("out.ply").c_str());
    uvol_test::expectError(run(arguments + " -json"), code, value);
    EXPECT_EQ(std::vector<std::string>{"in.pcd"}, folder->list());
  }

  static uvol_test::TemporaryFolder* folder;
};

uvol_test::TemporaryFolder* LevelSetTool::folder = nullptr;

TEST_F(LevelSetTool, RefusesNonsense)
{
  expectError("", "command_line", "-iso");
  expectError("-iso 0 -mu 1.5", "command_line", "'1.5'");
  expectError("-iso 0 -mu much", "command_line", "-mu");
  expectError("-iso 0 -sphere 0,0,0,1 -box 0,0,0,1,1,1", "command_line", "-sphere");
  expectError("-iso 0 -sphere 0,0,0,-1", "initial_sphere_not_allowed");
  expectError("-iso 0 -scheme cubic", "command_line", "-scheme");
  expectError("-iso 0 -k 5", "few_neighbors_for_scheme", "9");
  expectError("-iso 0 -band 1", "narrow_band");
  expectError("-iso 17", "isovalue_beyond_values", "torus");
  expectError("-iso 0 -start phi", "unknown_lone_field", "\"phi\"");
  expectError("-iso 0 -csv " + path("no/such/folder.csv"), "no_folder", "folder.csv");
  expectError("-iso 0 -plot " + path("plot.jpg"), "unwritten_ending", "plot.jpg");
}

TEST_F(LevelSetTool, WritesPhiBesideEveryField)
{
  const auto report =
      uvol_test::jsonOf(run("-iso 0 -csv " + path("steps.csv") + " -plot " +
                            path("steps.png") + " -json -snapshots 5"));
  EXPECT_EQ(1, report.at("level_set").at("converged"));
  EXPECT_GT(report.at("level_set").at("steps"), 0);
  EXPECT_GT(report.at("mu"), 0.0);
  EXPECT_GT(report.at("sampling").at("volume"), 0.5);
  const auto dataset = pcl_uvol::loadDataset(path("out.ply"));
  EXPECT_EQ(60000u, dataset.cloud.width);
  for (const char* name : {"x", "phi", "torus"})
    EXPECT_NE(nullptr, pcl_uvol::findField(dataset.cloud.fields, name)) << name;
  const std::string table = uvol_test::readFile(path("steps.csv"));
  EXPECT_EQ(0u, table.find("step,time,change,min_slope,max_slope,slope_error,energy"));
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 10);
  EXPECT_EQ("\x89PNG", uvol_test::readFile(path("steps.png")).substr(0, 4));
  EXPECT_LT(deviation(path("out_00010.ply")), 0.03);
  // The zero level of what was written is the smooth surface.
  uvol_test::runWell("uvol_isosurface " + path("out.ply") + " " + path("zero.ply") +
                     " -field phi -iso 0");
  EXPECT_LT(deviation(path("zero.ply")), 0.01);
}

TEST_F(LevelSetTool, SmoothIsosurfacesAreNearerToTheTruth)
{
  const std::string extract = "uvol_isosurface " + path("in.pcd") + " ";
  const std::string field = " -field torus -iso 0 ";
  uvol_test::runWell(extract + path("direct.ply") + field + "-interpolation linear");
  const auto smooth =
      uvol_test::runWell(extract + path("smooth.ply") + field + "-smooth");
  EXPECT_NE(std::string::npos, smooth.out.find("noise: "));
  EXPECT_LT(deviation(path("smooth.ply")), deviation(path("direct.ply")) / 3.0);
  const auto surface = pcl_uvol::loadDataset(path("smooth.ply"));
  EXPECT_NE(nullptr, pcl_uvol::findField(surface.cloud.fields, "torus"));
  const auto two = uvol_test::runWell(extract + path("two.ply") +
                                      " -field torus -iso -0.05,0.05 -smooth -mu 0.1");
  EXPECT_GT(pcl_uvol::loadDataset(path("two.ply")).cloud.width, surface.cloud.width);
  EXPECT_EQ(2, runCommand(extract + path("two.ply") + field + "-mu 0.1").exit_code);
}

TEST_F(LevelSetTool, SaysThatSamplesLieOnLines)
{
  const std::string told = "unconstrained_level_set";
  EXPECT_FALSE(uvol_test::hasMessage(run("-iso 0 -steps 1 -json"), told));
  uvol_test::TemporaryFolder own;
  uvol_test::runWell("uvol_generate " + own / "in.pcd" +
                     " -field torus -n 5000 -samples holes");
  const std::string command = "uvol_levelset " + own / "in.pcd" + " " +
                              own / "out.ply" + " -field torus -iso 0 -steps 1 -json";
  for (const char* const axes : {"", " -scale 1,1,1 -rotate 30,40,10"}) {
    const CommandResult result = uvol_test::runWell(command + axes);
    EXPECT_TRUE(uvol_test::hasMessage(result, told)) << result.out;
  }
}

TEST_F(LevelSetTool, SaysThatItEndedTooEarly)
{
  const auto result = uvol_test::succeeded(run("-iso 0 -steps 2 -json"));
  const auto told =
      uvol_test::warnedValues(nlohmann::json::parse(result.out), "not_converged");
  ASSERT_FALSE(told.is_null()) << result.out;
  EXPECT_EQ(2, told.at("steps"));
}

} // namespace test_uvol_levelset
