// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces that are followed through a lattice, against a look at all of its cells.
#include "pipeline/lattice_band.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace test_lattice_band {

using pcl_uvol::detail::LatticeBand;
using pcl_uvol::detail::LatticeNode;
using pcl_uvol::detail::NodeValue;

constexpr int side = 12; ///< of the cube of cells around 0 that an oracle looks at

double
distanceOf(const LatticeNode& node)
{
  return std::hypot(node[0] + 0.3, node[1] - 0.2, node[2] + 0.1);
}

/** The distance from near 0; none beyond x = 5. */
std::vector<NodeValue>
evaluate(const std::vector<LatticeNode>& nodes)
{
  std::vector<NodeValue> values;
  for (const LatticeNode& node : nodes)
    values.push_back(
        {node[0] > 5 ? std::numeric_limits<double>::quiet_NaN() : distanceOf(node),
         node[2] != 3});
  return values;
}

std::vector<LatticeNode>
cornersOf(const LatticeNode& cell)
{
  std::vector<LatticeNode> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(
        {cell[0] + (i & 1), cell[1] + ((i >> 1) & 1), cell[2] + (i >> 2)});
  return corners;
}

bool
isCrossed(const LatticeNode& cell, double isovalue)
{
  std::size_t above = 0;
  for (const NodeValue& node : evaluate(cornersOf(cell))) {
    if (std::isnan(node.value))
      return false;
    above += node.value >= isovalue;
  }
  return above > 0 && above < 8;
}

std::set<LatticeNode>
findByLooking(double isovalue)
{
  std::set<LatticeNode> nodes;
  for (int z = -side; z < side; ++z)
    for (int y = -side; y < side; ++y)
      for (int x = -side; x < side; ++x)
        if (isCrossed({x, y, z}, isovalue))
          for (int i = 0; i < 27; ++i)
            for (const LatticeNode& node :
                 cornersOf({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1}))
              if (node[0] <= 5 && node[2] != 3)
                nodes.insert(node);
  return nodes;
}

TEST(LatticeBand, FollowsASphereToWhereValuesEnd)
{
  LatticeBand band(evaluate, 100000);
  ASSERT_TRUE(band.follow({{-7, 0, 0}}, 6.5));
  std::set<LatticeNode> found;
  for (const auto& [node, value] : band.listNodes()) {
    EXPECT_EQ(distanceOf(node), value);
    EXPECT_TRUE(found.empty() || *found.rbegin() < node);
    found.insert(node);
  }
  EXPECT_EQ(findByLooking(6.5), found);
}

TEST(LatticeBand, CollectsSeveralSurfaces)
{
  LatticeBand band(evaluate, 100000);
  ASSERT_TRUE(band.follow({{-7, 0, 0}}, 6.5));
  ASSERT_TRUE(band.follow({{0, 2, 0}, {0, -3, 0}}, 2.5));
  std::set<LatticeNode> expected = findByLooking(6.5), found;
  expected.merge(findByLooking(2.5));
  for (const auto& [node, value] : band.listNodes())
    found.insert(node);
  EXPECT_EQ(expected, found);
}

TEST(LatticeBand, EndsWhereNodesAreTooMany)
{
  LatticeBand band(evaluate, 500);
  EXPECT_FALSE(band.follow({{-7, 0, 0}}, 6.5));
}

TEST(LatticeBand, FindsNothingFarFromTheSurface)
{
  LatticeBand band(evaluate, 100000);
  EXPECT_TRUE(band.follow({{0, 0, 0}}, 6.5));
  EXPECT_TRUE(band.listNodes().empty());
}

} // namespace test_lattice_band
