// SPDX-License-Identifier: BSD-3-Clause
// Points are found wherever they are.
#include "distributed/fetch_points.h"
#include "support/environment.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <set>

namespace test_fetch_points {

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

/** Processes that hold some points each ask for random ones. */
void
expectFound(const std::vector<std::size_t>& held)
{
  uvol_test::runRanks(held.size(), [&](pcl_uvol::Communicator& communicator) {
    std::size_t begin = 0, total = 0;
    for (std::size_t rank = 0; rank < held.size(); ++rank) {
      begin += rank < communicator.rank() ? held[rank] : 0;
      total += held[rank];
    }
    const auto own = numbered(begin, begin + held[communicator.rank()]);
    const auto first =
        pcl_uvol::findFirstIndices(own.width, communicator)[communicator.rank()];
    EXPECT_EQ(begin, first);
    std::set<std::uint64_t> wanted;
    uvol_test::Random random(communicator.rank());
    for (std::size_t i = 0; i < 10 * communicator.rank(); ++i)
      wanted.insert(
          static_cast<std::uint64_t>(random.uniform() * static_cast<double>(total)));
    pcl_uvol::Report report;
    const auto fetched =
        fetchPoints(own, first, {wanted.begin(), wanted.end()}, communicator, report);
    ASSERT_EQ(wanted.size(), fetched.width);
    pcl::PointCloud<pcl::PointXYZI> points;
    if (!wanted.empty()) // PCL takes the address of the first point
      pcl::fromPCLPointCloud2(fetched, points);
    auto point = points.begin();
    for (const std::uint64_t index : wanted)
      EXPECT_EQ(index, (point++)->intensity);
  });
}

TEST(FetchPoints, FindsThemWhereverTheyAre)
{
  expectFound({40});
  expectFound({13, 5, 22});
  expectFound({0, 17, 0, 0, 30, 0});
}

TEST(FetchPoints, KeepsTheFields)
{
  uvol_test::runRanks(2, [](pcl_uvol::Communicator& communicator) {
    pcl_uvol::Report report;
    const auto own = numbered(0, communicator.rank() == 0 ? 3 : 0);
    const auto none =
        fetchPoints(own, 3 * communicator.rank(), {}, communicator, report);
    EXPECT_EQ(0u, none.width);
    ASSERT_EQ(own.fields.size(), none.fields.size());
    EXPECT_EQ(own.point_step, none.point_step);
  });
}

TEST(FetchPoints, RefusesPointsThatNobodyHas)
{
  EXPECT_THROW(uvol_test::runRanks(2,
                                   [](pcl_uvol::Communicator& communicator) {
                                     pcl_uvol::Report report;
                                     // Point 2: the first process has one point.
                                     fetchPoints(numbered(0, 1),
                                                 4 * communicator.rank(),
                                                 {2},
                                                 communicator,
                                                 report);
                                   }),
               pcl_uvol::InvalidArgument);
}

} // namespace test_fetch_points
