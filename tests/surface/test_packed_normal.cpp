// SPDX-License-Identifier: BSD-3-Clause
#include "surface/packed_normal.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace test_packed_normal {

TEST(PackedNormal, IsWithinAHundredthOfADegree)
{
  std::mt19937_64 engine(1);
  std::normal_distribution<float> component;
  double largest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Vector3f normal(component(engine), component(engine), component(engine));
    if (i < 6)
      normal = (i % 2 == 0 ? 1.0f : -1.0f) * Eigen::Vector3f::Unit(i / 2);
    Eigen::Vector3f unpacked;
    pcl_uvol::unpackNormal(pcl_uvol::packNormal(normal.data()), unpacked.data());
    EXPECT_NEAR(unpacked.norm(), 1.0f, 1e-6f);
    largest = std::max(largest,
                       static_cast<double>(unpacked.cross(normal.normalized()).norm()));
    EXPECT_GT(unpacked.dot(normal), 0.0f);
  }
  EXPECT_LT(largest, 0.004 * 3.14159265 / 180.0);
}

} // namespace test_packed_normal
