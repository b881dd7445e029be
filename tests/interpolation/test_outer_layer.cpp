// SPDX-License-Identifier: BSD-3-Clause
// Samples of nothing lie around a cloud, not within it.
#include "common/random.h"
#include "common/records.h"
#include "interpolation/outer_layer.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace pcl_uvol;

namespace test_outer_layer {

/** Samples at random in a ball (or in the shell outside of `hollow`), f = 1. */
Dataset
makeBall(std::size_t count, double radius, double hollow = 0.0, double shift = 0.0)
{
  std::vector<double> xyz;
  for (std::uint64_t i = 0; xyz.size() < 3 * count; ++i) {
    std::array<double, 3> p{};
    double sq_length = 0.0;
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
      p[axis] = radius * (2.0 * uniformAt(3, i, axis) - 1.0);
      sq_length += p[axis] * p[axis];
    }
    if (sq_length < radius * radius && sq_length >= hollow * hollow)
      for (const double coordinate : p)
        xyz.push_back(coordinate + shift);
  }
  Dataset dataset;
  dataset.cloud = makeRecords({}, count);
  setCoordinates(dataset, xyz);
  setField(dataset, "f", std::vector<double>(count, 1.0));
  setField(dataset, "id", std::vector<std::int32_t>(count, 7));
  return dataset;
}

double
radiusOf(const Dataset& dataset, std::size_t i)
{
  double sum = 0.0;
  for (const char* const axis : {"x", "y", "z"}) {
    const double x = ScalarField(dataset.cloud.fields, axis)
                         .read(&dataset.cloud.data[i * dataset.cloud.point_step]);
    sum += x * x;
  }
  return std::sqrt(sum);
}

double
read(const Dataset& dataset, const std::string& name, std::size_t i)
{
  return ScalarField(dataset.cloud.fields, name)
      .read(&dataset.cloud.data[i * dataset.cloud.point_step]);
}

TEST(OuterLayer, LiesAroundABall)
{
  constexpr std::size_t count = 5000;
  // Twelve neighbours of a sample in the middle fill a ball of that radius.
  const double spacing = std::cbrt(12.0 / count);
  for (const double unit : {1.0, 0x1p-60, 0x1p40}) {
    Dataset ball = makeBall(count, unit);
    Report report;
    addOuterLayer(ball, nullptr, "f", -2.5, 1, report);
    ASSERT_EQ(count + report.getCount("outer_samples"), ball.cloud.width);
    EXPECT_GT(report.getCount("outer_samples"), 1000u);
    for (std::size_t i = 0; i < ball.cloud.width; ++i) {
      EXPECT_EQ(i < count ? 1.0 : -2.5, read(ball, "f", i));
      EXPECT_EQ(7.0, read(ball, "id", i));
      if (i >= count) {
        EXPECT_GT(radiusOf(ball, i), unit * (1.0 - 0.1 * spacing));
        EXPECT_LT(radiusOf(ball, i), unit * (1.0 + 2.0 * spacing));
      }
    }
  }
}

TEST(OuterLayer, FillsAHollow)
{
  Dataset shell = makeBall(20000, 1.0, 0.5);
  Report report;
  addOuterLayer(shell, nullptr, "f", 0.0, 1, report);
  std::size_t within = 0;
  for (std::size_t i = 20000; i < shell.cloud.width; ++i)
    within += radiusOf(shell, i) < 0.5 ? 1 : 0;
  EXPECT_GT(within, 100u);
}

TEST(OuterLayer, DoesNotDependOnThreads)
{
  Dataset one = makeBall(4000, 1.0), four = one;
  Report report;
  addOuterLayer(one, nullptr, "f", 0.0, 1, report);
  addOuterLayer(four, nullptr, "f", 0.0, 4, report);
  EXPECT_TRUE(one.cloud.data == four.cloud.data);
}

TEST(OuterLayer, RefusesWhatCannotBe)
{
  Dataset ball = makeBall(100, 1.0), few = makeBall(24, 1.0);
  Report report;
  EXPECT_THROW(addOuterLayer(ball, nullptr, "g", 0.0, 1, report), InvalidArgument);
  EXPECT_THROW(addOuterLayer(ball, nullptr, "id", 0.5, 1, report), InvalidArgument);
  EXPECT_THROW(addOuterLayer(ball, nullptr, "id", 1e10, 1, report), InvalidArgument);
  EXPECT_THROW(addOuterLayer(few, nullptr, "f", 0.0, 1, report), InvalidArgument);
  EXPECT_EQ(100u, ball.cloud.width);
  EXPECT_NO_THROW(addOuterLayer(ball, nullptr, "id", 3.0, 1, report));
}

} // namespace test_outer_layer
