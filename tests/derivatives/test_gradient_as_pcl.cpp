// SPDX-License-Identifier: BSD-3-Clause
// Gradients into a point type of PCL, of indices, and by a search method of PCL's.
#include "support/environment.h"
#include <pcl_uvol/derivatives/gradient_estimation.h>

#include <gtest/gtest.h>
#include <pcl/search/kdtree.h>

namespace test_gradient_as_pcl {

TEST(GradientEstimation, AsPclWouldDoIt)
{
  uvol_test::Random random(1);
  const pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < 3000; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = point.getVector3fMap().squaredNorm();
    cloud->push_back(point);
  }
  pcl_uvol::GradientEstimation<pcl::PointXYZI, pcl::IntensityGradient> estimation;
  estimation.setInputCloud(cloud);
  const auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{5, 1, 2000});
  pcl::PointCloud<pcl::IntensityGradient> all, some;
  estimation.compute(all);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  pcl::PointCloud<pcl::IntensityGradient> searched;
  estimation.compute(searched);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_NEAR(all[i].gradient_x, searched[i].gradient_x, 1e-5);
  estimation.setIndices(indices);
  estimation.setKSearch(9);
  estimation.compute(some);
  EXPECT_EQ(3u, some.size());
}

} // namespace test_gradient_as_pcl
