// SPDX-License-Identifier: BSD-3-Clause
// Level sets from the outside: uvol_levelset, and uvol_isosurface -smooth.
#include "common/scalar_field.h"
#include "support/environment.h"
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
  expectRefused(const std::string& arguments,
                int exit_code,
                const std::string& sentence)
  {
    std::remove(path("out.ply").c_str());
    const auto result = run(arguments);
    EXPECT_EQ(exit_code, result.exit_code) << arguments;
    EXPECT_NE(std::string::npos, result.err.find(sentence))
        << arguments << ": " << result.err;
    EXPECT_EQ(std::vector<std::string>{"in.pcd"}, folder->list()) << arguments;
  }

  static uvol_test::TemporaryFolder* folder;
};

uvol_test::TemporaryFolder* LevelSetTool::folder = nullptr;

TEST_F(LevelSetTool, RefusesNonsense)
{
  expectRefused("", 2, "-iso is missing");
  expectRefused("-iso 0 -mu 1.5", 2, "-mu takes auto or a number from 0 to 1");
  expectRefused("-iso 0 -mu much", 2, "-mu");
  expectRefused("-iso 0 -sphere 0,0,0,1 -box 0,0,0,1,1,1", 2, "Only one of -sphere");
  expectRefused("-iso 0 -sphere 0,0,0,-1", 1, "positive radius");
  expectRefused("-iso 0 -scheme cubic", 2, "-scheme");
  expectRefused("-iso 0 -k 5", 1, "at least 9");
  expectRefused("-iso 0 -band 1", 1, "at least 3 spacings");
  expectRefused("-iso 17", 1, "does not separate the values of torus");
  expectRefused("-iso 0 -start phi", 1, "phi");
  expectRefused("-iso 0 -csv " + path("no/such/folder.csv"), 1, "folder.csv");
  expectRefused("-iso 0 -plot " + path("plot.jpg"), 1, "plot.jpg");
}

TEST_F(LevelSetTool, WritesPhiBesideEveryField)
{
  const auto result = run("-iso 0 -csv " + path("steps.csv") + " -plot " +
                          path("steps.png") + " -snapshots 5");
  ASSERT_EQ(0, result.exit_code) << result.err;
  EXPECT_NE(std::string::npos, result.out.find("at the smallest expected error after"));
  EXPECT_NE(std::string::npos, result.out.find("sampling: all around"));
  EXPECT_NE(std::string::npos, result.out.find("automatic: the last of a series"));
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
  ASSERT_EQ(0,
            runCommand("uvol_isosurface " + path("out.ply") + " " + path("zero.ply") +
                       " -field phi -iso 0")
                .exit_code);
  EXPECT_LT(deviation(path("zero.ply")), 0.01);
}

TEST_F(LevelSetTool, SmoothIsosurfacesAreNearerToTheTruth)
{
  const std::string extract = "uvol_isosurface " + path("in.pcd") + " ";
  const std::string field = " -field torus -iso 0 ";
  ASSERT_EQ(0,
            runCommand(extract + path("direct.ply") + field + "-interpolation linear")
                .exit_code);
  const auto smooth = runCommand(extract + path("smooth.ply") + field + "-smooth");
  ASSERT_EQ(0, smooth.exit_code) << smooth.err;
  EXPECT_NE(std::string::npos, smooth.out.find("noise: "));
  EXPECT_LT(deviation(path("smooth.ply")), deviation(path("direct.ply")) / 3.0);
  const auto surface = pcl_uvol::loadDataset(path("smooth.ply"));
  EXPECT_NE(nullptr, pcl_uvol::findField(surface.cloud.fields, "torus"));
  const auto two = runCommand(extract + path("two.ply") +
                              " -field torus -iso -0.05,0.05 -smooth -mu 0.1");
  ASSERT_EQ(0, two.exit_code) << two.err;
  EXPECT_GT(pcl_uvol::loadDataset(path("two.ply")).cloud.width, surface.cloud.width);
  EXPECT_EQ(2, runCommand(extract + path("two.ply") + field + "-mu 0.1").exit_code);
}

TEST_F(LevelSetTool, SaysThatSamplesLieOnLines)
{
  const std::string told = "are between lines of samples or next to gaps";
  EXPECT_EQ(std::string::npos, run("-iso 0 -steps 1").err.find(told));
  uvol_test::TemporaryFolder own;
  ASSERT_EQ(0,
            runCommand("uvol_generate " + own / "in.pcd" +
                       " -field torus -n 5000 -samples holes")
                .exit_code);
  const std::string command = "uvol_levelset " + own / "in.pcd" + " " +
                              own / "out.ply" + " -field torus -iso 0 -steps 1";
  for (const char* const axes : {"", " -scale 1,1,1 -rotate 30,40,10"}) {
    const CommandResult result = runCommand(command + axes);
    EXPECT_EQ(0, result.exit_code);
    EXPECT_NE(std::string::npos, result.err.find(told)) << result.err;
  }
}

TEST_F(LevelSetTool, SaysThatItEndedTooEarly)
{
  const auto result = run("-iso 0 -steps 2");
  EXPECT_EQ(0, result.exit_code);
  EXPECT_NE(std::string::npos,
            (result.out + result.err).find("has not converged by step 2"));
}

} // namespace test_uvol_levelset
