// SPDX-License-Identifier: BSD-3-Clause
// Pairs by classes of offsets against a plain loop over them, and the monotone
// regression against numbers worked out by hand.
#include "interpolation/directional_variogram.h"
#include "support/clouds.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace test_directional_variogram {

using Eigen::Array3d;
using pcl_uvol::detail::OffsetClass;

TEST(ClassifyPairs, SumsRootsOfDifferencesByOffset)
{
  // So few that every sample pairs with every other once, and once more with each that
  // is near it: 33 samples are the 32 nearest of one another.
  const auto samples = uvol_test::buildSamples(*uvol_test::makeCloud("uniform", 33, 1));
  const auto& places = samples->getPositions();
  std::vector<double> values;
  for (std::size_t i = 0; i < samples->size(); ++i)
    values.push_back(std::sin(5.0 * static_cast<double>(places[i][0])) +
                     static_cast<double>(places[i][2]));
  constexpr double spread = 0.8;
  struct Sum {
    double roots = 0.0, pairs = 0.0;
    Array3d squares = Array3d::Zero();
  };
  std::map<std::array<int, 3>, Sum> sums;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Array3d offset;
      for (int axis = 0; axis < 3; ++axis)
        offset[axis] =
            std::abs(static_cast<double>(places[i][axis]) - places[j][axis]) / spread;
      if (offset.maxCoeff() >= 1.5)
        continue;
      std::array<int, 3> place;
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] = static_cast<int>(std::max(
            std::floor(std::log2(offset[static_cast<Eigen::Index>(axis)])), -11.0));
      Sum& sum = sums[place];
      sum.roots += 3.0 * std::sqrt(std::abs(values[i] - values[j]));
      sum.pairs += 3.0;
      sum.squares += 3.0 * offset * offset;
    }
  std::size_t found = 0;
  const auto classes = pcl_uvol::detail::classifyPairs(*samples, values, spread);
  for (const auto& [place, sum] : sums) {
    if (sum.pairs < 8.0)
      continue;
    ASSERT_LT(found, classes.size());
    const OffsetClass& told = classes[found++];
    EXPECT_NEAR(4.0 * std::log(sum.roots / sum.pairs), told.log_difference, 1e-9);
    EXPECT_NEAR(sum.pairs / (sum.pairs + 50.0), told.weight, 1e-12);
    EXPECT_LT((sum.squares / sum.pairs - told.sq_offset).matrix().norm(), 1e-9);
  }
  EXPECT_EQ(found, classes.size());
  EXPECT_GT(found, 5u);
}

OffsetClass
classAt(double x, double z, double value, double weight)
{
  return {Array3d(x * x, 0.0, z * z), value, weight};
}

TEST(ExplainedBy, IsOneWhereDifferencesGrowWithDistance)
{
  const std::vector<OffsetClass> classes = {
      classAt(1, 0, 0.0, 1.0), classAt(2, 0, 1.0, 1.0), classAt(3, 0, 5.0, 0.5)};
  EXPECT_DOUBLE_EQ(1.0, pcl_uvol::detail::explainedBy(classes, Array3d::Zero()));
}

TEST(ExplainedBy, JoinsWhatWouldFall)
{
  // The last two are joined at (1 * 4 + 3 * 2) / 4 = 2.5: a rest of 1 * 1.5^2 + 3 *
  // 0.5^2 = 3 of a variance of 2 * 0 + 1 * 16 + 3 * 4 - 6 * (10 / 6)^2 = 34 / 3.
  const std::vector<OffsetClass> classes = {
      classAt(1, 0, 0.0, 2.0), classAt(2, 0, 4.0, 1.0), classAt(3, 0, 2.0, 3.0)};
  EXPECT_NEAR(
      1.0 - 9.0 / 34.0, pcl_uvol::detail::explainedBy(classes, Array3d::Zero()), 1e-12);
  // Differences that only fall tell nothing.
  const std::vector<OffsetClass> falling = {classAt(1, 0, 1.0, 1.0),
                                            classAt(2, 0, 0.0, 1.0)};
  EXPECT_NEAR(0.0, pcl_uvol::detail::explainedBy(falling, Array3d::Zero()), 1e-12);
  EXPECT_EQ(0.0, pcl_uvol::detail::explainedBy({}, Array3d::Zero()));
  EXPECT_EQ(0.0,
            pcl_uvol::detail::explainedBy({classAt(1, 0, 1.0, 1.0)}, Array3d::Zero()));
}

TEST(FitFactors, FindsTheRatioThatOrdersClasses)
{
  // Differences are the distance where z counts 20 times as much.
  std::vector<OffsetClass> classes;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      const double x = std::exp2(-i), z = std::exp2(-j);
      classes.push_back(classAt(x, z, std::log(std::hypot(x, 20.0 * z)), 1.0));
    }
  const Array3d found = pcl_uvol::detail::fitFactors(classes, {Array3d::Zero()});
  EXPECT_NEAR(20.0, std::exp(found[2] - found[0]), 4.0);
  EXPECT_GT(pcl_uvol::detail::explainedBy(classes, found), 0.999);
}

} // namespace test_directional_variogram
