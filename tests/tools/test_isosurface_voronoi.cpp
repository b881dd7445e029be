// SPDX-License-Identifier: BSD-3-Clause
// uvol_isosurface with neighbours from a discrete Voronoi diagram (thesis 2.1).
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace test_isosurface_voronoi {

using uvol_test::CommandResult;
using uvol_test::readFile;
using uvol_test::runCommand;

/** Samples of 1 - distance to the centre, and where surfaces go. */
class IsosurfaceVoronoi : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder = new uvol_test::TemporaryFolder;
    uvol_test::runWell("uvol_generate " + *folder / "in.pcd" +
                       " -field sphere -n 20000");
  }

  static void
  TearDownTestSuite()
  {
    delete folder;
    folder = nullptr;
  }

  static CommandResult
  run(const std::string& options, const std::string& output = "out.ply")
  {
    return runCommand("uvol_isosurface " + *folder / "in.pcd" + " " + *folder / output +
                      " -field sphere -iso 0 " + options);
  }

  /** Number of points, and the largest distance of one to the unit sphere. */
  static std::pair<std::size_t, double>
  surfaceOf(const std::string& name)
  {
    const auto dataset = pcl_uvol::loadDataset(*folder / name);
    const auto view = pcl_uvol::viewOf(dataset.cloud);
    double largest = 0.0;
    for (std::size_t i = 0; i < view.count; ++i) {
      const float* const x = view.xyz(i);
      largest = std::max(largest, std::abs(std::hypot(x[0], x[1], x[2]) - 1.0));
    }
    return {view.count, largest};
  }

  static void
  expectError(const std::string& options,
              const std::string& code,
              const std::string& value)
  {
    SCOPED_TRACE(options);
    std::remove((*folder / "out.ply").c_str());
    const auto before = folder->list();
    uvol_test::expectError(run(options + " -json"), code, value);
    EXPECT_EQ(before, folder->list());
  }

  static uvol_test::TemporaryFolder* folder;
};

uvol_test::TemporaryFolder* IsosurfaceVoronoi::folder = nullptr;

TEST_F(IsosurfaceVoronoi, IsASphere)
{
  // The sagitta of an edge of half the radius, and a sixth of it.
  constexpr double linear_tolerance = 0.03, smooth_tolerance = 0.005;
  for (const char* grid : {"", "-grid 12", "-grid 40"}) {
    const std::string options = std::string("-neighbors voronoi ") + grid;
    ASSERT_EQ(0, run(options).exit_code) << options;
    const auto smooth = surfaceOf("out.ply");
    EXPECT_GT(smooth.first, 1000u) << options;
    EXPECT_LT(smooth.second, smooth_tolerance) << options;
    ASSERT_EQ(0, run(options + " -interpolation linear").exit_code) << options;
    const auto linear = surfaceOf("out.ply");
    EXPECT_EQ(smooth.first, linear.first);
    EXPECT_LT(linear.second, linear_tolerance) << options;
  }
}

/** Against kept candidates only, more candidates leave more edges. */
TEST_F(IsosurfaceVoronoi, HasAboutTheEdgesOfTheTree)
{
  const auto count = [](const char* neighbors) {
    EXPECT_EQ(0, run(std::string("-criterion all -neighbors ") + neighbors).exit_code);
    return static_cast<double>(surfaceOf("out.ply").first);
  };
  EXPECT_NEAR(1.0, count("voronoi") / count("kdtree"), 0.05);
}

TEST_F(IsosurfaceVoronoi, SameBytesForAnyNumberOfThreads)
{
  for (const char* grid : {"", " -grid 20"}) {
    std::string expected;
    for (const char* threads : {"1", "2", "3", "0"}) {
      uvol_test::succeeded(
          run(std::string("-neighbors voronoi -threads ") + threads + grid));
      if (expected.empty())
        expected = readFile(*folder / "out.ply");
      EXPECT_EQ(expected, readFile(*folder / "out.ply")) << threads << grid;
    }
  }
}

TEST_F(IsosurfaceVoronoi, ScalesAndSmoothsAsWell)
{
  for (const char* option : {"-scale 1,1,2", "-criterion all", "-smooth"}) {
    uvol_test::succeeded(run(std::string("-neighbors voronoi -grid 16 ") + option));
    EXPECT_LT(surfaceOf("out.ply").second, 0.05) << option;
  }
}

TEST_F(IsosurfaceVoronoi, RefusesOtherGrids)
{
  expectError("-grid 20", "command_line", "-neighbors");
  expectError("-grid 20 -neighbors kdtree", "command_line", "-neighbors");
  for (const char* grid : {"0", "-1", "16385", "abc", "8x8x8", "4.5", "''"})
    expectError(
        std::string("-neighbors voronoi -grid ") + grid, "command_line", "-grid");
  expectError("-neighbors delaunay", "command_line", "delaunay");
}

TEST_F(IsosurfaceVoronoi, RefusesGridsThatDoNotFit)
{
  expectError("-neighbors voronoi -grid 16384", "not_enough_memory", "TB");
  expectError("-neighbors voronoi -grid 16384", "not_enough_memory", "16384 x ");
}

} // namespace test_isosurface_voronoi
