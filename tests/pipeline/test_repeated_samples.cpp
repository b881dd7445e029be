// SPDX-License-Identifier: BSD-3-Clause
// Samples of which several lie at one place, with values of their own.
#include "common/scalar_field.h"
#include "pipeline/noisy_ball.h"
#include "pipeline/run_pipeline.h"
#include "support/environment.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

namespace test_repeated_samples {

using pcl_uvol::Dataset;
using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::IsosurfaceResult;
using uvol_test::makeParameters;
using uvol_test::makeSamples;
using uvol_test::readColumn;
using uvol_test::readField;

/** Points of a data set in another order. */
std::shared_ptr<Dataset>
reordered(const Dataset& samples, const std::vector<std::size_t>& order)
{
  auto result = std::make_shared<Dataset>(samples);
  const std::size_t step = samples.cloud.point_step;
  result->cloud.width = static_cast<std::uint32_t>(order.size());
  result->cloud.row_step = static_cast<std::uint32_t>(order.size() * step);
  result->cloud.data.resize(order.size() * step);
  for (std::size_t i = 0; i < order.size(); ++i)
    std::memcpy(
        &result->cloud.data[i * step], &samples.cloud.data[order[i] * step], step);
  return result;
}

/** Samples whose places were measured twice: all of them, and then all again.
 * \param errors of both values of every place; multiples of 2^-12 are exact */
std::shared_ptr<Dataset>
measuredTwice(const Dataset& once, const std::vector<std::array<float, 2>>& errors)
{
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < 2 * errors.size(); ++i)
    order.push_back(i % errors.size());
  auto twice = reordered(once, order);
  std::vector<float> values = readColumn(*twice, "intensity");
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] += errors[order[i]][i / errors.size()];
  pcl_uvol::setField(*twice, "intensity", values);
  return twice;
}

/** Errors that cancel leave nothing behind. */
TEST(RepeatedSamples, TakesTheMeanOfTwoValuesAtOnePosition)
{
  constexpr float step = 1.0f / 4096.0f;
  const auto once = makeSamples();
  std::vector<float> exact = readColumn(*once, "intensity");
  for (float& value : exact)
    value = step * std::round(value / step);
  pcl_uvol::setField(*once, "intensity", exact);
  uvol_test::Random random(5);
  std::vector<std::array<float, 2>> errors;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const float error =
        step * std::round(200.0f * static_cast<float>(random.uniform() - 0.5));
    errors.push_back({error, -error});
  }
  const auto twice = measuredTwice(*once, errors);
  for (const bool smooth : {false, true})
    for (const bool mesh : {false, true}) {
      IsosurfacePipelineParameters parameters = makeParameters();
      parameters.smooth = smooth;
      parameters.level_set.max_steps = 5;
      if (mesh)
        parameters.mesh.emplace();
      const IsosurfaceResult expected = uvol_test::runPipeline(once, parameters),
                             found = uvol_test::runPipeline(twice, parameters);
      ASSERT_GT(expected.surface.cloud.width, 300u);
      for (const char* const name : {"x", "y", "z", "normal_x", "error"})
        EXPECT_EQ(readColumn(expected.surface, name), readColumn(found.surface, name))
            << name << smooth << mesh;
    }
}

/** The lower one of two values put the surface 0.08 spacings to one side. */
TEST(RepeatedSamples, DrawsASphereThatWasMeasuredTwiceToNeitherSide)
{
  constexpr std::size_t n = 3000;
  const double spacing = std::cbrt(8.0 / n);
  uvol_test::Random random(7);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  std::vector<std::array<float, 2>> errors;
  const auto draw_error = [&] { // of standard deviation 0.02
    return static_cast<float>(0.02 * std::sqrt(12.0) * (random.uniform() - 0.5));
  };
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = 0.7f - point.getVector3fMap().norm();
    cloud.push_back(point);
    errors.push_back({draw_error(), draw_error()});
  }
  Dataset once;
  pcl::toPCLPointCloud2(cloud, once.cloud);
  const auto result =
      uvol_test::runPipeline(measuredTwice(once, errors), makeParameters());
  const auto x = readColumn(result.surface, "x"), y = readColumn(result.surface, "y"),
             z = readColumn(result.surface, "z"),
             error = readColumn(result.surface, "error");
  double shift = 0.0;
  std::size_t below = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double deviation = Eigen::Vector3f(x[i], y[i], z[i]).norm() - 0.7;
    shift += deviation / static_cast<double>(x.size());
    below += std::abs(deviation) < error[i];
  }
  EXPECT_LT(std::abs(shift), 0.01 * spacing);
  EXPECT_GT(static_cast<double>(below), 0.93 * static_cast<double>(x.size()));
}

/** Points at one position are one sample, which has the fields of the first point that
 * has the lower one of the values in the middle. */
TEST(RepeatedSamples, SmoothsPointsAtOnePositionAsOneSample)
{
  constexpr std::size_t n = 4000;
  const auto distinct = makeSamples(n);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < n; ++i)
    order.push_back(i);
  for (std::size_t i = 0; i < n; i += 2)
    order.push_back(i);
  const auto samples = reordered(*distinct, order);
  // The second one of a pair is higher, or, of every fourth sample, lower.
  std::vector<float> values = readColumn(*samples, "intensity");
  std::vector<float> second = readColumn(*samples, "second");
  for (std::size_t i = n; i < values.size(); ++i) {
    values[i] += order[i] % 4 == 0 ? -0.01f : 0.01f;
    second[i] += 100.0f;
  }
  pcl_uvol::setField(*samples, "intensity", values);
  pcl_uvol::setField(*samples, "second", second);
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.smooth = true;
  parameters.level_set.max_steps = 5;
  const IsosurfaceResult result = uvol_test::runPipeline(samples, parameters);
  ASSERT_GT(result.surface.cloud.width, 300u);
  EXPECT_EQ(n, result.report.getCount("samples"));
  EXPECT_EQ(n / 2, result.report.getCount("duplicates"));
  EXPECT_EQ(n / 2, result.report.getCount("conflicting_duplicates"));
  bool has_later = false;
  const auto is_taken = [&](std::size_t point) {
    const bool is_later = point >= n;
    has_later = has_later || is_later;
    return order[point] % 2 == 1 || is_later == (order[point] % 4 == 0);
  };
  for (std::size_t i = 0; i < result.edges.size(); ++i) {
    const auto& edge = result.edges[i];
    EXPECT_TRUE(is_taken(edge.first) && is_taken(edge.second)) << i;
    EXPECT_NEAR((1.0f - edge.t) * second[edge.first] + edge.t * second[edge.second],
                readField(result.surface, i, "second"),
                1e-3f);
  }
  EXPECT_TRUE(has_later);

  std::vector<std::size_t> backwards(values.size());
  for (std::size_t i = 0; i < backwards.size(); ++i)
    backwards[i] = backwards.size() - 1 - i;
  EXPECT_EQ(result.surface.cloud.data,
            uvol_test::runPipeline(reordered(*samples, backwards), parameters)
                .surface.cloud.data);
}

} // namespace test_repeated_samples
