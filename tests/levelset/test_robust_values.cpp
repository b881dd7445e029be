// SPDX-License-Identifier: BSD-3-Clause
// Values as a level set takes them: near 1 at the surface whatever their unit, limited,
// and without spikes.
#include "cube_samples.h"
#include "src/levelset/constants.h"
#include "src/levelset/robust_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace test_robust_values {

using namespace pcl_uvol;

struct Heights : uvol_test::CubeSamples {
  std::vector<float>& f = heights;

  using CubeSamples::CubeSamples;

  TamedValues
  tame(Report& report)
  {
    return tameValues(*samples, f, 26, 1, report);
  }
};

float
medianAt(const std::vector<float>& f, const std::vector<std::uint32_t>& samples)
{
  std::vector<float> sizes;
  sizes.reserve(samples.size());
  for (const std::uint32_t sample : samples)
    sizes.push_back(std::abs(f[sample]));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

/** The unit of the values is taken away by a power of two: nothing else of them
 * changes.
 */
TEST(RobustValues, AreNearOneAtTheSurfaceInAnyUnit)
{
  Report report;
  Heights first(2000);
  const std::vector<float> before = first.f;
  const TamedValues tamed = first.tame(report);
  EXPECT_LE(0.99f, medianAt(first.f, tamed.crossing));
  EXPECT_GE(2.01f, medianAt(first.f, tamed.crossing));
  const float factor = first.f[0] / before[0];
  EXPECT_EQ(factor, std::ldexp(1.0f, std::ilogb(factor)));
  for (const int exponent : {-100, -7, 1, 60, 110}) {
    Heights other(2000);
    for (float& value : other.f)
      value = std::ldexp(value, exponent);
    EXPECT_EQ(tamed.crossing, other.tame(report).crossing) << exponent;
    EXPECT_EQ(first.f, other.f) << exponent;
  }
}

/** Values that are far from the isovalue are those at the limit, of their sign. */
TEST(RobustValues, AreLimitedByTheMedianAtTheSurface)
{
  Report report;
  Heights heights(2000), limited(2000);
  const auto crossing = heights.tame(report).crossing;
  for (float& value : limited.f)
    value *= std::abs(value) > 0.4f ? 1e6f : 1.0f;
  const std::vector<float> before = limited.f;
  EXPECT_EQ(crossing, limited.tame(report).crossing);
  const float limit = *std::max_element(limited.f.begin(), limited.f.end());
  EXPECT_NEAR(
      level_set.farthest_value * medianAt(limited.f, crossing), limit, 0.01f * limit);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (std::abs(before[i]) > 1.0f) {
      EXPECT_EQ(std::copysign(limit, before[i]), limited.f[i]);
    }
    else {
      EXPECT_EQ(heights.f[i], limited.f[i]);
    }
}

/** A sample of the other side among many of one counts as their median. */
TEST(RobustValues, LoseTheirSpikes)
{
  Report report;
  Heights clean(2000), spiky(2000);
  const std::size_t spike = static_cast<std::size_t>(
      std::max_element(clean.f.begin(), clean.f.end()) - clean.f.begin());
  clean.tame(report);
  EXPECT_EQ(0u, report.getCount("outliers"));
  spiky.f[spike] = -100.0f;
  spiky.tame(report);
  EXPECT_EQ(1u, report.getCount("outliers"));
  EXPECT_LT(0.0f, spiky.f[spike]);
  for (std::size_t i = 0; i < clean.f.size(); ++i)
    if (i != spike) {
      EXPECT_EQ(clean.f[i], spiky.f[i]);
    }
}

} // namespace test_robust_values
