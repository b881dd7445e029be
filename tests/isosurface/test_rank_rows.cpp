// SPDX-License-Identifier: BSD-3-Clause
// Samples are found wherever they are.
#include "support/environment.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/rank_rows.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cstring>

namespace {

using pcl_uvol::GlobalIsopoint;

/** Points whose intensity is their number. */
pcl::PCLPointCloud2
numbered(std::size_t begin, std::size_t end)
{
  pcl::PointCloud<pcl::PointXYZI> points;
  for (std::size_t i = begin; i < end; ++i) {
    points.push_back({});
    points.back().intensity = static_cast<float>(i);
  }
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  return cloud;
}

float
intensityOf(const pcl::PCLPointCloud2& cloud, std::size_t point)
{
  pcl::PointCloud<pcl::PointXYZI> points;
  pcl::fromPCLPointCloud2(cloud, points);
  return points.at(point).intensity;
}

/** Ranks that hold some points each ask for random ones. */
void
expectFound(const std::vector<std::size_t>& held)
{
  uvol_test::runRanks(held.size(), [&](pcl_uvol::RankGroup& ranks) {
    std::size_t begin = 0, total = 0;
    for (std::size_t rank = 0; rank < held.size(); ++rank) {
      begin += rank < ranks.rank() ? held[rank] : 0;
      total += held[rank];
    }
    const auto own = numbered(begin, begin + held[ranks.rank()]);
    const auto first = pcl_uvol::findFirstRow(own.width, ranks);
    EXPECT_EQ(begin, first);
    std::vector<std::vector<GlobalIsopoint>> isopoints(2);
    uvol_test::Random random(ranks.rank());
    for (std::size_t i = 0; i < 10 * ranks.rank(); ++i) {
      GlobalIsopoint isopoint{};
      isopoint.first =
          static_cast<std::uint64_t>(random.uniform() * static_cast<double>(total));
      isopoint.second = total - 1 - isopoint.first;
      isopoint.t = 0.25f;
      isopoints[i % 2].push_back(isopoint);
    }
    pcl_uvol::Report report;
    const auto rows = fetchRows(own, first, isopoints, ranks, report);
    ASSERT_EQ(isopoints[0].size() + isopoints[1].size(), rows.edges.size());
    EXPECT_LE(rows.cloud.width, total);
    auto edge = rows.edges.begin();
    for (const auto& part : isopoints)
      for (const GlobalIsopoint& isopoint : part) {
        EXPECT_EQ(isopoint.first, intensityOf(rows.cloud, edge->first));
        EXPECT_EQ(isopoint.second, intensityOf(rows.cloud, edge->second));
        EXPECT_EQ(isopoint.t, edge->t);
        ++edge;
      }
  });
}

TEST(RankRows, AreFoundWhereverTheyAre)
{
  expectFound({40});
  expectFound({13, 5, 22});
  expectFound({0, 17, 0, 0, 30, 0});
}

TEST(RankRows, HaveTheFieldsOfThePoints)
{
  uvol_test::runRanks(2, [](pcl_uvol::RankGroup& ranks) {
    pcl_uvol::Report report;
    const auto own = numbered(0, ranks.rank() == 0 ? 3 : 0);
    const auto rows = fetchRows(own, 3 * ranks.rank(), {{}}, ranks, report);
    EXPECT_EQ(0u, rows.cloud.width);
    ASSERT_EQ(own.fields.size(), rows.cloud.fields.size());
    EXPECT_EQ(own.point_step, rows.cloud.point_step);
  });
}

TEST(RankRows, RefusesPointsThatNobodyHas)
{
  EXPECT_THROW(uvol_test::runRanks(
                   2,
                   [](pcl_uvol::RankGroup& ranks) {
                     GlobalIsopoint isopoint{};
                     isopoint.first = 2; // the first one has one point
                     pcl_uvol::Report report;
                     fetchRows(
                         numbered(0, 1), 4 * ranks.rank(), {{isopoint}}, ranks, report);
                   }),
               pcl_uvol::InvalidArgument);
}

} // namespace
