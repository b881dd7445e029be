// SPDX-License-Identifier: BSD-3-Clause
// Which points of a cloud are taken, and with what normals.
#include "support/surfaces.h"
#include "surface/oriented_points.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace test_oriented_points {

using pcl_uvol::InvalidArgument;
using pcl_uvol::OrientedPoints;
using pcl_uvol::Report;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

template <typename PointT>
OrientedPoints
orient(const pcl::PointCloud<PointT>& cloud, Report& report)
{
  std::vector<std::uint32_t> all(cloud.size());
  std::iota(all.begin(), all.end(), 0u);
  return pcl_uvol::orientPoints(pcl_uvol::viewOf(cloud), all, 0, report);
}

Eigen::Vector3f
normalOf(const OrientedPoints& points, std::size_t i)
{
  Eigen::Vector3f normal;
  pcl_uvol::unpackNormal(points.normals[i], normal.data());
  return normal;
}

TEST(OrientedPoints, HaveTheNormalsOfTheirInput)
{
  const auto cloud = uvol_test::makeSphere(500, 3);
  for (auto& point : *cloud)
    point.getNormalVector3fMap() *= -3.0f; // any length, and inwards as it is
  Report report;
  const OrientedPoints points = orient(*cloud, report);
  ASSERT_EQ(500u, points.samples->size());
  EXPECT_FALSE(points.two_sided);
  EXPECT_TRUE(report.warnings.empty());
  for (std::size_t i = 0; i < points.normals.size(); ++i) {
    const auto& point = (*cloud)[points.samples->getInputIndex(i)];
    EXPECT_LT((normalOf(points, i) + point.getVector3fMap()).norm(), 1e-3f);
  }
}

TEST(OrientedPoints, LeaveOutWhatIsNotFiniteOrHasNoNormal)
{
  const auto cloud = uvol_test::makeSphere(100, 1);
  (*cloud)[3].x = nan_value;
  (*cloud)[4].normal_y = nan_value;
  (*cloud)[5].getNormalVector3fMap().setZero();
  (*cloud)[6] = (*cloud)[7];
  Report report;
  const OrientedPoints points = orient(*cloud, report);
  EXPECT_EQ(96u, points.samples->size());
  EXPECT_EQ(96u, points.normals.size());
  EXPECT_EQ(100u, report.getCount("points"));
  EXPECT_EQ(1u, report.getCount("non_finite"));
  EXPECT_EQ(2u, report.getCount("without_normal"));
  EXPECT_EQ(1u, report.getCount("duplicates"));
}

TEST(OrientedPoints, GetEstimatedNormalsWhereThereAreNone)
{
  pcl::PointCloud<pcl::PointXYZ> bare;
  const auto sphere = uvol_test::makeSphere(2000, 4);
  for (const auto& point : *sphere)
    bare.push_back({point.x, point.y, point.z});
  Report report;
  const OrientedPoints points = orient(bare, report);
  EXPECT_TRUE(points.two_sided);
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_EQ("estimated_normals", report.warnings[0].code);
  for (std::size_t i = 0; i < points.normals.size(); ++i) {
    const Eigen::Vector3f place =
        bare[points.samples->getInputIndex(i)].getVector3fMap();
    EXPECT_GT(std::abs(normalOf(points, i).dot(place)), 0.97f);
  }
}

TEST(OrientedPoints, AreRefusedWhereThereAreNone)
{
  Report report;
  EXPECT_THROW(orient(pcl::PointCloud<pcl::PointNormal>(), report), InvalidArgument);
  pcl::PointCloud<pcl::PointNormal> lost(3, 1);
  for (auto& point : lost)
    point.x = nan_value;
  EXPECT_THROW(orient(lost, report), InvalidArgument);
}

} // namespace test_oriented_points
