// SPDX-License-Identifier: BSD-3-Clause
// Fields that vary by decades within a few spacings, and their logarithms.
#include "cube_samples.h"
#include "src/levelset/robust_values.h"
#include "src/levelset/value_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_value_scale {

using namespace pcl_uvol;

TEST(ValueScale, LogarithmsHaveTheSignAndTheSlopeOfTheField)
{
  const std::vector<float> values{
      1e-30f, 0.02f, 0.2f, 0.5f, 1.999999f, 2.0f, 2.000001f, 3.0f, 5.0f, 2e20f};
  const auto logarithms = takeLogarithms(values, {}, 2.0);
  ASSERT_EQ(values.size(), logarithms.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double part = values[i] / 2.0;
    const double expected =
        part >= 0.1 ? std::log(part) : std::log(0.1) + part / 0.1 - 1.0;
    EXPECT_NEAR(2.0 * expected, logarithms[i], 1e-6 * std::abs(2.0 * expected))
        << values[i];
    EXPECT_EQ(values[i] < 2.0f, logarithms[i] < 0.0f);
  }
}

/** A negative isovalue is that of the field with the other sign. */
TEST(ValueScale, LogarithmsOfNegativeValuesGoTheOtherWay)
{
  const std::vector<float> values{-8.0f, -2.0f, -1.0f, 0.0f, 3.0f};
  const auto logarithms = takeLogarithms(values, {}, -2.0);
  EXPECT_FLOAT_EQ(static_cast<float>(-2.0 * std::log(4.0)), logarithms[0]);
  EXPECT_EQ(0.0f, logarithms[1]);
  EXPECT_FLOAT_EQ(static_cast<float>(2.0 * std::log(2.0)), logarithms[2]);
  EXPECT_TRUE(std::is_sorted(logarithms.begin(), logarithms.end()));
}

/** A frame changes the unit only. */
TEST(ValueScale, LogarithmsAreThoseOfTheInput)
{
  const ValueFrame frame{1.5, 4.0};
  const std::vector<float> values{static_cast<float>(frame.apply(1.0)),
                                  static_cast<float>(frame.apply(2.0)),
                                  static_cast<float>(frame.apply(8.0))};
  const auto logarithms = takeLogarithms(values, frame, 2.0);
  EXPECT_FLOAT_EQ(static_cast<float>(-4.0 * 2.0 * std::log(2.0)), logarithms[0]);
  EXPECT_EQ(0.0f, logarithms[1]);
  EXPECT_FLOAT_EQ(static_cast<float>(4.0 * 2.0 * std::log(4.0)), logarithms[2]);
}

/** Whether logarithms are taken of a field of the distance from a plane, with the
 * isovalue 1.
 * \param noise of the distance, which is in spacings */
template <typename Field>
bool
areTaken(double noise, const Field& field)
{
  constexpr std::size_t count = 8000;
  const double per_spacing = std::cbrt(static_cast<double>(count));
  const uvol_test::CubeSamples cube(count);
  std::vector<float> values, f;
  for (std::size_t i = 0; i < count; ++i) {
    const double deviate = std::sqrt(12.0) * (uniformAt(5, i, 0) - 0.5);
    values.push_back(
        static_cast<float>(field(i, per_spacing * cube.heights[i] + noise * deviate)));
    f.push_back(values.back() - 1.0f);
  }
  const auto logarithms = takeLogarithms(values, {}, 1.0);
  const auto crossing = findCrossing(*cube.samples, f, 1);
  const bool are_smoother =
      areLogarithmsSmoother(*cube.samples, crossing, f, logarithms, 1);
  EXPECT_FALSE(areLogarithmsSmoother(*cube.samples, {}, f, logarithms, 1));
  EXPECT_EQ(are_smoother,
            areLogarithmsSmoother(*cube.samples, crossing, f, logarithms, 4));
  return are_smoother;
}

TEST(ValueScale, LogarithmsAreTakenOfGrowthAlone)
{
  for (const double noise : {0.0, 0.1}) {
    EXPECT_TRUE(areTaken(noise, [](std::size_t, double distance) {
      return std::pow(2.0, distance);
    })) << noise;
    for (const double slope : {0.02, 2.0})
      EXPECT_FALSE(areTaken(
          noise,
          [slope](std::size_t, double distance) { return 1.0 + slope * distance; }))
          << noise << ' ' << slope;
  }
  EXPECT_TRUE(areTaken(0.1, [](std::size_t i, double distance) {
    return i % 100 == 0 ? 1e10 : std::pow(2.0, distance);
  }));
}

} // namespace test_value_scale
