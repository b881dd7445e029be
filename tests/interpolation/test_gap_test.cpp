// SPDX-License-Identifier: BSD-3-Clause
// Errors at samples left out: none of a linear field all around, and none of the own
// line where samples lie on lines.
#include "interpolation/gap_test.h"
#include "support/clouds.h"
#include "support/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace test_gap_test {

using Eigen::Array3d;
using pcl_uvol::Position;
using pcl_uvol::SampleSet;
using pcl_uvol::detail::GapTest;

std::vector<double>
valuesOf(const SampleSet& samples, const std::function<double(const Position&)>& field)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < samples.size(); ++i)
    values.push_back(field(samples.getPositions()[i]));
  return values;
}

double
computeMean(const std::vector<double>& numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) /
         static_cast<double>(numbers.size());
}

/** The unit square of vertical lines, each of 100 samples. */
SampleSet::ConstPtr
makeLines(int lines)
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  uvol_test::Random random(2);
  for (int line = 0; line < lines; ++line) {
    const double x = random.uniform(), y = random.uniform();
    for (int i = 0; i < 100; ++i) {
      pcl::PointXYZI point;
      point.x = static_cast<float>(x);
      point.y = static_cast<float>(y);
      point.z = static_cast<float>(i / 100.0);
      cloud.push_back(point);
    }
  }
  return uvol_test::buildSamples(cloud);
}

TEST(GapTest, ALinearFieldHasNoErrorAllAround)
{
  const auto samples =
      uvol_test::buildSamples(*uvol_test::makeCloud("uniform", 5000, 1));
  const auto values = valuesOf(*samples, [](const Position& x) {
    return 3.0 + x[0] - 2.0 * static_cast<double>(x[1]) +
           0.5 * static_cast<double>(x[2]);
  });
  const GapTest test(*samples, values, 3, 0);
  EXPECT_GE(test.size(), 300u);
  EXPECT_LE(test.size(), 400u);
  auto errors = test.computeErrors(Array3d::Ones(), 0);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() * 9 / 10], 1e-6);
  EXPECT_EQ(test.computeErrors(Array3d(1, 2, 3), 1),
            test.computeErrors(Array3d(1, 2, 3), 3));
}

TEST(GapTest, SamplesOfTheOwnLineAreLeftOut)
{
  const auto samples = makeLines(40);
  // Every line has a value of its own: the nearest samples would tell it exactly.
  const auto values = valuesOf(*samples, [](const Position& x) {
    return std::sin(1e4 * static_cast<double>(x[0])) > 0.0 ? 1.0 : 0.0;
  });
  const GapTest test(*samples, values, 3, 0);
  EXPECT_GT(computeMean(test.computeErrors(Array3d::Ones(), 0)), 0.15);
  // A field of depth alone is told by other lines if depth counts, and not if it does
  // not.
  const auto depth = valuesOf(*samples, [](const Position& x) {
    return std::sin(9.0 * static_cast<double>(x[2]));
  });
  const GapTest of_depth(*samples, depth, 3, 0);
  const double with = computeMean(of_depth.computeErrors(Array3d(1, 1, 100), 0));
  EXPECT_LT(with, 0.15);
  EXPECT_GT(computeMean(of_depth.computeErrors(Array3d(1, 1, 0.1), 0)), 4.0 * with);
}

TEST(GapTest, SheetsAndLinesAreSpacesOfTheirOwn)
{
  auto planar = uvol_test::makeCloud("planar", 2000, 2);
  const auto sheet = uvol_test::buildSamples(*planar);
  const auto linear = [](const Position& x) { return static_cast<double>(x[0]); };
  // With two dimensions neighbours in the sheet lie all around, and tell the value.
  const GapTest test(*sheet, valuesOf(*sheet, linear), 2, 0);
  EXPECT_LT(computeMean(test.computeErrors(Array3d::Ones(), 0)), 0.15);
  for (auto& point : *planar)
    point.y = 0.0f;
  const auto line = uvol_test::buildSamples(*planar);
  const GapTest of_line(*line, valuesOf(*line, linear), 1, 0);
  EXPECT_LT(computeMean(of_line.computeErrors(Array3d::Ones(), 0)), 0.1);
}

TEST(GapTest, AFewSamplesAreNoTrouble)
{
  for (const std::size_t count : {1u, 2u, 5u}) {
    const auto samples =
        uvol_test::buildSamples(*uvol_test::makeCloud("uniform", count, 3));
    const GapTest test(*samples, std::vector<double>(count, 2.0), 3, 0);
    EXPECT_EQ(count, test.size());
    for (const double error : test.computeErrors(Array3d::Ones(), 0))
      EXPECT_LT(error, 1e-6);
  }
}

} // namespace test_gap_test
