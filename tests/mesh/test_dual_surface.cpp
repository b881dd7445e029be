// SPDX-License-Identifier: BSD-3-Clause
// The surface between cells is closed, without branches and oriented for any samples:
// corners against those of boxes of ranks, by trying all.
#include "src/mesh/cell_tiling.h"
#include "src/mesh/dual_surface.h"
#include "src/neighbors/sample_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace test_dual_surface {

using namespace pcl_uvol;
using detail::CellCache;
using detail::CellPair;
using detail::CellTiling;

/** A cell as an interval of plane ranks per axis; ghosts lie beyond all. */
struct RankBox {
  int low[3], high[3];
};

/** Samples of small integer coordinates, so that many are equal along some axis. */
SampleSet::ConstPtr
makeSamples(
    std::size_t count, int values, int dimensions, unsigned seed, SplitRule rule)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> any(0, values - 1);
  std::vector<Position> places(count, Position{{0.5f, 0.25f, 2.0f}});
  for (Position& place : places)
    for (int axis = 0; axis < dimensions; ++axis)
      place[axis] = static_cast<float>(any(random));
  std::vector<std::uint32_t> use(count);
  std::iota(use.begin(), use.end(), 0u);
  Report report;
  return SampleSet::build(
      places.front().x, 3, use, {{1.0f, 1.0f, 1.0f}}, 1, report, rule);
}

/** The boxes of all cells and ghosts, by ranks of the planes that split nodes. */
std::vector<RankBox>
rankBoxes(const SampleSet& samples)
{
  const KdTree& tree = samples.getTree();
  std::vector<SplitPlane> planes[3];
  const auto less = [&](int axis) {
    return [&, axis](const SplitPlane& a, const SplitPlane& b) {
      return KdTree::isBelow(samples.getPositions(), axis, a, b);
    };
  };
  const auto collect = [&](const auto& self, const KdNode& node) -> void {
    if (node.isLeaf())
      return;
    planes[tree.getAxis(node)].push_back(tree.getPlane(node));
    self(self, node.left());
    self(self, node.right());
  };
  collect(collect, tree.getRoot());
  RankBox all;
  for (int axis = 0; axis < 3; ++axis) {
    auto& of_axis = planes[axis];
    std::sort(of_axis.begin(), of_axis.end(), less(axis));
    all.low[axis] = 0;
    all.high[axis] = static_cast<int>(of_axis.size()) + 1;
  }
  const auto rankOf = [&](int axis, const SplitPlane& plane) {
    return static_cast<int>(
               std::lower_bound(
                   planes[axis].begin(), planes[axis].end(), plane, less(axis)) -
               planes[axis].begin()) +
           1;
  };
  std::vector<RankBox> boxes;
  const auto place = [&](const auto& self, const KdNode& node, RankBox box) -> void {
    if (node.isLeaf()) {
      boxes.push_back(box);
      return;
    }
    const int axis = tree.getAxis(node), rank = rankOf(axis, tree.getPlane(node));
    RankBox left = box, right = box;
    left.high[axis] = right.low[axis] = rank;
    self(self, node.left(), left);
    self(self, node.right(), right);
  };
  place(place, tree.getRoot(), all);
  for (int axis = 0; axis < 3; ++axis)
    for (const bool is_high : {false, true}) {
      RankBox ghost = all;
      for (int other = 0; other < 3; ++other)
        if (other != axis) {
          --ghost.low[other];
          ++ghost.high[other];
        }
      ghost.low[axis] = is_high ? all.high[axis] : all.low[axis] - 1;
      ghost.high[axis] = ghost.low[axis] + 1;
      boxes.push_back(ghost);
    }
  return boxes;
}

/** How many axes the common part of closed boxes extends along; -1: there is none. */
int
dimensionOfCommonPart(const std::vector<RankBox>& boxes,
                      const std::vector<std::uint32_t>& cells)
{
  int dimension = 0;
  for (int axis = 0; axis < 3; ++axis) {
    int low = boxes[cells[0]].low[axis], high = boxes[cells[0]].high[axis];
    for (const std::uint32_t cell : cells) {
      low = std::max(low, boxes[cell].low[axis]);
      high = std::min(high, boxes[cell].high[axis]);
    }
    if (low > high)
      return -1;
    dimension += low < high;
  }
  return dimension;
}

using Cells = std::vector<std::uint32_t>;

/** Corners and touching pairs by trying all; a corner of ghosts alone does not count.
 */
struct Nerve {
  std::set<Cells> corners;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
};

Nerve
findNerve(const std::vector<RankBox>& boxes)
{
  const auto samples = static_cast<std::uint32_t>(boxes.size()) - 6;
  std::vector<Cells> touching(boxes.size());
  Nerve nerve;
  for (std::uint32_t a = 0; a < samples; ++a)
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
      if (dimensionOfCommonPart(boxes, {a, b}) >= 0) {
        EXPECT_EQ(2, dimensionOfCommonPart(boxes, {a, b}));
        touching[a].push_back(b);
        nerve.pairs.insert({a, b});
      }
  for (std::uint32_t a = 0; a < samples; ++a)
    for (const std::uint32_t b : touching[a])
      for (const std::uint32_t c : touching[a])
        for (const std::uint32_t d : touching[a])
          if (b < c && c < d && dimensionOfCommonPart(boxes, {a, b, c, d}) == 0)
            nerve.corners.insert({a, b, c, d});
  return nerve;
}

/** Twice the product of the directions in which the corner's cells lie: positive for a
 * tetrahedron of the same orientation. */
double
orientationOf(const std::vector<RankBox>& boxes, const Cells& corner)
{
  // Where the middles of the cells' parts close to the corner lie.
  std::array<std::array<double, 3>, 4> x;
  for (int axis = 0; axis < 3; ++axis) {
    int low = boxes[corner[0]].low[axis], high = boxes[corner[0]].high[axis];
    for (const std::uint32_t cell : corner) {
      low = std::max(low, boxes[cell].low[axis]);
      high = std::min(high, boxes[cell].high[axis]);
    }
    EXPECT_EQ(low, high);
    for (std::size_t i = 0; i < 4; ++i)
      x[i][static_cast<std::size_t>(axis)] =
          0.5 * ((boxes[corner[i]].high[axis] > high) -
                 static_cast<int>(boxes[corner[i]].low[axis] < low));
  }
  double row[3][3];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      row[i][axis] = x[i + 1][axis] - x[0][axis];
  return row[0][0] * (row[1][1] * row[2][2] - row[1][2] * row[2][1]) -
         row[0][1] * (row[1][0] * row[2][2] - row[1][2] * row[2][0]) +
         row[0][2] * (row[1][0] * row[2][1] - row[1][1] * row[2][0]);
}

TEST(CellTiling, RingsAreThoseOfTheNerve)
{
  unsigned seed = 0;
  for (const SplitRule rule : {SplitRule::Cycle, SplitRule::LongestSide})
    for (const int dimensions : {1, 2, 3})
      for (const int values : {2, 3, 5, 1000})
        for (const std::size_t count : {1u, 2u, 3u, 5u, 9u, 17u, 40u, 120u}) {
          const auto samples = makeSamples(count, values, dimensions, ++seed, rule);
          const CellTiling tiling(samples->getTree(), samples->getPositions());
          const std::vector<RankBox> boxes = rankBoxes(*samples);
          const Nerve nerve = findNerve(boxes);
          std::set<Cells> met;
          CellCache cache(tiling);
          Cells ring;
          for (const auto& [a, b] : nerve.pairs) {
            tiling.findRing(a, b, cache, ring);
            ASSERT_GE(ring.size(), 3u);
            for (std::size_t k = 0; k < ring.size(); ++k) {
              Cells corner{a, b, ring[(k + 1) % ring.size()], ring[k]};
              ASSERT_GT(orientationOf(boxes, corner), 0.0) << seed;
              std::sort(corner.begin(), corner.end());
              ASSERT_TRUE(nerve.corners.count(corner) == 1) << seed;
              met.insert(corner);
            }
            Cells once = ring;
            std::sort(once.begin(), once.end());
            ASSERT_EQ(once.end(), std::unique(once.begin(), once.end())) << seed;
          }
          ASSERT_EQ(nerve.corners, met) << seed;
        }
}

/** Every edge is walked once in each direction, and the triangles around every vertex
 * follow one another in one round. */
void
expectClosedManifold(const std::vector<Triangle>& triangles, std::size_t vertices)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;
  std::vector<std::size_t> corners(vertices);
  for (const Triangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_new =
          opposite.insert({{triangle[i], triangle[(i + 1) % 3]}, triangle[(i + 2) % 3]})
              .second;
      ASSERT_TRUE(is_new);
      ++corners[triangle[i]];
    }
  std::vector<bool> is_met(vertices);
  for (const auto& [edge, third] : opposite) {
    const auto [center, start] = edge;
    ASSERT_EQ(1u, opposite.count({start, center}));
    if (is_met[center])
      continue;
    is_met[center] = true;
    std::size_t met = 0;
    for (std::uint32_t vertex = start; met == 0 || vertex != start; ++met) {
      ASSERT_LT(met, corners[center]);
      vertex = opposite.at({center, vertex});
    }
    ASSERT_EQ(corners[center], met);
  }
}

TEST(DualSurface, IsAClosedManifoldForAnySides)
{
  unsigned seed = 1000;
  std::size_t triangles_met = 0;
  for (const SplitRule rule : {SplitRule::Cycle, SplitRule::LongestSide})
    for (const int dimensions : {1, 2, 3})
      for (const int values : {2, 4, 1000})
        for (const std::size_t count : {1u, 2u, 4u, 13u, 60u, 400u})
          for (const double part : {0.1, 0.5, 1.0})
            for (const bool ghosts_above : {false, true}) {
              const auto samples = makeSamples(count, values, dimensions, ++seed, rule);
              const CellTiling tiling(samples->getTree(), samples->getPositions());
              std::mt19937 random(seed);
              std::vector<bool> above(samples->size() + 6, ghosts_above);
              for (std::size_t i = 0; i < samples->size(); ++i)
                above[i] = std::uniform_real_distribution<>()(random) <= part;
              const std::vector<RankBox> boxes = rankBoxes(*samples);
              std::vector<CellPair> pairs;
              for (std::uint32_t a = 0; a < samples->size(); ++a)
                for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
                  if (above[a] != above[b] && dimensionOfCommonPart(boxes, {a, b}) >= 0)
                    pairs.push_back({a, b});
              const auto distance = [](const CellPair& a, const CellPair& b) {
                return static_cast<double>((a.lower * 31 + b.higher * 17) % 5);
              };
              const auto isAbove = [&](std::uint32_t cell) { return above[cell]; };
              std::atomic<std::size_t> told = 0;
              const auto tell = [&](std::size_t begin, std::size_t end) {
                told += end - begin;
              };
              const auto triangles =
                  marchTetrahedra(tiling, pairs, isAbove, distance, tell, 1);
              ASSERT_EQ(pairs.size(), told);
              triangles_met += triangles.size();
              expectClosedManifold(triangles, pairs.size());
              if (::testing::Test::HasFatalFailure())
                FAIL() << seed;
              ASSERT_EQ(triangles,
                        marchTetrahedra(tiling, pairs, isAbove, distance, tell, 3));
            }
  EXPECT_GT(triangles_met, 50000u);
}

TEST(DualSurface, LooksFromAboveToBelow)
{
  // One sample above within its ghosts: a box of eight corners.
  const auto samples = makeSamples(1, 2, 3, 1, SplitRule::Cycle);
  const CellTiling tiling(samples->getTree(), samples->getPositions());
  std::vector<CellPair> pairs;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool is_high : {false, true})
      pairs.push_back({0, tiling.getGhost(axis, is_high)});
  const auto triangles = marchTetrahedra(
      tiling,
      pairs,
      [](std::uint32_t cell) { return cell == 0; },
      [](const CellPair&, const CellPair&) { return 1.0; },
      [](std::size_t, std::size_t) {},
      1);
  ASSERT_EQ(8u, triangles.size());
  for (const Triangle& triangle : triangles) {
    // A vertex lies at the end of an axis.
    double x[3][3] = {};
    for (std::size_t i = 0; i < 3; ++i)
      x[i][triangle[i] / 2] = triangle[i] % 2 == 1 ? 1.0 : -1.0;
    const double volume = x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) -
                          x[0][1] * (x[1][0] * x[2][2] - x[1][2] * x[2][0]) +
                          x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0]);
    EXPECT_EQ(1.0, volume);
  }
}

} // namespace test_dual_surface
