// SPDX-License-Identifier: BSD-3-Clause
// Triangles that go through one another: exact signs, all the ways to touch, and meshes
// that do or do not.
#include "measured_shapes.h"
#include "mesh/exact_signs.h"
#include "mesh/self_intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace test_self_intersections {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;
using namespace uvol_test;
using Place = Eigen::Vector3d;

TEST(ExactSigns, HoldWhereRoundingDoesNot)
{
  // A line of slope 1, and places beside it by the last digit.
  const Place a(12.0, 12.0, 0.0), b(24.0, 24.0, 0.0);
  for (int i = -20; i <= 20; ++i)
    for (int k = -20; k <= 20; ++k) {
      const double x = 0.5 + i * 0x1p-53, y = 0.5 + k * 0x1p-53;
      const Place c(x, y, 0.0);
      const int side = y > x ? 1 : y < x ? -1 : 0;
      ASSERT_EQ(side, signOfArea(a, b, c, 2)) << i << ' ' << k;
      ASSERT_EQ(-side, signOfArea(b, a, c, 2)) << i << ' ' << k;
      ASSERT_EQ(side, signOfArea(b, c, a, 2)) << i << ' ' << k;
      ASSERT_EQ(side, signOfArea(c, a, b, 2)) << i << ' ' << k;
      // The same as a plane that holds the z axis.
      ASSERT_EQ(-side, signOfVolume(a, b, Place(0.0, 0.0, 5.0), c)) << i << ' ' << k;
    }
}

TEST(ExactSigns, HaveTheSignOfTheirName)
{
  const Place o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(1, signOfArea(o, x, y, 2));
  EXPECT_EQ(1, signOfArea(o, y, z, 0));
  EXPECT_EQ(1, signOfArea(o, z, x, 1));
  EXPECT_EQ(0, signOfArea(o, x, y, 0));
  EXPECT_EQ(1, signOfVolume(o, x, y, z));
  EXPECT_EQ(-1, signOfVolume(o, y, x, z));
  EXPECT_EQ(0, signOfVolume(o, x, y, Place(7, -3, 0)));
}

TEST(ExactSigns, ScalesAreNoLimit)
{
  for (const double scale : {0x1p-140, 0x1p-40, 1.0, 0x1p120}) {
    const Place a(scale, 0, 0), b(0, 3 * scale, 0), c(0, 0, scale);
    // In the plane x + y / 3 + z = scale, and a digit above it.
    const Place within(0.25 * scale, 1.5 * scale, 0.25 * scale);
    const Place above(0.25 * scale, 1.5 * scale, 0.25 * scale * (1.0 + 0x1p-52));
    EXPECT_EQ(0, signOfVolume(a, b, c, within));
    EXPECT_EQ(1, signOfVolume(a, b, c, above));
    EXPECT_EQ(-1, signOfVolume(b, a, c, above));
  }
  // Beside coordinates that are larger by more than double has digits.
  EXPECT_EQ(1,
            signOfVolume(Place(0x1p100, 0, 0),
                         Place(0, 0x1p100, 0),
                         Place(-0x1p100, 0, 0),
                         Place(0, 0, 0x1p-100)));
}

/** Triangles 0 1 2 and the next three places. */
bool
intersect(const std::vector<Place>& places)
{
  const bool one = doIntersect(places, {0, 1, 2}, {3, 4, 5});
  EXPECT_EQ(one, doIntersect(places, {3, 4, 5}, {0, 1, 2}));
  EXPECT_EQ(one, doIntersect(places, {2, 1, 0}, {4, 5, 3}));
  return one;
}

TEST(SelfIntersections, TrianglesApartTouchAndCross)
{
  const Place a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_TRUE(intersect({a, b, c, {1, 1, -1}, {1, 1, 1}, {9, 9, 0.5}}));
  EXPECT_FALSE(intersect({a, b, c, {3, 3, -1}, {3, 3, 1}, {9, 9, 0.5}}));
  EXPECT_FALSE(intersect({a, b, c, {1, 1, 1}, {2, 1, 1}, {1, 2, 1}}));
  // A tip in the face, on an edge, at a corner, and a digit above the face.
  EXPECT_TRUE(intersect({a, b, c, {1, 1, 0}, {2, 1, 1}, {1, 2, 1}}));
  EXPECT_TRUE(intersect({a, b, c, {2, 0, 0}, {2, 1, 1}, {1, 2, 1}}));
  EXPECT_TRUE(intersect({a, b, c, {4, 0, 0}, {5, 1, 1}, {5, 2, 1}}));
  EXPECT_FALSE(intersect({a, b, c, {1, 1, 1e-300}, {2, 1, 1}, {1, 2, 1}}));
  // An edge through an edge.
  EXPECT_TRUE(intersect({a, b, c, {2, -1, 0}, {2, 1, 0}, {2, 0, 3}}));
  EXPECT_TRUE(intersect({a, b, c, {2, 0, -1}, {2, 0, 1}, {2, -3, 0}}));
}

TEST(SelfIntersections, InOnePlane)
{
  const Place a(0, 0, 2), b(4, 0, 2), c(0, 4, 2);
  EXPECT_TRUE(intersect({a, b, c, {1, 1, 2}, {1.5, 1, 2}, {1, 1.5, 2}}));   // within
  EXPECT_TRUE(intersect({a, b, c, {-9, -9, 2}, {99, -9, 2}, {-9, 99, 2}})); // around
  EXPECT_TRUE(intersect({a, b, c, {3, 3, 2}, {1, 1, 2}, {3, 4, 2}}));
  EXPECT_TRUE(intersect({a, b, c, {-1, 1, 2}, {5, 1, 2}, {5, 1.5, 2}})); // across
  EXPECT_TRUE(intersect({a, b, c, {2, 0, 2}, {3, -1, 2}, {2, -1, 2}}));  // touches
  EXPECT_TRUE(intersect({a, b, c, {1, 0, 2}, {3, 0, 2}, {2, -1, 2}})); // along an edge
  EXPECT_FALSE(intersect({a, b, c, {3, 3, 2}, {5, 3, 2}, {3, 5, 2}}));
  EXPECT_FALSE(intersect({a, b, c, {5, 0, 2}, {7, 0, 2}, {6, -1, 2}})); // on one line
}

TEST(SelfIntersections, NeighborsShareWhatTheyShare)
{
  const std::vector<Place> places = {{0, 0, 0},
                                     {4, 0, 0},
                                     {0, 4, 0},
                                     {0, -4, 0},
                                     {1, 3, 0},
                                     {1, 1, 5},
                                     {1, 1, -5},
                                     {-3, 0, 0},
                                     {0, -3, 1}};
  EXPECT_FALSE(doIntersect(places, {0, 1, 2}, {1, 0, 3})); // flat
  EXPECT_TRUE(doIntersect(places, {0, 1, 2}, {1, 0, 4}));  // folded over
  EXPECT_FALSE(doIntersect(places, {0, 1, 2}, {1, 0, 5})); // steep
  EXPECT_TRUE(doIntersect(places, {0, 1, 2}, {0, 5, 6}));  // through, at a corner
  EXPECT_FALSE(doIntersect(places, {0, 1, 2}, {0, 7, 8}));
  EXPECT_FALSE(doIntersect(places, {0, 1, 2}, {0, 7, 3})); // in one plane, apart
  EXPECT_TRUE(doIntersect(places, {0, 1, 2}, {0, 4, 7}));  // in one plane, on it
  EXPECT_TRUE(doIntersect(places, {0, 1, 2}, {2, 0, 1}));  // the same
  EXPECT_FALSE(doIntersect(places, {0, 1, 1}, {0, 5, 6})); // a line
}

TEST(SelfIntersections, AgreeWithPlacesOnBothSides)
{
  // Random triangles: they intersect where an edge passes through the other one, as
  // computed in double, which is right but for a few in many millions.
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  int crossing = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<Place> p;
    for (int k = 0; k < 6; ++k) {
      const double x = any(random), y = any(random);
      p.emplace_back(x, y, any(random));
    }
    bool does = false;
    for (const int first : {0, 3})
      for (int k = 0; k < 3; ++k) {
        const Place &u = p[static_cast<std::size_t>(first + k)],
                    &v = p[static_cast<std::size_t>(first + (k + 1) % 3)],
                    &a = p[static_cast<std::size_t>(3 - first)],
                    &b = p[static_cast<std::size_t>(4 - first)],
                    &c = p[static_cast<std::size_t>(5 - first)];
        Eigen::Matrix3d system;
        system << b - a, c - a, u - v;
        const Eigen::Vector3d at = system.inverse() * (u - a);
        does |=
            at[0] >= 0 && at[1] >= 0 && at[0] + at[1] <= 1 && at[2] >= 0 && at[2] <= 1;
      }
    EXPECT_EQ(does, intersect(p));
    crossing += does;
  }
  EXPECT_GT(crossing, 500);
}

std::size_t
countAllPairs(const std::vector<Place>& places, const std::vector<Triangle>& triangles)
{
  std::size_t all = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      all += doIntersect(places, triangles[i], triangles[k]);
  return all;
}

TEST(SelfIntersections, AreFoundInMeshes)
{
  pcl_uvol::Report report;
  const MeasuredShape good = makeTorus(3.0, 1.0, 40, 16);
  EXPECT_TRUE(
      findSelfIntersections(good.places, good.triangles, {}, 3, report).empty());
  EXPECT_TRUE(
      findSelfIntersections(
          makeBox({1, 1, 1}).places, makeBox({1, 1, 1}).triangles, {}, 1, report)
          .empty());
  const MeasuredShape spindle = makeTorus(1.0, 2.0, 40, 16); // overlaps in the middle
  const auto pairs =
      findSelfIntersections(spindle.places, spindle.triangles, {}, 3, report);
  EXPECT_GT(pairs.size(), 40u);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  EXPECT_EQ(pairs,
            findSelfIntersections(spindle.places, spindle.triangles, {}, 1, report));
  EXPECT_EQ(countAllPairs(spindle.places, spindle.triangles), pairs.size());
  // Surfaces of several isovalues may do as they like.
  MeasuredShape boxes = makeBox({1, 1, 1});
  boxes.append(boxes);
  std::vector<double> isovalues(16, 1.0);
  EXPECT_FALSE(
      findSelfIntersections(boxes.places, boxes.triangles, isovalues, 1, report)
          .empty());
  std::fill(isovalues.begin() + 8, isovalues.end(), 2.0);
  EXPECT_TRUE(findSelfIntersections(boxes.places, boxes.triangles, isovalues, 1, report)
                  .empty());
}

TEST(SelfIntersections, ManyTrianglesMayShareAVertex)
{
  constexpr std::uint32_t count = 30000;
  std::vector<Place> places = {{0, 0, 1}};
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count;
    places.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    triangles.push_back({0, i + 1, (i + 1) % count + 1});
  }
  pcl_uvol::Report report;
  EXPECT_TRUE(findSelfIntersections(places, triangles, {}, 2, report).empty());
  std::vector<Triangle> closed = triangles; // by a second vertex that all share
  places.push_back({0, 0, -1});
  for (const Triangle& triangle : triangles)
    closed.push_back({count + 1, triangle[2], triangle[1]});
  EXPECT_TRUE(findSelfIntersections(places, closed, {}, 2, report).empty());
  // A blade that stands in the cone cuts all triangles of a sector, and none twice.
  places.insert(places.end(), {{0.9, 0.0, 0.2}, {0.0, 0.9, 0.2}});
  triangles.push_back({0, count + 2, count + 3});
  const auto pairs = findSelfIntersections(places, triangles, {}, 2, report);
  std::size_t all = 0;
  for (std::uint32_t i = 0; i < count; ++i)
    all += doIntersect(places, triangles[i], triangles[count]);
  EXPECT_EQ(all, pairs.size());
  EXPECT_GT(all, 0u);
}

TEST(SelfIntersections, AreThoseOfAllPairs)
{
  // Few places on a small lattice: triangles share corners and edges, lie on one
  // another, in one plane, or have no area.
  std::mt19937_64 random(11);
  for (const std::uint32_t count : {5u, 9u, 30u, 80u}) {
    for (const double shift : {0.0, 1e6}) {
      std::vector<Place> places;
      for (std::uint32_t i = 0; i < count; ++i)
        places.emplace_back(shift + static_cast<double>(random() % 4),
                            static_cast<double>(random() % 5),
                            0.1 * static_cast<double>(random() % 3));
      std::vector<Triangle> triangles(150);
      for (Triangle& triangle : triangles)
        for (std::uint32_t& corner : triangle)
          corner = static_cast<std::uint32_t>(random() % count);
      pcl_uvol::Report report;
      const auto pairs = findSelfIntersections(places, triangles, {}, 2, report);
      EXPECT_EQ(countAllPairs(places, triangles), pairs.size());
      for (const auto& [lower, higher] : pairs) {
        EXPECT_LT(lower, higher);
        EXPECT_TRUE(doIntersect(places, triangles[lower], triangles[higher]));
      }
      EXPECT_EQ(pairs.end(), std::adjacent_find(pairs.begin(), pairs.end()));
    }
  }
}

TEST(SelfIntersections, ManyTrianglesMayShareAnEdge)
{
  // Pages of a book in no order, and a few in the directions of others, but longer.
  constexpr std::uint32_t count = 30000;
  std::vector<Place> places = {{0, 0, 0}, {0, 0, 1}};
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * (i * 7919 % count) / count;
    places.emplace_back(std::cos(angle), std::sin(angle), 0.5);
    triangles.push_back({0, 1, i + 2});
  }
  pcl_uvol::Report report;
  EXPECT_TRUE(findSelfIntersections(places, triangles, {}, 2, report).empty());
  for (const std::uint32_t page : {0u, 7000u, 29999u}) {
    const Place tip = 2.0 * places[page + 2];
    places.push_back(tip);
    triangles.push_back({1, static_cast<std::uint32_t>(places.size()) - 1, 0});
  }
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(Pairs({{0, count}, {7000, count + 1}, {29999, count + 2}}),
            findSelfIntersections(places, triangles, {}, 2, report));
}

TEST(SelfIntersections, HaveABoundWhereAllLieOnOneAnother)
{
  const std::vector<Place> places = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Triangle> triangles(1000, {0, 1, 2});
  pcl_uvol::Report report;
  EXPECT_EQ(499500u, findSelfIntersections(places, triangles, {}, 2, report).size());
  triangles.resize(30000, {0, 1, 1}); // lines, which intersect nothing
  EXPECT_EQ(499500u, findSelfIntersections(places, triangles, {}, 2, report).size());
  triangles.resize(60000, {0, 1, 2});
  EXPECT_THROW(findSelfIntersections(places, triangles, {}, 2, report),
               InvalidArgument);
}

} // namespace test_self_intersections
