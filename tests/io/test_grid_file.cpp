// SPDX-License-Identifier: BSD-3-Clause
// Voronoi diagrams as image files: what is written is what the diagram says.
#include "io/grid_file.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <numeric>

namespace test_grid_file {

using pcl_uvol::GridShape;
using pcl_uvol::saveVoronoiGrid;
using pcl_uvol::VoronoiGrid;
using uvol_test::readFile;

constexpr std::size_t points = 40;

/** Random points in a box of 4 x 2 x 1; several of them in some cells. */
VoronoiGrid
makeGrid(const std::array<std::uint32_t, 3>& cells)
{
  uvol_test::Random random(3);
  std::vector<float> xyz;
  for (std::size_t i = 0; i < points; ++i)
    for (const double side : {4.0, 2.0, 1.0})
      xyz.push_back(static_cast<float>(side * random.uniform()));
  std::vector<std::uint32_t> all(points);
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::FeatureTransform way;
  pcl_uvol::Report report;
  return VoronoiGrid(GridShape::boxes({{0.0, 0.0, 0.0}}, {{4.0, 2.0, 1.0}}, cells),
                     xyz.data(),
                     3,
                     all,
                     way,
                     1,
                     report);
}

/** Makes another array the one that loadVolume reads. */
void
activate(const std::string& path, const std::string& array)
{
  std::string file = readFile(path);
  const std::string active = "Scalars=\"distance\"";
  const std::size_t at = file.find(active);
  ASSERT_NE(std::string::npos, at);
  uvol_test::writeFile(path,
                       file.replace(at, active.size(), "Scalars=\"" + array + "\""));
}

void
expectGridIn(const std::string& path,
             const VoronoiGrid& grid,
             const std::array<double, 3>& origin)
{
  const GridShape& shape = grid.getShape();
  const auto distance = pcl_uvol::loadVolume(path);
  EXPECT_EQ("distance", distance.name);
  EXPECT_EQ(grid.computeDistances(1), distance.values);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(shape.cells[axis], distance.dims[axis]);
    EXPECT_DOUBLE_EQ(shape.spacing[axis], distance.spacing[axis]);
    EXPECT_DOUBLE_EQ(shape.centerOf({{0, 0, 0}})[axis] + origin[axis],
                     distance.origin[axis]);
  }
  activate(path, "site");
  const auto site = pcl_uvol::loadVolume(path);
  ASSERT_EQ(shape.size(), site.values.size());
  for (std::size_t i = 0; i < site.values.size(); ++i)
    ASSERT_EQ(static_cast<float>(*grid.getMembers()[grid.getNearest()[i]].begin()),
              site.values[i])
        << i;
}

TEST(GridFile, HoldsSitesAndDistances)
{
  const uvol_test::TemporaryFolder folder;
  for (const auto& cells : {std::array<std::uint32_t, 3>{{16, 8, 4}}, {{3, 5, 70}}})
    for (const double far : {0.0, 5500000.25}) {
      const VoronoiGrid grid = makeGrid(cells);
      EXPECT_LT(grid.getSites().size(), points);
      saveVoronoiGrid(folder / "grid.vti", grid, {{far, -far, 0.0}});
      expectGridIn(folder / "grid.vti", grid, {{far, -far, 0.0}});
    }
  EXPECT_EQ(std::vector<std::string>{"grid.vti"}, folder.list());
}

TEST(GridFile, GridsMayBeFlat)
{
  const uvol_test::TemporaryFolder folder;
  for (const auto& cells :
       {std::array<std::uint32_t, 3>{{6, 7, 1}}, {{1, 1, 9}}, {{1, 1, 1}}}) {
    const VoronoiGrid grid = makeGrid(cells);
    saveVoronoiGrid(folder / "flat.vti", grid, {{0.0, 0.0, 0.0}});
    expectGridIn(folder / "flat.vti", grid, {{0.0, 0.0, 0.0}});
  }
}

TEST(GridFile, ThreadsDoNotCount)
{
  const uvol_test::TemporaryFolder folder;
  const VoronoiGrid grid = makeGrid({{40, 30, 20}});
  saveVoronoiGrid(folder / "1.vti", grid, {{0.0, 0.0, 0.0}}, 1);
  for (const unsigned threads : {0u, 2u, 3u}) {
    saveVoronoiGrid(folder / "n.vti", grid, {{0.0, 0.0, 0.0}}, threads);
    EXPECT_EQ(readFile(folder / "1.vti"), readFile(folder / "n.vti")) << threads;
  }
}

TEST(GridFile, OtherNamesAreRefused)
{
  const uvol_test::TemporaryFolder folder;
  const VoronoiGrid grid = makeGrid({{4, 4, 4}});
  for (const char* name : {"grid.vtk", "grid", "grid.vti.gz", "no/such.vti", ""}) {
    EXPECT_THROW(pcl_uvol::checkGridPath(folder / name), pcl_uvol::IOError) << name;
    EXPECT_THROW(saveVoronoiGrid(folder / name, grid, {{0.0, 0.0, 0.0}}),
                 pcl_uvol::IOError)
        << name;
  }
  pcl_uvol::checkGridPath(folder / "grid.VTI");
  EXPECT_TRUE(folder.list().empty());
}

} // namespace test_grid_file
