// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of searches in a metric against the plainest ones, bit for bit.
#include "src/neighbors/metric_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace test_metric_kernel {

using namespace pcl_uvol;

const KernelTable<const MetricKernels*> kernels{
    &baseline::metric_kernels, &avx2::metric_kernels, &avx512::metric_kernels};

const MetricRows metric{{{0.75, -0.125, 0.3}, {0.1, 0.0625, 0.7}, {-0.2, 0.9, 0.011}}};

std::vector<float>
randomNumbers(std::size_t count, std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::vector<float> values(count);
  for (float& value : values)
    value = uniform(engine);
  return values;
}

TEST(MetricKernel, MeasuresAsPlainLoopsDo)
{
  const std::vector<float> positions = randomNumbers(3 * 37, 1);
  const float point[3] = {0.3f, -0.7f, 0.11f};
  std::vector<double> expected;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    double offset[3], sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      offset[axis] = static_cast<double>(positions[i + axis]) - point[axis];
    for (const auto& row : metric.row) {
      const double image = row[0] * offset[0] + row[1] * offset[1] + row[2] * offset[2];
      sum += image * image;
    }
    expected.push_back(sum);
  }
  for (std::size_t count = 0; count <= expected.size(); ++count)
    uvol_test::forLevels(kernels, [&](const MetricKernels* kernel) {
      std::vector<double> found(count + 1, -1.0);
      const double least =
          kernel->measure(positions.data(), count, point, metric, found.data());
      const auto end = expected.begin() + static_cast<std::ptrdiff_t>(count);
      EXPECT_TRUE(std::equal(expected.begin(), end, found.begin()));
      EXPECT_EQ(-1.0, found.back()) << "writes beyond the end";
      EXPECT_EQ(count == 0 ? std::numeric_limits<double>::infinity()
                           : *std::min_element(expected.begin(), end),
                least);
    });
}

/** Squared distance in the metric of a place as seen from the point. */
double
sqDistance(const MetricRows& rows, const double (&x)[3])
{
  double sum = 0.0;
  for (const auto& row : rows.row) {
    const double image = row[0] * x[0] + row[1] * x[1] + row[2] * x[2];
    sum += image * image;
  }
  return sum;
}

/** Not beyond any place of the box; tight for a box across the axes of the metric. */
TEST(MetricKernel, BoundsBoxesFromBelow)
{
  // Rows at right angles; extents of the ball of radius 1 along the axes.
  const double c = std::cos(0.4), s = std::sin(0.4), factors[3] = {1.0, 0.5, 0.1};
  MetricBounds bounds{{{{c * factors[0], s * factors[0], 0.0},
                        {-s * factors[1], c * factors[1], 0.0},
                        {0.0, 0.0, factors[2]}}},
                      {}};
  bounds.per_sq_extent[0] = 1.0 / (c * c + s * s / 0.25);
  bounds.per_sq_extent[1] = 1.0 / (s * s + c * c / 0.25);
  bounds.per_sq_extent[2] = 0.01;
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    BoxPair boxes;
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 2; ++i) {
        boxes.low[axis][i] = 6.0 * uniform(engine) - 4.0;
        boxes.high[axis][i] = boxes.low[axis][i] + uniform(engine);
      }
    double first[2] = {-1.0, -1.0};
    uvol_test::forLevels(kernels, [&](const MetricKernels* kernel) {
      double found[2];
      kernel->findBounds(boxes, bounds, found);
      for (int i = 0; i < 2; ++i) {
        EXPECT_TRUE(first[i] < 0.0 || first[i] == found[i]);
        first[i] = found[i];
      }
    });
    for (int i = 0; i < 2; ++i)
      for (int probe = 0; probe < 50; ++probe) {
        double x[3];
        for (int axis = 0; axis < 3; ++axis)
          x[axis] = boxes.low[axis][i] +
                    uniform(engine) * (boxes.high[axis][i] - boxes.low[axis][i]);
        EXPECT_GE(sqDistance(bounds.rows, x) * (1.0 + 1e-12), first[i]);
      }
  }
  // Along one axis of the metric nothing is lost; behind a face neither.
  const BoxPair beside{{{-1.0, 3.0}, {-1.0, -1.0}, {20.0, -1.0}},
                       {{1.0, 4.0}, {1.0, 1.0}, {30.0, 1.0}}};
  uvol_test::forLevels(kernels, [&](const MetricKernels* kernel) {
    double found[2];
    kernel->findBounds(beside, bounds, found);
    EXPECT_NEAR(4.0, found[0], 1e-12);
    EXPECT_NEAR(9.0 * bounds.per_sq_extent[0], found[1], 0.5);
    EXPECT_GE(found[1], 9.0 * bounds.per_sq_extent[0] * (1.0 - 1e-12));
  });
}

/** The angle criterion for lines: the nearest first, then none within its angle. */
TEST(MetricKernel, AddsTheLinesThatNoNearerOneHides)
{
  constexpr std::size_t samples = 41, count = 48;
  constexpr float gone = std::numeric_limits<float>::infinity(), sq_cosine = 0.2f;
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    std::vector<float> x[3], sq_lengths(count, gone);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      x[axis] = randomNumbers(count, 10 * seed + axis);
      x[axis][7] = x[axis][5]; // two that are equally far: the first counts
    }
    std::vector<std::size_t> order;
    for (std::size_t j = 0; j < samples; ++j) {
      sq_lengths[j] = x[0][j] * x[0][j] + x[1][j] * x[1][j] + x[2][j] * x[2][j];
      order.push_back(j);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return sq_lengths[a] < sq_lengths[b];
    });
    MetricMoments expected{};
    std::vector<std::size_t> lines;
    for (const std::size_t j : order) {
      const bool is_hidden =
          std::any_of(lines.begin(), lines.end(), [&](std::size_t line) {
            const float product =
                x[0][line] * x[0][j] + x[1][line] * x[1][j] + x[2][line] * x[2][j];
            return product * product > sq_cosine * sq_lengths[line] * sq_lengths[j];
          });
      if (is_hidden)
        continue;
      lines.push_back(j);
      constexpr std::size_t row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
      for (int i = 0; i < 6; ++i) {
        const double square = static_cast<double>(x[row[i]][j]) * x[column[i]][j];
        expected.lengths[i] += square;
        expected.directions[i] += square / static_cast<double>(sq_lengths[j]);
      }
    }
    ASSERT_GE(lines.size(), 2u);
    uvol_test::forLevels(kernels, [&](const MetricKernels* kernel) {
      std::vector<float> left = sq_lengths;
      MetricMoments found{};
      kernel->addLines(
          x[0].data(), x[1].data(), x[2].data(), left.data(), count, sq_cosine, found);
      for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(expected.lengths[i], found.lengths[i]);
        EXPECT_EQ(expected.directions[i], found.directions[i]);
      }
    });
  }
}

} // namespace test_metric_kernel
