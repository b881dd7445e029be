// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams against brute force.
#include "common/random.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace test_voronoi_grid {

using pcl_uvol::FeatureTransform;
using pcl_uvol::GridCell;
using pcl_uvol::GridShape;
using pcl_uvol::InvalidArgument;
using pcl_uvol::no_site;
using pcl_uvol::Report;
using pcl_uvol::uniformAt;
using pcl_uvol::VoronoiGrid;

/** About that many random cells, in order. */
std::vector<GridCell>
randomSites(const GridShape& shape, double number, std::uint64_t seed)
{
  std::vector<GridCell> sites;
  for (std::uint64_t i = 0; i < shape.size(); ++i)
    if (uniformAt(seed, i, 0) * static_cast<double>(shape.size()) < number)
      sites.push_back(shape.cellOf(i));
  return sites;
}

/** Spacings are whole numbers, or their squares are: no rounding. */
std::vector<std::uint32_t>
nearestByBruteForce(const GridShape& shape, const std::vector<GridCell>& sites)
{
  std::vector<std::uint32_t> nearest(shape.size(), no_site);
  for (std::uint64_t i = 0; i < shape.size(); ++i) {
    const GridCell cell = shape.cellOf(i);
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t site = 0; site < sites.size(); ++site) {
      double sq_dist = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int along = static_cast<int>(cell[axis]) - sites[site][axis];
        sq_dist += shape.spacing[axis] * shape.spacing[axis] * along * along;
      }
      if (sq_dist < least) {
        least = sq_dist;
        nearest[i] = site;
      }
    }
  }
  return nearest;
}

std::vector<std::uint32_t>
transform(const GridShape& shape,
          const std::vector<GridCell>& sites,
          unsigned threads = 0)
{
  Report report;
  return FeatureTransform().find(shape, sites, threads, report);
}

struct Case {
  std::array<std::uint32_t, 3> cells;
  std::array<double, 3> spacing;
};

class FeatureTransforms : public testing::TestWithParam<Case> {};

TEST_P(FeatureTransforms, EqualBruteForceTiesIncluded)
{
  GridShape shape;
  shape.cells = GetParam().cells;
  shape.spacing = GetParam().spacing;
  for (const double number : {1.0, 2.0, 5.0, 40.0, 300.0})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const auto sites = randomSites(shape, number, seed);
      EXPECT_EQ(nearestByBruteForce(shape, sites), transform(shape, sites))
          << sites.size() << " sites, seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         FeatureTransforms,
                         testing::Values(Case{{{13, 9, 11}}, {{1, 1, 1}}},
                                         Case{{{32, 8, 8}}, {{0.5, 0.5, 0.5}}},
                                         Case{{{9, 12, 10}}, {{1, 2, 3}}},
                                         Case{{{9, 12, 10}}, {{4, 1, 2}}},
                                         Case{{{33, 17, 1}}, {{1, 1, 1}}},
                                         Case{{{1, 1, 40}}, {{1, 1, 1}}},
                                         Case{{{1, 40, 1}}, {{7, 7, 7}}},
                                         Case{{{40, 1, 1}}, {{1, 1, 1}}},
                                         Case{{{1, 1, 1}}, {{1, 1, 1}}}));

TEST(FeatureTransform, KnowsEmptyFullAndSingleSites)
{
  GridShape shape;
  shape.cells = {{5, 6, 7}};
  for (const std::uint32_t nearest : transform(shape, {}))
    EXPECT_EQ(no_site, nearest);
  const auto all = randomSites(shape, 1e9, 1);
  ASSERT_EQ(shape.size(), all.size());
  std::vector<std::uint32_t> own(shape.size());
  std::iota(own.begin(), own.end(), 0u);
  EXPECT_EQ(own, transform(shape, all));
  for (const std::uint32_t nearest : transform(shape, {{{4, 5, 6}}}))
    EXPECT_EQ(0u, nearest);
}

/** Ratios that no whole numbers have: only near ties may be decided otherwise. */
TEST(FeatureTransform, IsNearestForAnySpacing)
{
  GridShape shape;
  shape.cells = {{15, 14, 13}};
  for (const auto& spacing : {std::array<double, 3>{{0.1, 0.31, 1.7}},
                              std::array<double, 3>{{1e3, 1e-2, 1.0}},
                              std::array<double, 3>{{1.0, 1.0, 3e-9}},
                              std::array<double, 3>{{1.0, 1.3, 6e-12}},
                              std::array<double, 3>{{1e-30, 1.0, 3e-30}},
                              std::array<double, 3>{{1e-9, 1.0, 1e-25}},
                              std::array<double, 3>{{1e-20, 3e-20, 2e-20}}}) {
    shape.spacing = spacing;
    const auto sites = randomSites(shape, 30, 8);
    const auto expected = nearestByBruteForce(shape, sites);
    const auto nearest = transform(shape, sites);
    for (std::uint64_t i = 0; i < shape.size(); ++i) {
      const GridCell cell = shape.cellOf(i);
      const double least = shape.distance(cell, sites[expected[i]]);
      EXPECT_LE(shape.distance(cell, sites[nearest[i]]), least * (1.0 + 1e-5));
    }
  }
}

TEST(FeatureTransform, DoesNotDependOnThreads)
{
  GridShape shape;
  shape.cells = {{70, 45, 33}};
  const auto sites = randomSites(shape, 500, 3);
  const auto first = transform(shape, sites, 1);
  for (const unsigned threads : {2u, 3u, 7u})
    EXPECT_EQ(first, transform(shape, sites, threads)) << threads;
}

TEST(GridShape, CubesCoverTheBox)
{
  const GridShape shape = GridShape::cubes({{-1, 0, 2}}, {{3, 1, 2}}, 8, 2);
  EXPECT_EQ((std::array<std::uint32_t, 3>{{12, 6, 5}}), shape.cells);
  for (const double side : shape.spacing)
    EXPECT_DOUBLE_EQ(0.5, side);
  EXPECT_DOUBLE_EQ(-2.0, shape.origin[0]);
  EXPECT_DOUBLE_EQ(-1.0, shape.origin[1]);
  EXPECT_DOUBLE_EQ(0.75, shape.origin[2]);
  // A side that is 0.1 * 3 long has 3 cells of 0.1.
  EXPECT_EQ(3u, GridShape::cubes({{0, 0, 0}}, {{0.1 * 3, 0.1 * 3, 0.3}}, 3).cells[1]);
  EXPECT_EQ(1u, GridShape::cubes({{5, 5, 5}}, {{5, 5, 5}}, 1).size());
}

TEST(GridShape, BoxesFillTheBox)
{
  const GridShape shape = GridShape::boxes({{0, 0, 1}}, {{10, 5, 1}}, {{4, 5, 2}});
  EXPECT_EQ((std::array<double, 3>{{2.5, 1.0, 5.0}}), shape.spacing);
  EXPECT_DOUBLE_EQ(-4.0, shape.origin[2]);
  EXPECT_EQ((GridCell{{3, 4, 1}}), shape.cellAt({{10, 5, 1.5}}));
  EXPECT_EQ((GridCell{{0, 0, 0}}), shape.cellAt({{-7, 0.5, -1e9}}));
  EXPECT_DOUBLE_EQ(std::hypot(2.5 * 2, 3.0, 5.0),
                   shape.distance({{3, 1, 0}}, {{1, 4, 1}}));
}

TEST(GridShape, RefusesWhatIsNoGrid)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(GridShape::cubes({{0, 0, 0}}, {{1, 1, 1}}, 0), InvalidArgument);
  EXPECT_THROW(GridShape::cubes({{0, 0, 0}}, {{1, 1, 1}}, 16385), InvalidArgument);
  EXPECT_THROW(GridShape::cubes({{0, 0, 0}}, {{1, 1, 1}}, 16384, 1), InvalidArgument);
  EXPECT_THROW(GridShape::cubes({{0, 0, 0}}, {{1, infinity, 1}}, 4), InvalidArgument);
  EXPECT_THROW(GridShape::cubes({{0, 2, 0}}, {{1, 1, 1}}, 4), InvalidArgument);
  EXPECT_THROW(GridShape::boxes({{0, 0, 0}}, {{1, 1, 1}}, {{4, 0, 4}}),
               InvalidArgument);
}

/** Random points in the unit cube. */
struct Points {
  explicit Points(std::size_t n)
      : use(n)
  {
    for (std::uint64_t i = 0; i < n; ++i)
      for (std::uint64_t axis = 0; axis < 3; ++axis)
        xyz.push_back(static_cast<float>(uniformAt(7, i, axis)));
    std::iota(use.begin(), use.end(), 0u);
  }

  VoronoiGrid
  grid(std::uint32_t cells, Report& report) const
  {
    FeatureTransform way;
    const GridShape shape =
        GridShape::boxes({{0, 0, 0}}, {{1, 1, 1}}, {{cells, cells, cells}});
    return VoronoiGrid(shape, xyz.data(), 3, use, way, 0, report);
  }

  std::vector<float> xyz;
  std::vector<std::uint32_t> use;
};

TEST(VoronoiDiagram, ReturnsItsCells)
{
  using Cells = std::array<std::uint32_t, 3>;
  pcl_uvol::VoronoiDiagram<pcl::PointXYZ> diagram;
  EXPECT_EQ((Cells{128, 0, 0}), diagram.getCells());
  diagram.setCells(5, 6, 7);
  EXPECT_EQ((Cells{5, 6, 7}), diagram.getCells());
  diagram.setCells(64);
  EXPECT_EQ((Cells{64, 0, 0}), diagram.getCells());
}

TEST(VoronoiGrid, SortsPointsIntoCells)
{
  Points points(800);
  points.xyz[3 * 17 + 1] = std::numeric_limits<float>::quiet_NaN();
  Report report;
  const VoronoiGrid grid = points.grid(8, report);
  EXPECT_EQ(1u, report.getCount("non_finite"));
  EXPECT_EQ(512u, report.getCount("cells"));
  EXPECT_EQ(grid.getSites().size(), report.getCount("sites"));
  std::set<std::uint32_t> seen;
  std::uint64_t before = 0;
  for (std::size_t site = 0; site < grid.getSites().size(); ++site) {
    const GridCell& cell = grid.getSites()[site];
    const std::uint64_t number = grid.getShape().indexOf(cell);
    EXPECT_TRUE(site == 0 || number > before);
    before = number;
    EXPECT_EQ(site, grid.getNearest()[number]);
    ASSERT_GT(grid.getMembers()[site].size(), 0u);
    for (const std::uint32_t point : grid.getMembers()[site]) {
      EXPECT_TRUE(seen.insert(point).second);
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(static_cast<int>(8 * points.xyz[3 * point + axis]), cell[axis]);
    }
  }
  EXPECT_EQ(799u, seen.size());
}

TEST(VoronoiGrid, DistancesAreThoseBetweenCenters)
{
  const Points points(20);
  Report report;
  const VoronoiGrid grid = points.grid(10, report);
  const auto distances = grid.computeDistances(0);
  for (std::uint64_t i = 0; i < grid.getShape().size(); ++i) {
    double least = 1e30;
    for (const GridCell& site : grid.getSites())
      least =
          std::min(least, grid.getShape().distance(grid.getShape().cellOf(i), site));
    EXPECT_FLOAT_EQ(static_cast<float>(least), distances[i]);
  }
}

TEST(VoronoiGrid, AdjacentRegionsShareAPoint)
{
  const Points points(60);
  Report report;
  const VoronoiGrid grid = points.grid(9, report);
  const auto& nearest = grid.getNearest();
  std::vector<std::set<std::uint32_t>> expected(grid.getSites().size());
  for (std::uint64_t i = 0; i < nearest.size(); ++i)
    for (std::uint64_t j = 0; j < nearest.size(); ++j) {
      const GridCell a = grid.getShape().cellOf(i), b = grid.getShape().cellOf(j);
      const bool touch = std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 &&
                         std::abs(a[2] - b[2]) <= 1;
      if (touch && nearest[i] != nearest[j])
        expected[nearest[i]].insert(nearest[j]);
    }
  for (const unsigned threads : {1u, 2u, 7u}) {
    const auto adjacent = grid.findAdjacentRegions(threads);
    ASSERT_EQ(expected.size(), adjacent.size());
    for (std::size_t site = 0; site < expected.size(); ++site)
      EXPECT_EQ(
          std::vector<std::uint32_t>(expected[site].begin(), expected[site].end()),
          std::vector<std::uint32_t>(adjacent[site].begin(), adjacent[site].end()));
  }
}

TEST(VoronoiGrid, RefusesWhatDoesNotFit)
{
  const Points points(5);
  Report report;
  FeatureTransform way;
  GridShape shape;
  const auto refusal = [&] {
    return uvol_test::thrownBy<InvalidArgument>([&] {
      const VoronoiGrid grid(shape, points.xyz.data(), 3, points.use, way, 0, report);
    });
  };
  shape.cells = {{16384, 16384, 16384}};
  const pcl_uvol::Message large = refusal();
  EXPECT_EQ("not_enough_memory", large.code);
  EXPECT_NE(std::string::npos,
            uvol_test::wordOf(large, "what").find("16384 x 16384 x 16384"));
  EXPECT_EQ("53 TB", uvol_test::wordOf(large, "needed"));
  shape.cells = {{0, 4, 4}};
  const pcl_uvol::Message not_allowed("voronoi_grid_not_allowed", {{"most", 16384}});
  EXPECT_EQ(not_allowed, refusal());
  shape.cells = {{4, 4, 4}};
  shape.spacing[1] = 0.0;
  EXPECT_EQ(not_allowed, refusal());
  shape.spacing[1] = 1.0;
  EXPECT_THROW(VoronoiGrid(shape, points.xyz.data(), 3, {}, way, 0, report),
               InvalidArgument);
}

} // namespace test_voronoi_grid
