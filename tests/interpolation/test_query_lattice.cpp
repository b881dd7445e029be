// SPDX-License-Identifier: BSD-3-Clause
// Where lines, slices and grids ask, and how their answers come in blocks.
#include "interpolation/query_lattice.h"
#include "support/interpolation_cases.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace test_query_lattice {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;
using namespace uvol_test;
using Eigen::Vector3d;

const Bounds box{{-1.0, 0.0, 2.0}, {3.0, 2.0, 3.0}};

void
expectPlace(const Place& actual, const Place& expected)
{
  EXPECT_LT((vectorOf(actual) - vectorOf(expected)).norm(), 1e-12)
      << vectorOf(actual).transpose() << " is not " << vectorOf(expected).transpose();
}

TEST(QueryLattice, LinesEndAtTheirEnds)
{
  const QueryLattice line = makeLine({1.0, 2.0, 3.0}, {4.0, 6.0, 3.0}, 11);
  EXPECT_EQ(line.size(), 11u);
  expectPlace(line.at(0), {1.0, 2.0, 3.0});
  expectPlace(line.at(4), {2.2, 3.6, 3.0});
  expectPlace(line.at(10), {4.0, 6.0, 3.0});
  EXPECT_NEAR(line.spacing(0), 0.5, 1e-15);
  EXPECT_THROW(makeLine({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 5), InvalidArgument);
  EXPECT_THROW(makeLine({1.0, 2.0, 3.0}, {1.0, 2.0, 4.0}, 1), InvalidArgument);
  EXPECT_THROW(makeLine({1.0, 2.0, 3.0}, {1.0, 2.0, INFINITY}, 2), InvalidArgument);
}

TEST(QueryLattice, GridsOfCubesFillTheBoxFromItsMiddle)
{
  const QueryLattice grid = makeCubicGrid(box, 9); // half a unit apart
  EXPECT_EQ(grid.counts, (std::array<std::size_t, 3>{9, 5, 3}));
  expectPlace(grid.at(0), box.low);
  expectPlace(grid.at(grid.size() - 1), box.high);
  expectPlace(grid.at(9 * 5 + 2 * 9 + 1), {-0.5, 1.0, 2.5});
  const QueryLattice coarse = makeCubicGrid(box, 4); // 4/3: one step in y, none in z
  EXPECT_EQ(coarse.counts, (std::array<std::size_t, 3>{4, 2, 1}));
  expectPlace(coarse.at(0), {-1.0, 1.0 / 3.0, 2.5});
  EXPECT_GT(coarse.spacing(2), 0.0);
  // Rounding does not lose the last place.
  EXPECT_EQ(makeCubicGrid({{0.0, 0.0, 0.0}, {0.7, 0.7, 0.7}}, 8).counts[1], 8u);
}

TEST(QueryLattice, GridsOfBoxesHaveTheCountsAskedFor)
{
  const QueryLattice grid = makeGrid(box, {5, 1, 2});
  EXPECT_EQ(grid.counts, (std::array<std::size_t, 3>{5, 1, 2}));
  expectPlace(grid.at(0), {-1.0, 1.0, 2.0});
  expectPlace(grid.at(9), {3.0, 1.0, 3.0});
  const Bounds flat{{0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}}, point{{1, 1, 1}, {1, 1, 1}},
      inverse{{0.0, 0.0, 1.0}, {1.0, 1.0, 0.0}};
  EXPECT_EQ(makeCubicGrid(flat, 3).counts, (std::array<std::size_t, 3>{3, 3, 1}));
  EXPECT_EQ(makeGrid(flat, {3, 2, 1}).size(), 6u);
  EXPECT_THROW(makeGrid(flat, {3, 3, 3}), InvalidArgument);
  EXPECT_THROW(makeGrid(box, {3, 0, 3}), InvalidArgument);
  for (const Bounds& bad : {point, inverse}) {
    EXPECT_THROW(makeGrid(bad, {1, 1, 1}), InvalidArgument);
    EXPECT_THROW(makeCubicGrid(bad, 3), InvalidArgument);
  }
  EXPECT_THROW(makeCubicGrid(box, 1), InvalidArgument);
}

TEST(QueryLattice, SlicesAlongTheAxesAreLatticesAlongThem)
{
  // Half a unit apart: the wider side decides.
  const Slice z = makeSlice({{7.0, 7.0, 2.25}, {0.0, 0.0, -2.0}}, box, {9, 99});
  EXPECT_EQ(z.lattice.counts, (std::array<std::size_t, 3>{9, 5, 1}));
  EXPECT_EQ(z.horizontal, 0u);
  EXPECT_EQ(z.vertical, 1u);
  expectPlace(z.lattice.at(0), {-1.0, 0.0, 2.25});
  expectPlace(z.lattice.at(9 + 1), {-0.5, 0.5, 2.25});
  const Slice y = makeSlice({{0.0, 1.5, 0.0}, {0.0, 1.0, 0.0}}, box, {9, 9});
  EXPECT_EQ(y.lattice.counts, (std::array<std::size_t, 3>{9, 1, 3}));
  EXPECT_EQ(y.horizontal, 0u);
  EXPECT_EQ(y.vertical, 2u);
  expectPlace(y.lattice.at(9 + 1), {-0.5, 1.5, 2.5});
  const Slice x = makeSlice({{0.5, 0.0, 0.0}, {3.0, 0.0, 0.0}}, box, {5, 5});
  EXPECT_EQ(x.lattice.counts, (std::array<std::size_t, 3>{1, 5, 3}));
  EXPECT_EQ(x.horizontal, 1u);
  EXPECT_EQ(x.vertical, 2u);
  expectPlace(x.lattice.at(5 + 1), {0.5, 0.5, 2.5});
}

TEST(QueryLattice, SlantingSlicesLieInTheirPlane)
{
  const Vector3d point(1.0, 1.0, 2.5), normal(1.0, 1.0, 1.0);
  const Slice slice = makeSlice({{1.0, 1.0, 2.5}, {1.0, 1.0, 1.0}}, box, {40, 30});
  const QueryLattice& lattice = slice.lattice;
  EXPECT_EQ(lattice.counts[2], 1u);
  EXPECT_TRUE(lattice.counts[0] == 40 || lattice.counts[1] == 30);
  EXPECT_LE(lattice.counts[0], 40u);
  EXPECT_LE(lattice.counts[1], 30u);
  for (const std::size_t i : {std::size_t{0}, std::size_t{57}, lattice.size() - 1})
    EXPECT_NEAR(normal.dot(vectorOf(lattice.at(i)) - point), 0.0, 1e-12);
  const Vector3d right = vectorOf(lattice.steps[0]), up = vectorOf(lattice.steps[1]);
  EXPECT_NEAR(right.dot(up), 0.0, 1e-12);
  EXPECT_NEAR(right.norm(), up.norm(), 1e-12);
  EXPECT_GT(up.z(), 0.0);
  EXPECT_GT(right.cross(up).dot(normal), 0.0);
  // The cut through the box is inside, as the middles of its sides show.
  for (const Vector3d& cut : {Vector3d(2.5, 0.0, 2.0), Vector3d(-0.5, 2.0, 3.0)}) {
    const Vector3d offset = cut - vectorOf(lattice.origin);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const Vector3d step = vectorOf(lattice.steps[axis]);
      const double at = offset.dot(step) / step.squaredNorm();
      EXPECT_GT(at, -1.0);
      EXPECT_LT(at, static_cast<double>(lattice.counts[axis]));
    }
  }
}

TEST(QueryLattice, PlanesMissOrTouchTheBox)
{
  EXPECT_THROW(makeSlice({{0.0, 0.0, 7.0}, {0.0, 0.0, 1.0}}, box, {5, 5}),
               InvalidArgument);
  EXPECT_THROW(makeSlice({{3.0, 2.0, 3.0}, {1.0, 1.0, 1.0}}, box, {5, 5}),
               InvalidArgument);
  EXPECT_THROW(makeSlice({{0.0, 0.0, 2.5}, {0.0, 0.0, 0.0}}, box, {5, 5}),
               InvalidArgument);
  EXPECT_THROW(makeSlice({{0.0, 0.0, 2.5}, {0.0, 0.0, 1.0}}, box, {5, 1}),
               InvalidArgument);
  // A face of the box is a cut through it.
  EXPECT_EQ(makeSlice({{0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}}, box, {5, 5}).lattice.size(),
            15u);
}

TEST(QueryLattice, BoundsAreThoseOfTheFinitePoints)
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [x, y, z] : {std::array<float, 3>{1.0f, 5.0f, -2.0f},
                                std::array<float, 3>{nan, 70.0f, 70.0f},
                                std::array<float, 3>{-3.0f, 4.0f, 0.0f}}) {
    pcl::PointXYZI point;
    point.getVector3fMap() << x, y, z;
    cloud.push_back(point);
  }
  const Bounds found = findBounds(viewOf(cloud));
  expectPlace(found.low, {-3.0, 4.0, -2.0});
  expectPlace(found.high, {1.0, 5.0, 0.0});
  cloud.resize(0);
  EXPECT_THROW(findBounds(viewOf(cloud)), InvalidArgument);
}

TEST(QueryLattice, BlocksGiveWhatSingleQueriesGet)
{
  const auto cloud = sampleFunctions(randomPlaces(2000, 1), {franke});
  const CloudView view = viewOf(cloud);
  pcl::Indices indices(view.count);
  std::iota(indices.begin(), indices.end(), 0);
  InterpolationParameters parameters;
  parameters.fields = {"f0"};
  parameters.model = InterpolationModel::Nearest;
  Report report;
  const FieldInterpolator interpolator(view, indices, parameters, 0, report);
  // More than a block of queries.
  const QueryLattice grid = makeGrid({{0, 0, 0}, {1, 1, 1}}, {70, 69, 66});
  ASSERT_GT(grid.size(), lattice_block);
  std::vector<double> progress, values;
  Report blocks;
  blocks.progress = [&](const std::string&, double done) { progress.push_back(done); };
  interpolator.interpolate(
      grid.size(),
      [&](std::size_t query) { return grid.at(query); },
      2,
      blocks,
      [&](std::size_t first, const InterpolatedFields& answers) {
        EXPECT_EQ(first, values.size());
        EXPECT_LE(answers.size, lattice_block);
        values.insert(values.end(), answers.values.begin(), answers.values.end());
      });
  ASSERT_EQ(values.size(), grid.size());
  Places places;
  for (std::size_t i = 0; i < grid.size(); ++i)
    places.push_back(grid.at(i));
  Report whole;
  const auto answers = interpolator.interpolate(places, 1, whole);
  EXPECT_EQ(0,
            std::memcmp(
                values.data(), answers.values.data(), values.size() * sizeof(double)));
  EXPECT_EQ(blocks.counts, whole.counts);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_EQ(1, std::count(progress.begin(), progress.end(), 0.0));
}

} // namespace test_query_lattice
