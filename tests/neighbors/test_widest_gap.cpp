// SPDX-License-Identifier: BSD-3-Clause
// The gap that a box is cut at, against all rotations of the coordinates one by one.
#include "common/random.h"
#include "neighbors/widest_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_widest_gap {

using pcl_uvol::Gap;
using pcl_uvol::uniformAt;

/** Gaps in front of all samples, from one on: 0 between those that coincide. */
std::vector<double>
rotate(const std::vector<double>& places, double side, std::size_t from)
{
  std::vector<double> gaps;
  for (std::size_t i = from; i < from + places.size(); ++i) {
    const std::size_t at = i % places.size();
    gaps.push_back(at > 0 ? places[at] - places[at - 1]
                          : places[0] + side - places.back());
  }
  return gaps;
}

double
findCut(const std::vector<double>& places, double side, std::size_t most)
{
  std::vector<Gap> gaps =
      pcl_uvol::listGaps(places, places.front() + side - places.back());
  const std::size_t count = gaps.size(), compared = std::min(count, most);
  for (std::size_t i = 0; i < compared; ++i)
    gaps.push_back(gaps[i]);
  return gaps[pcl_uvol::findWidestGap(gaps, count, compared)].place;
}

TEST(WidestGap, IsTheGreatestOfAllRotations)
{
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::size_t count = 1 + seed % 17;
    const double side = 4.0 + static_cast<double>(seed % 5) * 3.0;
    std::vector<double> places; // few different gaps, many that coincide
    for (std::size_t i = 0; i < count; ++i)
      places.push_back(std::floor(uniformAt(seed, i, 0) * side));
    std::sort(places.begin(), places.end());
    std::size_t best = 0;
    for (std::size_t i = 1; i < count; ++i)
      if (rotate(places, side, i) > rotate(places, side, best))
        best = i;
    EXPECT_EQ(places[best], findCut(places, side, 256)) << seed;
  }
}

TEST(WidestGap, IsTheFirstOfThoseThatGoOnAlike)
{
  EXPECT_EQ(0.0, findCut({0.0, 1.0, 2.0, 3.0}, 4.0, 256));
  // From 0 on the coordinate that two samples have comes last.
  const std::vector<double> places{0.0, 1.0, 2.0, 3.0, 3.0};
  EXPECT_EQ(0.0, findCut(places, 4.0, 256));
  EXPECT_EQ(0.0, findCut(places, 4.0, 2));
  EXPECT_EQ(1.0, findCut({0.0, 0.0, 1.0, 2.0, 3.0}, 4.0, 2));
}

} // namespace test_widest_gap
