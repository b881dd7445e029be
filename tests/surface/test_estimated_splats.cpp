// SPDX-License-Identifier: BSD-3-Clause
// How many splats there will be is told by patches of the surface.
#include "splat_setup.h"
#include "surface/memory_need.h"
#include <pcl_uvol/common/cloud_view.h>

#include <gtest/gtest.h>

#include <limits>

namespace test_estimated_splats {

double
estimate(const pcl::PointCloud<pcl::PointNormal>& cloud, double delta)
{
  pcl_uvol::SplatParameters parameters;
  parameters.delta = delta;
  parameters.delta_is_length = true;
  return pcl_uvol::estimateSplats(pcl_uvol::viewOf(cloud), parameters, 0);
}

TEST(EstimatedSplats, AreAboutAsManyAsThereWillBe_long)
{
  constexpr std::size_t points = 150000;
  const auto sphere = uvol_test::makeSphere(points, 1);
  const auto knot = uvol_test::makeTorusKnot(points, 2);
  for (const auto& [cloud, delta] :
       {std::pair(sphere, 1e-4), std::pair(sphere, 1e-3), std::pair(knot, 1e-3)}) {
    const auto splats =
        static_cast<double>(uvol_test::makeSplats(cloud, delta, 0.2).size());
    EXPECT_NEAR(splats / points, estimate(*cloud, delta), 0.15) << delta;
  }
}

TEST(EstimatedSplats, AreAGuessWithoutAPatch)
{
  const auto few = uvol_test::makeSphere(1000, 1);
  EXPECT_GT(estimate(*few, 1e-4), 0.5);
  auto bad = uvol_test::makeSphere(100000, 1);
  for (auto& point : *bad)
    point.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_GT(estimate(*bad, 1e-4), 0.5);
  EXPECT_LE(estimate(*bad, 1e-4), 1.0);
}

} // namespace test_estimated_splats
