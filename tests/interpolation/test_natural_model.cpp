// SPDX-License-Identifier: BSD-3-Clause
// Natural neighbours by exact Voronoi cells, against counted volumes, linear functions
// and layouts in which many samples lie on one sphere.
#include "common/random.h"
#include "src/interpolation/natural_model.h"
#include "src/neighbors/convex_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace test_natural_model {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;

SampleSet::ConstPtr
buildSamples(const std::vector<Position>& positions)
{
  std::vector<std::uint32_t> use(positions.size());
  std::iota(use.begin(), use.end(), 0u);
  Report report;
  return SampleSet::build(
      positions.front().x, 3, use, Position{{1.0f, 1.0f, 1.0f}}, 1, report);
}

std::vector<Position>
randomPositions(std::size_t n, std::uint64_t seed)
{
  std::vector<Position> positions(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int axis = 0; axis < 3; ++axis)
      positions[i][axis] =
          static_cast<float>(uniformAt(seed, i, static_cast<std::uint64_t>(axis)));
  return positions;
}

std::vector<Position>
lattice(int side)
{
  std::vector<Position> positions;
  for (int i = 0; i < side * side * side; ++i)
    positions.push_back({{static_cast<float>(i % side) / 8.0f,
                          static_cast<float>(i / side % side) / 8.0f,
                          static_cast<float>(i / side / side) / 8.0f}});
  return positions;
}

Query
randomQuery(std::uint64_t index, double low, double high)
{
  Query query;
  for (int axis = 0; axis < 3; ++axis)
    query.x[axis] =
        low + (high - low) * uniformAt(77, index, static_cast<std::uint64_t>(axis));
  return query;
}

/** Samples are kept in a unit of their own. */
Query
inUnit(const SampleSet& samples, Query query)
{
  for (double& x : query.x)
    x *= static_cast<double>(samples.getUnit().factor);
  return query;
}

std::vector<std::uint32_t>
nearestSamples(const SampleSet& samples, const Query& query, std::size_t count)
{
  std::vector<std::uint32_t> all(samples.size());
  std::iota(all.begin(), all.end(), 0u);
  std::sort(all.begin(), all.end(), [&](auto a, auto b) {
    return sqDistance(query, samples.getPositions()[a]) <
           sqDistance(query, samples.getPositions()[b]);
  });
  all.resize(std::min(all.size(), count));
  return all;
}

bool
find(NaturalNeighborFinder& finder,
     const SampleSet& samples,
     const Query& query,
     std::size_t first = 40)
{
  const auto near = nearestSamples(samples, query, first);
  return finder.find(query, near.data(), near.size());
}

/** The sum of the coordinates times the positions is the place. */
void
expectLinearPrecision(const SampleSet& samples,
                      const Query& query,
                      const std::vector<NaturalNeighborFinder::Neighbor>& neighbors)
{
  double sum = 0.0, mean[3] = {}, extent = 0.0;
  for (const auto& neighbor : neighbors) {
    sum += neighbor.weight;
    EXPECT_GE(neighbor.weight, 0.0);
  }
  for (const auto& neighbor : neighbors)
    for (int axis = 0; axis < 3; ++axis) {
      const double offset =
          static_cast<double>(samples.getPositions()[neighbor.sample][axis]) -
          query.x[axis];
      extent = std::max(extent, std::abs(offset));
      mean[axis] += neighbor.weight / sum * offset;
    }
  for (const double along : mean)
    EXPECT_NEAR(along, 0.0, 1e-9 * extent);
}

TEST(NaturalNeighborFinder, CoordinatesReproduceThePlace)
{
  for (const auto& positions :
       {randomPositions(4000, 1), randomPositions(60, 2), lattice(9)}) {
    const auto samples = buildSamples(positions);
    for (const auto coordinates :
         {NaturalCoordinates::Sibson, NaturalCoordinates::Laplace}) {
      NaturalNeighborFinder finder(*samples, coordinates);
      std::size_t inside = 0;
      for (std::uint64_t i = 0; i < 200; ++i) {
        const Query query = inUnit(*samples, randomQuery(i, 0.02, 0.98));
        if (!find(finder, *samples, query, i % 2 == 0 ? 60 : 5))
          continue;
        ++inside;
        expectLinearPrecision(*samples, query, finder.getNeighbors());
      }
      EXPECT_GT(inside, 80u);
    }
  }
}

/** A place in the middle of a cell of a lattice, and beside it: eight samples on a
 * sphere, and many that only just miss it. */
TEST(NaturalNeighborFinder, LatticesAreNoTrouble)
{
  const auto samples = buildSamples(lattice(8));
  for (const double off : {0.0, 1e-15, 1e-9, 1e-3}) {
    const Query query = inUnit(*samples, {{0.4375 + off, 0.4375, 0.4375 - off}});
    const double unit = static_cast<double>(samples->getUnit().factor);
    NaturalNeighborFinder sibson(*samples, NaturalCoordinates::Sibson);
    ASSERT_TRUE(find(sibson, *samples, query));
    expectLinearPrecision(*samples, query, sibson.getNeighbors());
    double sum = 0.0, corners = 0.0;
    for (const auto& neighbor : sibson.getNeighbors()) {
      sum += neighbor.weight;
      bool is_corner = true;
      for (int axis = 0; axis < 3; ++axis)
        is_corner =
            is_corner && std::abs(static_cast<double>(
                                      samples->getPositions()[neighbor.sample][axis]) -
                                  0.4375 * unit) < 0.07 * unit;
      corners += is_corner ? neighbor.weight : 0.0;
    }
    EXPECT_NEAR(corners / sum, 1.0, 0.05);
  }
}

/** Nodes of a structured grid, a thousand times as far apart along its layers as
 * across. */
TEST(NaturalNeighborFinder, CoordinatesReproduceThePlaceInLayers)
{
  std::vector<Position> layers;
  for (int i = 0; i < 8 * 8 * 80; ++i) {
    const double x = i % 8 / 8.0, y = i / 8 % 8 / 8.0;
    layers.push_back({{static_cast<float>(x),
                       static_cast<float>(y),
                       static_cast<float>(1.25e-4 * (i / 64) + 0.1 * x * y)}});
  }
  const auto samples = buildSamples(layers);
  for (const auto coordinates :
       {NaturalCoordinates::Sibson, NaturalCoordinates::Laplace}) {
    NaturalNeighborFinder finder(*samples, coordinates);
    for (std::uint64_t i = 0; i < 20; ++i) {
      Query query = randomQuery(i, 0.2, 0.7);
      query.x[2] = 0.01 * query.x[2] + 0.1 * query.x[0] * query.x[1];
      query = inUnit(*samples, query);
      ASSERT_TRUE(find(finder, *samples, query));
      EXPECT_GT(finder.getNeighbors().size(), 100u);
      expectLinearPrecision(*samples, query, finder.getNeighbors());
    }
  }
}

/** Sibson's coordinates: the part of the cell that was nearest to each sample. */
void
expectStolenVolumes(const std::vector<Position>& positions, std::uint64_t queries)
{
  const auto samples = buildSamples(positions);
  const double unit = static_cast<double>(samples->getUnit().factor);
  NaturalNeighborFinder finder(*samples, NaturalCoordinates::Sibson);
  for (std::uint64_t i = 0; i < queries; ++i) {
    const Query query = inUnit(*samples, randomQuery(1000 + i, 0.4, 0.6));
    ASSERT_TRUE(find(finder, *samples, query, 20));
    std::map<std::uint32_t, double> counted;
    std::size_t hits = 0;
    constexpr std::size_t trials = 400000;
    for (std::uint64_t t = 0; t < trials; ++t) {
      Query at;
      for (int axis = 0; axis < 3; ++axis)
        at.x[axis] =
            query.x[axis] +
            unit * (0.5 * uniformAt(5 + i, t, static_cast<std::uint64_t>(axis)) - 0.25);
      double sq_own = 0.0;
      for (int axis = 0; axis < 3; ++axis)
        sq_own += (at.x[axis] - query.x[axis]) * (at.x[axis] - query.x[axis]);
      double sq_least = sq_own;
      std::uint32_t nearest = 0;
      bool is_own = true;
      for (std::uint32_t s = 0; s < samples->size(); ++s) {
        const double sq_dist = sqDistance(at, samples->getPositions()[s]);
        // The nearest sample, if the place itself is nearer than all.
        if (sq_dist < sq_own) {
          is_own = false;
          break;
        }
        if (s == 0 || sq_dist < sq_least) {
          sq_least = sq_dist;
          nearest = s;
        }
      }
      if (is_own) {
        ++hits;
        counted[nearest] += 1.0;
      }
    }
    double sum = 0.0;
    for (const auto& neighbor : finder.getNeighbors())
      sum += neighbor.weight;
    const double volume =
        static_cast<double>(hits) / trials * 0.125 * unit * unit * unit;
    EXPECT_NEAR(sum / volume, 1.0, 0.05);
    for (const auto& neighbor : finder.getNeighbors())
      EXPECT_NEAR(neighbor.weight / sum,
                  counted[neighbor.sample] / static_cast<double>(hits),
                  0.02);
  }
}

TEST(NaturalNeighborFinder, SibsonsCoordinatesAreStolenVolumes)
{
  expectStolenVolumes(randomPositions(300, 3), 4);
}

/** There planes meet by four and more. */
TEST(NaturalNeighborFinder, SibsonsCoordinatesAreStolenVolumesInLattices)
{
  expectStolenVolumes(lattice(8), 2);
}

/** The gradients of volumes are their derivatives. */
void
expectGradients(const std::vector<Position>& positions)
{
  const auto samples = buildSamples(positions);
  NaturalNeighborFinder finder(*samples, NaturalCoordinates::Sibson);
  const auto weightsAt = [&](const Query& query) {
    find(finder, *samples, query);
    std::map<std::uint32_t, double> weights;
    for (const auto& neighbor : finder.getNeighbors())
      weights[neighbor.sample] = neighbor.weight;
    return weights;
  };
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Query query = inUnit(*samples, randomQuery(2000 + i, 0.35, 0.65));
    find(finder, *samples, query);
    const auto neighbors = finder.getNeighbors();
    double size = 0.0;
    for (const auto& neighbor : neighbors)
      size += neighbor.weight;
    constexpr double step = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
      Query ahead = query, behind = query;
      ahead.x[axis] += step;
      behind.x[axis] -= step;
      auto more = weightsAt(ahead), less = weightsAt(behind);
      for (const auto& neighbor : neighbors)
        EXPECT_NEAR((more[neighbor.sample] - less[neighbor.sample]) / (2.0 * step),
                    neighbor.gradient[static_cast<std::size_t>(axis)],
                    1e-3 * std::cbrt(size * size));
    }
  }
}

TEST(NaturalNeighborFinder, GradientsAreDerivatives)
{
  expectGradients(randomPositions(500, 4));
}

TEST(NaturalNeighborFinder, GradientsAreDerivativesInLattices)
{
  expectGradients(lattice(8));
}

TEST(NaturalNeighborFinder, KnowsTheConvexHull)
{
  const auto samples = buildSamples(lattice(8)); // the cube up to 0.875
  NaturalNeighborFinder finder(*samples, NaturalCoordinates::Laplace);
  const auto isInside = [&](double x, double y, double z) {
    return find(finder, *samples, inUnit(*samples, {{x, y, z}}));
  };
  for (const double depth : {1e-5, 0.01, 0.4}) {
    EXPECT_TRUE(isInside(depth, 0.31, 0.47));
    EXPECT_FALSE(isInside(-depth, 0.31, 0.47));
    EXPECT_FALSE(isInside(0.3, 0.875 + depth, 0.875 + depth));
  }
}

TEST(ConvexPolygon, IsCutDownToNothing)
{
  ConvexPolygon polygon;
  polygon.start(1.0);
  EXPECT_NEAR(4.0, polygon.computeMoments().area, 1e-14);
  EXPECT_NEAR(2.0, polygon.getSqReach(), 1e-14);
  EXPECT_FALSE(polygon.cut(1.0, 0.0, 1.0, 0.0)); // along a side
  EXPECT_FALSE(polygon.cut(1.0, 0.0, 0.9, 0.2)); // within the tolerance
  EXPECT_TRUE(polygon.cut(1.0, 1.0, 0.0, 0.0));  // through two vertices
  const PolygonMoments half = polygon.computeMoments();
  EXPECT_NEAR(2.0, half.area, 1e-14);
  EXPECT_LT((half.centroid - Eigen::Vector2d(-1.0 / 3.0, -1.0 / 3.0)).norm(), 1e-14);
  EXPECT_TRUE(polygon.cut(0.0, -2.0, 0.0, 0.0)); // y >= 0
  EXPECT_NEAR(0.5, polygon.computeMoments().area, 1e-14);
  EXPECT_NEAR(2.0, polygon.getSqReach(), 1e-14);
  EXPECT_TRUE(polygon.cut(-1.0, 0.0, 0.5, 0.0)); // x >= -1/2
  EXPECT_NEAR(0.125, polygon.computeMoments().area, 1e-14);
  EXPECT_NEAR(0.5, polygon.getSqReach(), 1e-14);
  EXPECT_TRUE(polygon.cut(1.0, 0.0, -3.0, 0.0));
  EXPECT_EQ(0u, polygon.size());
  EXPECT_EQ(0.0, polygon.computeMoments().area);
}

/** Tangents of the unit circle: more vertices than room or a word of bits is for. */
TEST(ConvexPolygon, MayHaveManyVertices)
{
  constexpr int sides = 300;
  constexpr double pi = 3.14159265358979323846;
  ConvexPolygon polygon;
  polygon.start(2.0);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * pi * (7 * i % sides) / sides;
    EXPECT_TRUE(polygon.cut(std::cos(angle), std::sin(angle), 1.0, 0.0)) << i;
  }
  EXPECT_EQ(static_cast<std::size_t>(sides), polygon.size());
  const PolygonMoments moments = polygon.computeMoments();
  EXPECT_NEAR(sides * std::tan(pi / sides), moments.area, 1e-12);
  EXPECT_LT(moments.centroid.norm(), 1e-12);
  EXPECT_NEAR(1.0 / std::pow(std::cos(pi / sides), 2), polygon.getSqReach(), 1e-12);
  EXPECT_TRUE(polygon.cut(0.0, 1.0, 0.0, 0.0)); // half of it
  EXPECT_NEAR(0.5 * moments.area, polygon.computeMoments().area, 1e-12);
  EXPECT_TRUE(polygon.cut(0.0, 1.0, -3.0, 0.0));
  EXPECT_EQ(0u, polygon.size());
}

} // namespace test_natural_model
