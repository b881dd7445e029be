// SPDX-License-Identifier: BSD-3-Clause
#include "common/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace test_random {

TEST(Random, NumbersAreUniformAndNormal)
{
  double sum = 0.0, normal_sum = 0.0, normal_sq = 0.0;
  constexpr int n = 100000;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double u = pcl_uvol::uniformAt(3, i, 1), g = pcl_uvol::normalAt(3, i, 1);
    ASSERT_TRUE(u >= 0.0 && u < 1.0);
    sum += u;
    normal_sum += g;
    normal_sq += g * g;
  }
  EXPECT_NEAR(0.5, sum / n, 0.005); // five standard errors
  EXPECT_NEAR(0.0, normal_sum / n, 0.016);
  EXPECT_NEAR(1.0, normal_sq / n, 0.023);
  EXPECT_NE(pcl_uvol::uniformAt(3, 5, 1), pcl_uvol::uniformAt(4, 5, 1));
}

} // namespace test_random
