// SPDX-License-Identifier: BSD-3-Clause
// Edges index the points that they end at.
#include "isosurface/edge_ends.h"
#include "support/environment.h"

#include <gtest/gtest.h>

#include <set>

namespace test_edge_ends {

using pcl_uvol::GlobalIsopoint;

TEST(EdgeEnds, AreNumberedOnceInTheirOrder)
{
  uvol_test::Random random(3);
  std::vector<std::vector<GlobalIsopoint>> isopoints(3); // the last isovalue has none
  std::set<std::uint64_t> points;
  for (std::size_t i = 0; i < 100; ++i) {
    GlobalIsopoint isopoint{};
    isopoint.first =
        (std::uint64_t(1) << 40) * static_cast<unsigned>(9.0 * random.uniform());
    isopoint.second = 7 + isopoint.first;
    isopoint.t = static_cast<float>(i);
    points.insert({isopoint.first, isopoint.second});
    isopoints[i % 2].push_back(isopoint);
  }
  const auto ends = findEdgeEnds(isopoints);
  EXPECT_EQ(std::vector<std::uint64_t>(points.begin(), points.end()), ends.points);
  ASSERT_EQ(100u, ends.edges.size());
  auto edge = ends.edges.begin();
  for (const auto& part : isopoints)
    for (const GlobalIsopoint& isopoint : part) {
      EXPECT_EQ(isopoint.first, ends.points.at(edge->first));
      EXPECT_EQ(isopoint.second, ends.points.at(edge->second));
      EXPECT_EQ(isopoint.t, (edge++)->t);
    }
}

TEST(EdgeEnds, OfNothingAreNone)
{
  const auto ends = pcl_uvol::findEdgeEnds({{}, {}});
  EXPECT_TRUE(ends.points.empty());
  EXPECT_TRUE(ends.edges.empty());
}

} // namespace test_edge_ends
