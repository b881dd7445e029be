// SPDX-License-Identifier: BSD-3-Clause
// Filters on rows of pixels against their formulas in double precision.
#include "pixel_setup.h"
#include "src/render/image_space/filter_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace test_filter_kernel {

using namespace pcl_uvol;
using uvol_test::PixelRandom;

const KernelTable<const FilterKernels*> kernels{
    &baseline::filter_kernels, &avx2::filter_kernels, &avx512::filter_kernels};

constexpr int count = 48, margin = 16, rows = 13, middle = 6;
constexpr std::ptrdiff_t stride = count + 2 * margin;
constexpr double rounding = 2e-6;

/** A plane of numbers around a row. */
struct Plane {
  std::vector<float> values =
      std::vector<float>(static_cast<std::size_t>(rows * stride));

  float*
  row()
  {
    return values.data() + middle * stride + margin;
  }

  double
  at(int column, int dy = 0) const
  {
    return values[static_cast<std::size_t>((middle + dy) * stride + margin + column)];
  }
};

/** Background is zero in all planes, but depth 1. */
struct Planes {
  std::array<Plane, 3> color, normal;
  Plane opacity, depth;

  /** \param layers depths of the surface */
  explicit Planes(std::uint64_t seed, float background = 0.3f, std::uint32_t layers = 3)
  {
    PixelRandom random(seed);
    for (std::size_t i = 0; i < opacity.values.size(); ++i) {
      const bool is_surface = random.between(0.0, 1.0) >= background;
      opacity.values[i] = is_surface ? 1.0f : 0.0f;
      depth.values[i] =
          is_surface ? 0.2f * static_cast<float>(1 + random.below(layers)) : 1.0f;
      const Eigen::Vector3d n =
          (random.direction() + Eigen::Vector3d(0, 0, 1.5)).normalized();
      for (std::size_t k = 0; k < 3; ++k) {
        color[k].values[i] = is_surface ? random.between(0.0, 1.0) : 0.0f;
        normal[k].values[i] = is_surface ? static_cast<float>(n[long(k)]) : 0.0f;
      }
    }
  }

  ShadedRow
  row()
  {
    return {{color[0].row(), color[1].row(), color[2].row()},
            opacity.row(),
            depth.row(),
            {normal[0].row(), normal[1].row(), normal[2].row()}};
  }
};

/** Sum over the pixels around and the pixel itself. */
double
filtered(const Plane& plane, int column, const FilterWeights& weights)
{
  double sum = 0.0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      double weight = 1.0;
      if (dx == 0 || dy == 0)
        weight = weights.edge;
      if (dx == 0 && dy == 0)
        weight = weights.edge * weights.edge + weights.more;
      sum += weight * plane.at(column + dx, dy);
    }
  return sum;
}

double
smoothStep(double value, double edge)
{
  const double t = std::clamp((value - edge) / edge, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

TEST(FilterKernel, SmoothIsTheWeightedMeanOfTheSurface)
{
  Planes source(1);
  for (const FilterWeights& weights : {FilterWeights{1.0f, 0.0f},
                                       FilterWeights{2.0f, 0.0f},
                                       FilterWeights{2.0f, 12.0f}})
    uvol_test::forLevels(kernels, [&](const FilterKernels* kernel) {
      Planes target(2);
      kernel->smooth(source.row(), stride, count, weights, target.row());
      for (int i = 0; i < count; ++i) {
        const bool is_surface = source.opacity.at(i) > 0.0;
        EXPECT_EQ(source.opacity.at(i), target.opacity.at(i));
        const double weight = filtered(source.opacity, i, weights);
        double n[3], sq_length = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          n[k] = filtered(source.normal[k], i, weights);
          sq_length += n[k] * n[k];
          EXPECT_NEAR(is_surface ? filtered(source.color[k], i, weights) / weight : 0.0,
                      target.color[k].at(i),
                      rounding);
        }
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(is_surface ? n[k] / std::sqrt(sq_length) : 0.0,
                      target.normal[k].at(i),
                      rounding);
      }
    });
}

TEST(FilterKernel, LaplaceIsTableFourTwo)
{
  Planes source(3);
  uvol_test::forLevels(kernels, [&](const FilterKernels* kernel) {
    Plane laplace;
    kernel->laplace(source.depth.row(), stride, count, laplace.row());
    for (int i = 0; i < count; ++i)
      EXPECT_NEAR(4.0 * source.depth.at(i) - source.depth.at(i - 1) -
                      source.depth.at(i + 1) - source.depth.at(i, -1) -
                      source.depth.at(i, 1),
                  laplace.at(i),
                  rounding);
  });
}

TEST(FilterKernel, SilhouettesReachTheirThickness)
{
  PixelRandom random(4);
  Plane laplace;
  for (float& value : laplace.values)
    value =
        random.below(12) == 0 ? -random.between(0.0, 0.1) : random.between(0.0, 0.1);
  constexpr float threshold = 0.03f;
  for (int thickness = 1; thickness <= 5; ++thickness)
    uvol_test::forLevels(kernels, [&](const FilterKernels* kernel) {
      Plane lines;
      kernel->silhouettes(
          laplace.row(), stride, count, threshold, thickness, lines.row());
      for (int i = 0; i < count; ++i) {
        double lowest = 0.0;
        for (int dy = -thickness; dy <= thickness; ++dy)
          for (int dx = -thickness; dx <= thickness; ++dx)
            if (std::hypot(dx, dy) <= thickness - 0.5)
              lowest = std::min(lowest, laplace.at(i + dx, dy));
        EXPECT_NEAR(smoothStep(-lowest, threshold), lines.at(i), 1e-5);
      }
    });
}

TEST(FilterKernel, FeatureLinesAreWhereNormalsTurnWithinALayer)
{
  Planes source(5);
  constexpr float threshold = 0.4f, layer_distance = 0.3f;
  uvol_test::forLevels(kernels, [&](const FilterKernels* kernel) {
    Plane lines;
    std::fill(lines.values.begin(), lines.values.end(), 0.25f);
    kernel->features(
        source.row(), stride, count, threshold, layer_distance, lines.row());
    int partly = 0;
    for (int i = 0; i < count; ++i) {
      double largest = 0.0, turn = 0.0; // the second largest: one is an outlier
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          double cosine = 0.0;
          for (const Plane& normal : source.normal)
            cosine += normal.at(i) * normal.at(i + dx, dy);
          if (source.opacity.at(i + dx, dy) > 0.0 &&
              std::abs(source.depth.at(i + dx, dy) - source.depth.at(i)) <=
                  layer_distance)
            if (dx != 0 || dy != 0) {
              turn = std::max(turn, std::min(largest, 1.0 - cosine));
              largest = std::max(largest, 1.0 - cosine);
            }
        }
      const double line =
          source.opacity.at(i) > 0.0 ? smoothStep(turn, threshold) : 0.0;
      partly += line > 0.25 && line < 1.0 ? 1 : 0;
      EXPECT_NEAR(std::max(0.25, line), lines.at(i), 1e-5);
    }
    EXPECT_GT(partly, 2);
  });
}

TEST(FilterKernel, LinesCoverColourAndOpacity)
{
  PixelRandom random(6);
  Plane lines;
  for (float& value : lines.values)
    value = random.between(0.0, 1.0);
  const float ink[3] = {0.9f, 0.1f, 0.4f};
  uvol_test::forLevels(kernels, [&](const FilterKernels* kernel) {
    const Planes before(7);
    Planes after(7);
    kernel->drawLines(after.row(), lines.row(), count, ink);
    for (int i = 0; i < count; ++i) {
      const double line = lines.at(i);
      EXPECT_NEAR(before.opacity.at(i) + line * (1.0 - before.opacity.at(i)),
                  after.opacity.at(i),
                  rounding);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(before.color[k].at(i) + line * (ink[k] - before.color[k].at(i)),
                    after.color[k].at(i),
                    rounding);
    }
  });
}

TEST(FilterKernel, AntiAliasingIsAGaussianOnEdgesOnly)
{
  Planes source(8);
  PixelRandom random(9);
  Plane laplace;
  for (float& value : laplace.values)
    value = 0.25f * (static_cast<float>(random.below(9)) - 4.0f);
  constexpr float threshold = 0.75f;
  uvol_test::forLevels(kernels, [&](const FilterKernels* kernel) {
    Planes target(2);
    kernel->antiAlias(
        source.row(), stride, laplace.row(), count, threshold, target.row());
    const auto expected = [&](const Plane& plane, int i) {
      return std::abs(laplace.at(i)) >= threshold
                 ? filtered(plane, i, {2.0f, 0.0f}) / 16.0
                 : plane.at(i);
    };
    for (int i = 0; i < count; ++i) {
      EXPECT_NEAR(expected(source.opacity, i), target.opacity.at(i), rounding);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(expected(source.color[k], i), target.color[k].at(i), rounding);
    }
  });
}

TEST(FilterKernel, OutputRoundsToBytesOverTheBackground)
{
  PixelRandom random(10);
  for (const bool is_transparent : {false, true}) {
    Planes source(11, 0.0f);
    for (std::size_t i = 0; i < source.opacity.values.size(); ++i) {
      const float opacity = random.between(0.0, 1.0);
      source.opacity.values[i] = i % 5 == 0 ? 0.0f : opacity;
      for (Plane& plane : source.color)
        plane.values[i] *= 1.2f * source.opacity.values[i];
    }
    const RowBackground background{{0.7f, 0.2f, 0.95f}, is_transparent};
    uvol_test::forLevels(kernels, [&](const FilterKernels* kernel) {
      std::vector<std::uint32_t> image(count);
      kernel->output(source.row(), count, background, image.data());
      for (int i = 0; i < count; ++i) {
        const double opacity = source.opacity.at(i);
        for (std::size_t k = 0; k < 4; ++k) {
          double value = is_transparent ? opacity : 1.0;
          if (k < 3) {
            const double color = source.color[k].at(i);
            value = !is_transparent ? color + (1.0 - opacity) * background.color[k]
                    : opacity > 0.0 ? color / opacity
                                    : 0.0;
          }
          value = 255.0 * std::clamp(value, 0.0, 1.0);
          // Half way between two bytes rounding decides.
          if (std::abs(value - std::floor(value) - 0.5) < 1e-3)
            continue;
          EXPECT_EQ(std::lround(value),
                    long(image[static_cast<std::size_t>(i)] >> (8 * k) & 0xff));
        }
      }
    });
  }
}

} // namespace test_filter_kernel
