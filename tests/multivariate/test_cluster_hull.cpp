// SPDX-License-Identifier: BSD-3-Clause
// Regions of closed surfaces, shrunk to the vertices of a hull (thesis 2.6).
#include "common/random.h"
#include "multivariate/cluster_hull.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace test_cluster_hull {

using pcl_uvol::ClusterHull;
using pcl_uvol::InvalidArgument;
using pcl_uvol::makeClusterHull;
using pcl_uvol::Triangle;
using pcl_uvol::uniformAt;

using Labels = std::vector<std::uint32_t>;
using Places = std::vector<Eigen::Vector3d>;

/** A closed surface that its places are the vertices of. */
struct Surface {
  Places places;
  std::vector<Triangle> triangles;
};

Surface
makeOctahedron()
{
  Surface surface;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0})
      surface.places.push_back(side * Eigen::Vector3d::Unit(axis));
  for (std::uint32_t x = 0; x < 2; ++x)
    for (std::uint32_t y = 2; y < 4; ++y)
      for (std::uint32_t z = 4; z < 6; ++z)
        surface.triangles.push_back((x + y + z) % 2 == 0 ? Triangle{{x, y, z}}
                                                         : Triangle{{x, z, y}});
  return surface;
}

Surface
makeIcosahedron()
{
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  Surface surface;
  for (int axis = 0; axis < 3; ++axis)
    for (const double one : {1.0, -1.0})
      for (const double long_side : {golden, -golden}) {
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        place[axis] = one;
        place[(axis + 1) % 3] = long_side;
        surface.places.push_back(place.normalized());
      }
  const auto& p = surface.places;
  const double edge = 2.0 / std::hypot(1.0, golden);
  const auto touch = [&](std::uint32_t a, std::uint32_t b) {
    return (p[a] - p[b]).norm() < 1.01 * edge;
  };
  for (std::uint32_t a = 0; a < 12; ++a)
    for (std::uint32_t b = a + 1; b < 12; ++b)
      for (std::uint32_t c = b + 1; c < 12; ++c)
        if (touch(a, b) && touch(b, c) && touch(c, a))
          surface.triangles.push_back(p[a].cross(p[b]).dot(p[c]) > 0.0
                                          ? Triangle{{a, b, c}}
                                          : Triangle{{a, c, b}});
  return surface;
}

/** Each triangle of a surface on the unit sphere becomes four. */
Surface
refine(const Surface& coarse)
{
  Surface fine;
  fine.places = coarse.places;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto found = middles.emplace(std::minmax(a, b), fine.places.size());
    if (found.second)
      fine.places.push_back((fine.places[a] + fine.places[b]).normalized());
    return found.first->second;
  };
  for (const Triangle& t : coarse.triangles) {
    const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]),
                        ca = middle(t[2], t[0]);
    fine.triangles.push_back({{t[0], ab, ca}});
    fine.triangles.push_back({{t[1], bc, ab}});
    fine.triangles.push_back({{t[2], ca, bc}});
    fine.triangles.push_back({{ab, bc, ca}});
  }
  return fine;
}

Surface
makeSphere(int refinements)
{
  Surface sphere = makeIcosahedron();
  for (int i = 0; i < refinements; ++i)
    sphere = refine(sphere);
  return sphere;
}

constexpr double pi = 3.14159265358979323846;
constexpr std::uint32_t around_ring = 90, around_tube = 30;

/** Radii 1 and 0.4; vertices run around the tube fastest. */
Surface
makeTorus()
{
  Surface torus;
  for (std::uint32_t i = 0; i < around_ring; ++i)
    for (std::uint32_t j = 0; j < around_tube; ++j) {
      const double ring = 2.0 * pi * i / around_ring, tube = 2.0 * pi * j / around_tube;
      const double radius = 1.0 + 0.4 * std::cos(tube);
      torus.places.emplace_back(
          radius * std::cos(ring), radius * std::sin(ring), 0.4 * std::sin(tube));
    }
  const auto at = [](std::uint32_t i, std::uint32_t j) {
    return i % around_ring * around_tube + j % around_tube;
  };
  for (std::uint32_t i = 0; i < around_ring; ++i)
    for (std::uint32_t j = 0; j < around_tube; ++j) {
      torus.triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      torus.triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  return torus;
}

/** The nearest of some places, by index. */
Labels
nearestOf(const Surface& surface, const Places& seeds)
{
  Labels labels;
  for (const auto& place : surface.places) {
    const auto nearest =
        std::min_element(seeds.begin(), seeds.end(), [&](const auto& a, const auto& b) {
          return (a - place).squaredNorm() < (b - place).squaredNorm();
        });
    labels.push_back(static_cast<std::uint32_t>(nearest - seeds.begin()));
  }
  return labels;
}

Places
randomSeeds(const Surface& surface, std::size_t number, std::uint64_t seed)
{
  Places seeds;
  for (std::size_t i = 0; i < number; ++i)
    seeds.push_back(surface.places[static_cast<std::size_t>(
        uniformAt(seed, i, 0) * double(surface.places.size()))]);
  return seeds;
}

/** A label for each vertex, by its place. */
template <typename LabelAt>
Labels
labelBy(const Surface& surface, const LabelAt& labelAt)
{
  Labels labels;
  for (const auto& place : surface.places)
    labels.push_back(labelAt(place));
  return labels;
}

/** How often each edge is walked in each direction. */
std::map<std::pair<std::uint32_t, std::uint32_t>, int>
directedEdges(const std::vector<Triangle>& triangles)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  return edges;
}

void
expectClosed(const ClusterHull& hull)
{
  const auto edges = directedEdges(hull.triangles);
  for (const auto& edge : edges) {
    EXPECT_NE(edge.first.first, edge.first.second);
    const auto opposite = edges.find({edge.first.second, edge.first.first});
    ASSERT_NE(edges.end(), opposite);
    EXPECT_EQ(edge.second, opposite->second);
  }
  std::set<std::uint32_t> used;
  for (const Triangle& triangle : hull.triangles)
    used.insert(triangle.begin(), triangle.end());
  // No vertex without a triangle.
  EXPECT_EQ(hull.regions.size(), used.size());
}

/** 2 for a sphere, 0 for a torus. Closed surfaces have 3/2 edges per triangle. */
long
eulerCharacteristic(const ClusterHull& hull)
{
  EXPECT_EQ(0u, hull.triangles.size() % 2);
  return static_cast<long>(hull.regions.size()) -
         static_cast<long>(hull.triangles.size() / 2);
}

/** \param places of the regions */
double
signedVolume(const ClusterHull& hull, const Places& places)
{
  double volume = 0.0;
  for (const Triangle& t : hull.triangles)
    volume += places[hull.regions[t[0]]]
                  .cross(places[hull.regions[t[1]]])
                  .dot(places[hull.regions[t[2]]]) /
              6.0;
  return volume;
}

/** Triangles of labels, each from its lowest corner on, in order. */
std::vector<Triangle>
normalized(const std::vector<Triangle>& triangles, const Labels& labels)
{
  std::vector<Triangle> result;
  for (Triangle triangle : triangles) {
    for (std::uint32_t& corner : triangle)
      corner = labels[corner];
    std::rotate(triangle.begin(),
                std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    result.push_back(triangle);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(ClusterHull, OfOneVertexPerRegionIsTheSurface)
{
  const Surface surface = makeOctahedron();
  const Labels labels = {70, 10, 60, 20, 50, 30};
  const ClusterHull hull = makeClusterHull(surface.triangles, labels);
  EXPECT_EQ(6u, hull.regions.size());
  EXPECT_EQ(0u, hull.split_pieces);
  EXPECT_EQ(normalized(surface.triangles, labels),
            normalized(hull.triangles, hull.regions));
}

TEST(ClusterHull, OfPatchesIsTheirDual)
{
  const Surface coarse = makeIcosahedron();
  for (const int refinements : {1, 2, 3, 4}) {
    const Surface sphere = makeSphere(refinements);
    const ClusterHull hull =
        makeClusterHull(sphere.triangles, nearestOf(sphere, coarse.places));
    Labels own(12);
    for (std::uint32_t i = 0; i < 12; ++i)
      own[i] = i;
    EXPECT_EQ(normalized(coarse.triangles, own),
              normalized(hull.triangles, hull.regions))
        << refinements;
  }
}

TEST(ClusterHull, OfASphereIsASphere)
{
  const Surface sphere = makeSphere(4);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Places seeds = randomSeeds(sphere, 20 + 30 * seed, seed);
    const ClusterHull hull =
        makeClusterHull(sphere.triangles, nearestOf(sphere, seeds));
    expectClosed(hull);
    EXPECT_EQ(2, eulerCharacteristic(hull)) << seed;
    const double volume = signedVolume(hull, seeds);
    EXPECT_GT(volume, 1.0) << seed;
    EXPECT_LT(volume, 4.0 / 3.0 * pi) << seed;
  }
}

TEST(ClusterHull, OfATorusIsATorus)
{
  const Surface torus = makeTorus();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Places seeds = randomSeeds(torus, 100 + 20 * seed, seed);
    const ClusterHull hull = makeClusterHull(torus.triangles, nearestOf(torus, seeds));
    expectClosed(hull);
    EXPECT_EQ(0, eulerCharacteristic(hull)) << seed;
    // The solid torus has 2 pi^2 0.4^2 = 3.2.
    EXPECT_GT(signedVolume(hull, seeds), 1.5) << seed;
    EXPECT_LT(signedVolume(hull, seeds), 3.5) << seed;
  }
}

/** Random labels leave pieces of any shape, with holes in them. */
TEST(ClusterHull, KeepsTheGenusWhateverTheRegions)
{
  for (const auto& [surface, expected] :
       {std::make_pair(makeSphere(3), 2L), std::make_pair(makeTorus(), 0L)})
    for (const std::uint32_t labels : {2u, 3u, 10u})
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        Labels regions;
        for (std::size_t i = 0; i < surface.places.size(); ++i)
          regions.push_back(static_cast<std::uint32_t>(uniformAt(seed, i, 0) * labels));
        const ClusterHull hull = makeClusterHull(surface.triangles, regions);
        expectClosed(hull);
        EXPECT_EQ(expected, eulerCharacteristic(hull)) << labels << ", " << seed;
      }
}

TEST(ClusterHull, CutsRegionsThatReachAroundATube)
{
  const Surface torus = makeTorus();
  Labels labels;
  for (std::uint32_t i = 0; i < torus.places.size(); ++i)
    labels.push_back(i / around_tube / 15); // six sectors
  const ClusterHull hull = makeClusterHull(torus.triangles, labels);
  EXPECT_GE(hull.split_pieces, 6u);
  EXPECT_EQ(6u + hull.split_pieces, hull.regions.size());
  expectClosed(hull);
  EXPECT_EQ(0, eulerCharacteristic(hull));
}

TEST(ClusterHull, CutsABeltBetweenTwoCaps)
{
  const Surface sphere = makeSphere(3);
  const Labels labels = labelBy(sphere, [](const Eigen::Vector3d& place) {
    return place.z() > 0.5 ? 2u : place.z() < -0.5 ? 1u : 0u;
  });
  const ClusterHull hull = makeClusterHull(sphere.triangles, labels);
  EXPECT_EQ(1u, hull.split_pieces);
  // Each cap meets the two halves of the belt at two places.
  EXPECT_EQ(4u, hull.regions.size());
  EXPECT_EQ(4u, hull.triangles.size());
  EXPECT_EQ(2, std::count(hull.regions.begin(), hull.regions.end(), 0u));
  expectClosed(hull);
}

/** As the two sides of a thin sheet. */
TEST(ClusterHull, HasAVertexPerPieceOfARegion)
{
  const Surface sphere = makeSphere(3);
  const auto sectorOf = [](const Eigen::Vector3d& place) {
    return static_cast<std::uint32_t>(
        std::floor((std::atan2(place.y(), place.x()) / pi + 1.0) * 1.999999));
  };
  const Labels labels = labelBy(sphere, [&](const Eigen::Vector3d& place) {
    return std::abs(place.z()) > 0.5 ? 9u : sectorOf(place);
  });
  const ClusterHull hull = makeClusterHull(sphere.triangles, labels);
  EXPECT_EQ(0u, hull.split_pieces);
  EXPECT_EQ(6u, hull.regions.size());
  EXPECT_EQ(2, std::count(hull.regions.begin(), hull.regions.end(), 9u));
  EXPECT_EQ(8u, hull.triangles.size());
  expectClosed(hull);
}

/** Two triangles, back to back: three edges that each have two triangles. */
TEST(ClusterHull, OfThreeSectorsIsATriangleOfTwoSides)
{
  const Surface sphere = makeSphere(3);
  const Labels labels = labelBy(sphere, [](const Eigen::Vector3d& place) {
    return static_cast<std::uint32_t>(
        std::floor((std::atan2(place.y(), place.x()) / pi + 1.0) * 1.499999));
  });
  const ClusterHull hull = makeClusterHull(sphere.triangles, labels);
  ASSERT_EQ(3u, hull.regions.size());
  ASSERT_EQ(2u, hull.triangles.size());
  expectClosed(hull);
  EXPECT_EQ(2, eulerCharacteristic(hull));
}

TEST(ClusterHull, OfFewerThanThreeRegionsIsEmpty)
{
  const Surface sphere = makeSphere(2);
  const auto expectEmpty = [&](const Labels& labels) {
    const ClusterHull hull = makeClusterHull(sphere.triangles, labels);
    EXPECT_TRUE(hull.triangles.empty());
    EXPECT_TRUE(hull.regions.empty());
    EXPECT_EQ(0u, hull.split_pieces);
  };
  expectEmpty(Labels(sphere.places.size(), 7u));
  expectEmpty(labelBy(
      sphere, [](const Eigen::Vector3d& place) { return place.x() > 0.3 ? 1u : 0u; }));
}

/** There are two spheres, the first one of a single region. */
TEST(ClusterHull, LeavesOutComponentsOfFewRegions)
{
  const Surface sphere = makeSphere(2);
  const auto count = static_cast<std::uint32_t>(sphere.places.size());
  std::vector<Triangle> triangles = sphere.triangles;
  for (const Triangle& t : sphere.triangles)
    triangles.push_back({{t[0] + count, t[1] + count, t[2] + count}});
  Labels labels(count, 5u);
  const Labels others = nearestOf(sphere, makeIcosahedron().places);
  labels.insert(labels.end(), others.begin(), others.end());
  const ClusterHull hull = makeClusterHull(triangles, labels);
  EXPECT_EQ(20u, hull.triangles.size());
  EXPECT_EQ(12u, hull.regions.size());
  expectClosed(hull);
  // Two components that hold the same regions give a hull each.
  labels = others;
  labels.insert(labels.end(), others.begin(), others.end());
  const ClusterHull both = makeClusterHull(triangles, labels);
  EXPECT_EQ(40u, both.triangles.size());
  EXPECT_EQ(24u, both.regions.size());
}

TEST(ClusterHull, DoesNotDependOnLabels)
{
  const Surface torus = makeTorus();
  Labels labels = nearestOf(torus, randomSeeds(torus, 25, 4));
  const ClusterHull before = makeClusterHull(torus.triangles, labels);
  EXPECT_GT(before.split_pieces, 0u);
  const auto rename = [](std::uint32_t label) { return 4000000000u - 17u * label; };
  std::transform(labels.begin(), labels.end(), labels.begin(), rename);
  const ClusterHull after = makeClusterHull(torus.triangles, labels);
  EXPECT_EQ(before.triangles, after.triangles);
  EXPECT_EQ(before.split_pieces, after.split_pieces);
  Labels renamed = before.regions;
  std::transform(renamed.begin(), renamed.end(), renamed.begin(), rename);
  EXPECT_EQ(renamed, after.regions);
}

TEST(ClusterHull, IgnoresVerticesWithoutTriangles)
{
  const Surface surface = makeOctahedron();
  const ClusterHull hull =
      makeClusterHull(surface.triangles, {0, 1, 2, 3, 4, 5, 6, 6, 0});
  EXPECT_EQ(8u, hull.triangles.size());
  EXPECT_EQ(6u, hull.regions.size());
  EXPECT_TRUE(makeClusterHull({}, {}).triangles.empty());
  EXPECT_TRUE(makeClusterHull({}, {1, 2, 3}).regions.empty());
}

TEST(ClusterHull, RefusesVerticesWithoutRegion)
{
  const Surface surface = makeOctahedron();
  EXPECT_THROW(makeClusterHull(surface.triangles, {}), InvalidArgument);
  try {
    makeClusterHull(surface.triangles, {0, 1, 2, 3, 4});
    ADD_FAILURE();
  }
  catch (const InvalidArgument& error) {
    EXPECT_NE(std::string::npos, error.message().find("vertex 5"));
  }
}

} // namespace test_cluster_hull
