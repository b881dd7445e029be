// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/anisotropy.h"
#include "support/clouds.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace test_anisotropy {

TEST(EqualizingScale, StretchesTheNarrowAxesAndIgnoresOutliers)
{
  const auto cloud = uvol_test::makeCloud("uniform", 10000, 1);
  for (auto& point : *cloud) {
    point.x *= 1000.0f;
    point.z *= 2.0f;
  }
  (*cloud)[0].z = 1e9f;
  (*cloud)[1].y = std::numeric_limits<float>::quiet_NaN();
  const Eigen::Array3f scale = pcl_uvol::equalizingScale(pcl_uvol::viewOf(*cloud));
  EXPECT_EQ(1.0f, scale[0]);
  EXPECT_NEAR(1000.0f, scale[1], 30.0f);
  EXPECT_NEAR(500.0f, scale[2], 15.0f);
}

TEST(EqualizingScale, AnAxisWithoutSpreadKeepsItsLength)
{
  const auto planar = uvol_test::makeCloud("planar", 1000, 2);
  EXPECT_EQ(1.0f, pcl_uvol::equalizingScale(pcl_uvol::viewOf(*planar))[2]);
  const auto point = uvol_test::makeCloud("uniform", 1, 2);
  EXPECT_TRUE((pcl_uvol::equalizingScale(pcl_uvol::viewOf(*point)) == 1.0f).all());
}

/** From the 5th to the 95th percentile. */
TEST(EqualizingScale, SpreadsAreThoseOfNineInTen)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i <= 100; ++i) {
    all.push_back(i);
    cloud.push_back({static_cast<float>(i), static_cast<float>(3 * (100 - i)), 7.0f});
  }
  const Eigen::Array3f spread = pcl_uvol::findSpread(pcl_uvol::viewOf(cloud), all);
  EXPECT_EQ(90.0f, spread[0]);
  EXPECT_EQ(270.0f, spread[1]);
  EXPECT_EQ(0.0f, spread[2]);
}

TEST(EqualizingScale, NeedsAFinitePoint)
{
  const auto cloud = uvol_test::makeCloud("uniform", 1, 2);
  (*cloud)[0].x = std::numeric_limits<float>::infinity();
  EXPECT_THROW(pcl_uvol::equalizingScale(pcl_uvol::viewOf(*cloud)),
               pcl_uvol::InvalidArgument);
}

} // namespace test_anisotropy
