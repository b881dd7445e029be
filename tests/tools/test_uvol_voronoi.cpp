// SPDX-License-Identifier: BSD-3-Clause
// uvol_voronoi from the outside: distances and sites, pictures, refusals.
#include "support/environment.h"
#include "support/png.h"
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace test_uvol_voronoi {

using pcl_uvol::Volume;
using uvol_test::CommandResult;
using uvol_test::readFile;
using uvol_test::runCommand;

/** Five points of a box of side 4, of which one is nowhere. */
const std::string corners = "x,y,z\n0,0,0\nnan,0,0\n4,0,0\n0,4,0\n4,4,4\n";

std::string
randomCsv(std::size_t n)
{
  uvol_test::Random random(2);
  std::ostringstream csv;
  csv << "x,y,z\n";
  for (std::size_t i = 0; i < n; ++i)
    for (int axis = 0; axis < 3; ++axis)
      csv << random.uniform() << (axis < 2 ? ',' : '\n');
  return csv.str();
}

class VoronoiTool : public uvol_test::ToolTest {
protected:
  VoronoiTool()
      : ToolTest("uvol_voronoi", "out.vti")
  {
  }

  void
  SetUp() override
  {
    uvol_test::writeFile(in_, corners);
  }

  Volume
  distances(const std::string& options) const
  {
    expectSuccess(options);
    return pcl_uvol::loadVolume(out_);
  }

  /** The array site of the output, which becomes the active one. */
  Volume
  sites() const
  {
    std::string file = readFile(out_);
    const std::string active = "Scalars=\"distance\"";
    const std::size_t at = file.find(active);
    EXPECT_NE(std::string::npos, at);
    if (at != std::string::npos)
      uvol_test::writeFile(out_, file.replace(at, active.size(), "Scalars=\"site\""));
    return pcl_uvol::loadVolume(out_);
  }

  std::string picture_ = folder_ / "out.png";
};

TEST_F(VoronoiTool, FindsTheNearestPointOfEveryCell)
{
  const Volume distance = distances("-grid 4");
  EXPECT_EQ("distance", distance.name);
  EXPECT_EQ((std::array<std::size_t, 3>{{4, 4, 4}}), distance.dims);
  EXPECT_EQ((std::array<double, 3>{{0.5, 0.5, 0.5}}), distance.origin);
  const Volume site = sites();
  ASSERT_EQ(distance.values.size(), site.values.size());
  // The points' cells by their indices in the file.
  const std::pair<int, std::array<int, 3>> filled[] = {
      {0, {{0, 0, 0}}}, {2, {{3, 0, 0}}}, {3, {{0, 3, 0}}}, {4, {{3, 3, 3}}}};
  for (int i = 0; i < 64; ++i) {
    double least = 1e9, of_site = -1.0;
    for (const auto& [point, cell] : filled) {
      const double away =
          std::hypot(i % 4 - cell[0], i / 4 % 4 - cell[1], i / 16 - cell[2]);
      least = std::min(least, away);
      if (site.values[static_cast<std::size_t>(i)] == static_cast<float>(point))
        of_site = away;
    }
    EXPECT_FLOAT_EQ(static_cast<float>(least),
                    distance.values[static_cast<std::size_t>(i)]);
    EXPECT_FLOAT_EQ(static_cast<float>(least), static_cast<float>(of_site));
  }
}

TEST_F(VoronoiTool, TakesCubesOrBoxes)
{
  uvol_test::writeFile(in_, "x,y,z\n0,0,0\n4,2,1\n");
  const Volume cubes = distances("-grid 128");
  EXPECT_EQ((std::array<std::size_t, 3>{{128, 64, 32}}), cubes.dims);
  EXPECT_EQ(cubes.values, distances("").values); // the default
  const Volume boxes = distances("-grid 16x8x20");
  EXPECT_EQ((std::array<std::size_t, 3>{{16, 8, 20}}), boxes.dims);
  EXPECT_DOUBLE_EQ(0.25, boxes.spacing[1]);
  EXPECT_DOUBLE_EQ(0.05, boxes.spacing[2]);
}

TEST_F(VoronoiTool, MarginsSurroundTheBox)
{
  const Volume distance = distances("-grid 4 -margin 3");
  EXPECT_EQ((std::array<std::size_t, 3>{{10, 10, 10}}), distance.dims);
  EXPECT_DOUBLE_EQ(-2.5, distance.origin[0]);
  EXPECT_DOUBLE_EQ(1.0, distance.spacing[0]);
  // A point on the upper side of the box is in the cell beyond.
  EXPECT_EQ(0.0f, distance.values[3 * 100 + 3 * 10 + 3]);
  EXPECT_EQ(0.0f, distance.values[3 * 100 + 3 * 10 + 7]);
  EXPECT_FLOAT_EQ(std::sqrt(27.0f), distance.values[0]);
  EXPECT_FLOAT_EQ(std::sqrt(12.0f), distance.values.back());
}

TEST_F(VoronoiTool, KeepsThePlaceOfFarPoints)
{
  uvol_test::writeFile(in_, "x,y,z\n5500000.25,0,-3000000\n5500004.25,4,-2999996\n");
  const Volume distance = distances("-grid 4");
  EXPECT_DOUBLE_EQ(5500000.75, distance.origin[0]);
  EXPECT_DOUBLE_EQ(-2999999.5, distance.origin[2]);
  EXPECT_EQ(1.0, distance.spacing[0]);
}

TEST_F(VoronoiTool, ConesAgreeWithTheTransform)
{
  uvol_test::writeFile(in_, randomCsv(150));
  const auto exact = distances("-grid 32").values;
  const auto drawn =
      distances("-grid 32 -method cones -backend osmesa -inner-radius 3 -triangles 8")
          .values;
  ASSERT_EQ(exact.size(), drawn.size());
  std::size_t same = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    same += exact[i] == drawn[i];
    EXPECT_GE(drawn[i], exact[i]);
  }
  EXPECT_GE(static_cast<double>(same), 0.95 * static_cast<double>(exact.size()));
}

TEST_F(VoronoiTool, DrawsSlices)
{
  uvol_test::writeFile(in_, randomCsv(50));
  const auto draw = [&](const std::string& options) {
    uvol_test::succeeded(run("-grid 30x15x10 -png " + picture_ + " " + options));
    int channels = 0;
    return uvol_test::readPng(picture_, channels);
  };
  const auto six = draw("");
  EXPECT_GT(six.width, 900u); // three slices of 300 x 150 in a row, two rows
  EXPECT_LT(six.width, 950u);
  EXPECT_GT(six.height, 300u);
  EXPECT_LT(six.height, 350u);
  const auto one = draw("-slices 1 -axis y");
  EXPECT_EQ(300u, one.width);
  EXPECT_EQ(100u, one.height);
  EXPECT_EQ(200u, draw("-slices 1 -axis x").height);
}

TEST_F(VoronoiTool, PrintsCountsAndShape)
{
  const auto text = run("-grid 4");
  EXPECT_NE(std::string::npos, text.out.find("4 x 4 x 4 cells of 1 x 1 x 1"));
  const auto json = uvol_test::succeeded(run("-grid 4 -json"));
  EXPECT_EQ('{', json.out.front());
  for (const char* part : {"\"points\": 5",
                           "\"non_finite\": 1",
                           "\"cells\": 64",
                           "\"sites\": 4",
                           "\"grid\"",
                           "\"warnings\": []"})
    EXPECT_NE(std::string::npos, json.out.find(part)) << part << json.out;
}

TEST_F(VoronoiTool, SameBytesForAnyNumberOfThreads)
{
  uvol_test::writeFile(in_, randomCsv(3000));
  std::string file, picture;
  for (const char* threads : {"1", "2", "3"}) {
    uvol_test::succeeded(run("-grid 60 -png " + picture_ + " -threads " + threads));
    if (file.empty()) {
      file = readFile(out_);
      picture = readFile(picture_);
    }
    EXPECT_EQ(file, readFile(out_)) << threads;
    EXPECT_EQ(picture, readFile(picture_)) << threads;
  }
}

TEST_F(VoronoiTool, OnePointIsOneRegion)
{
  uvol_test::writeFile(in_, "x,y,z\n3,4,5\n");
  const Volume distance = distances("-grid 3 -margin 1");
  EXPECT_EQ(0.0f, *std::min_element(distance.values.begin(), distance.values.end()));
  for (const float index : sites().values)
    EXPECT_EQ(0.0f, index);
}

TEST_F(VoronoiTool, RefusesOtherGrids)
{
  for (const char* grid : {"0",
                           "abc",
                           "3x4",
                           "1x2x3x4",
                           "99999",
                           "16385",
                           "99999999999999999999",
                           "5x",
                           "x5",
                           "x",
                           "5xx5",
                           "5x5x",
                           "5x5x0",
                           "4.5",
                           "-3",
                           "'5 '",
                           "''"})
    expectError(std::string("-grid ") + grid, "command_line", "-grid");
}

TEST_F(VoronoiTool, RefusesGridsThatDoNotFit)
{
  expectError("-grid 16384", "not_enough_memory", "53 TB");
  expectError("-grid 16384x16384x16384", "not_enough_memory", "53 TB");
  expectError("-grid 16384 -margin 1000", "grid_cells_out_of_range", "16384");
}

TEST_F(VoronoiTool, RefusesWrongCommandLines)
{
  expectUsageErrors("",
                    {"-slices 3",
                     "-axis x",
                     "-margin 2 -grid 4x4x4",
                     "-margin 1001",
                     "-margin -1",
                     "-method magic",
                     "-backend cuda",
                     "-inner-radius 0.5",
                     "-triangles 2",
                     "-wat",
                     "more"});
  expectUsageErrors("-method cones ", {"-device 0"});
  expectUsageErrors("-png " + picture_ + " ", {"-slices 0", "-axis w"});
  expectError("-method cones -backend egl -device 999", "egl_without_context", "999");
  expectError("-png " + (folder_ / "out.jpg"), "unwritten_ending", ".png");
}

TEST_F(VoronoiTool, RefusesOtherFiles)
{
  out_ = folder_ / "out.vtk";
  expectError("", "unwritten_ending", ".vti");
  out_ = folder_ / "no/such/out.vti";
  expectError("", "no_folder", "out.vti");
  out_ = folder_ / "out.vti";
  uvol_test::writeFile(in_, "x,y,z\nnan,0,0\n0,nan,0\n");
  expectError("", "input_without_point");
  uvol_test::writeFile(in_, "x,y,z\n");
  expectError("", "no_points");
  in_ = folder_ / "missing.csv";
  expectError("", "no_such_file", "missing.csv");
}

} // namespace test_uvol_voronoi
