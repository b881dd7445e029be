// SPDX-License-Identifier: BSD-3-Clause
// Positions that fall together in float are told, equal ones are not.
#include "src/common/merged_positions.h"
#include "support/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace test_merged_positions {

using pcl_uvol::describe;
using pcl_uvol::MergedPositions;
using Exact = std::array<double, 3>;

MergedPositions
find(const std::vector<Exact>& points, const Exact& origin = {})
{
  return pcl_uvol::findMergedPositions(
      points.size(), [&](std::size_t i) { return points[i]; }, origin);
}

TEST(MergedPositions, AreThoseOfASearchThroughAllPairs)
{
  // Eighths of the distance of floats at 1: many positions are equal, many are merged.
  const double step = 0x1p-26;
  std::mt19937 random(5);
  const Exact origin{0.5, 0.0, -1.0};
  std::vector<Exact> points;
  for (int i = 0; i < 3000; ++i) {
    Exact point{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = origin[axis] + 1.0 + step * static_cast<double>(random() % 24);
    points.push_back(point);
  }
  std::map<std::array<float, 3>, std::set<Exact>> cells;
  for (const Exact& point : points) {
    std::array<float, 3> rounded;
    for (std::size_t axis = 0; axis < 3; ++axis)
      rounded[axis] = static_cast<float>(point[axis] - origin[axis]);
    cells[rounded].insert(point);
  }
  std::uint64_t expected = 0;
  for (const auto& cell : cells)
    expected += cell.second.size() - 1;
  ASSERT_GT(expected, 1000u);
  const MergedPositions merged = find(points, origin);
  EXPECT_EQ(expected, merged.count);
  EXPECT_GT(merged.distance, step);
  EXPECT_LE(merged.distance, std::sqrt(3.0) * 0x1p-23);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(expected, find(points, origin).count);
}

TEST(MergedPositions, AreNotLookedForAmongFloats)
{
  std::mt19937 random(5);
  const Exact origin{0.5, 0.0, -1.0};
  std::vector<Exact> points;
  for (int i = 0; i < 1000; ++i) {
    Exact point;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = origin[axis] + static_cast<float>(random() % 64) / 8.0f;
    points.push_back(point);
  }
  std::size_t looks = 0;
  const auto count = [&](std::size_t i) {
    ++looks;
    return points[i];
  };
  EXPECT_EQ(0u, pcl_uvol::findMergedPositions(points.size(), count, origin).count);
  EXPECT_EQ(points.size(), looks);
  // A single double among them, next to a float.
  points.back() = points.front();
  points.back()[0] += 1e-12;
  EXPECT_EQ(1u, pcl_uvol::findMergedPositions(points.size(), count, origin).count);
}

TEST(MergedPositions, AreNotThoseThatAreEqualAnywayNorWhatIsNoPosition)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Exact> points{{1.0, 2.0, 3.0},
                                  {1.0, 2.0, 3.0},
                                  {nan, 0.0, 0.0},
                                  {nan, 1.0, 0.0},
                                  {-0.0, 0, 0},
                                  {0, 0, 0}};
  EXPECT_EQ(0u, find(points).count);
  EXPECT_FALSE(describe(find(points)));
  EXPECT_EQ(0u, find({}).count);
}

TEST(MergedPositions, AreDescribedByNumberAndDistance)
{
  const auto message = describe(find({{1.0, 0.0, 0.0}, {1.0 + 1e-9, 0.0, 0.0}}));
  ASSERT_TRUE(message);
  EXPECT_EQ("merged_positions", message->code);
  EXPECT_EQ(1.0, uvol_test::numberOf(*message, "positions"));
  EXPECT_NEAR(1e-9, uvol_test::numberOf(*message, "distance"), 1e-15);
}

} // namespace test_merged_positions
