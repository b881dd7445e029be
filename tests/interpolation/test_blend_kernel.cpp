// SPDX-License-Identifier: BSD-3-Clause
// The kernels of blended fits against loops over single balls and terms.
#include "src/interpolation/blend_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace test_blend_kernel {

using namespace pcl_uvol;

const KernelTable<const BlendKernels*> kernels{
    &baseline::blend_kernels, &avx2::blend_kernels, &avx512::blend_kernels};

/** Random balls of a unit cube, and what kernels read behind them. */
struct Balls {
  std::array<std::vector<float>, 3> center;
  std::vector<double> sq_radius, per_sq_radius;

  explicit Balls(std::size_t count)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const std::size_t size = count + ball_padding;
    for (auto& row : center)
      for (std::size_t i = 0; i < size; ++i)
        row.push_back(static_cast<float>(unit(random)));
    for (std::size_t i = 0; i < size; ++i) {
      sq_radius.push_back(i < count ? 0.3 * unit(random) : 0.0);
      per_sq_radius.push_back(i < count ? 1.0 / sq_radius[i]
                                        : std::numeric_limits<double>::infinity());
    }
  }

  std::array<const float*, 3>
  rows() const
  {
    return {center[0].data(), center[1].data(), center[2].data()};
  }
};

constexpr std::array<std::size_t, 6> counts{0, 1, 7, 8, 9, 61};

TEST(BlendKernel, FindsTheBallsThatHoldAPlace)
{
  for (const std::size_t count : counts) {
    Balls balls(count);
    const std::array<double, 3> place{0.3, 0.6, 0.5};
    std::vector<std::uint32_t> expected;
    std::vector<double> parts;
    for (std::size_t i = 0; i < count; ++i) {
      double sq_distance = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        sq_distance += std::pow(place[axis] - double(balls.center[axis][i]), 2);
      if (i == 5) // on the border, which is outside
        balls.per_sq_radius[i] = 1.0 / sq_distance;
      if (sq_distance * balls.per_sq_radius[i] < 1.0) {
        expected.push_back(static_cast<std::uint32_t>(i));
        parts.push_back(sq_distance * balls.per_sq_radius[i]);
      }
    }
    uvol_test::forLevels(kernels, [&](const BlendKernels* kernel) {
      std::vector<std::uint32_t> held(count + ball_padding);
      std::vector<double> part(count + ball_padding);
      const std::size_t found = kernel->findHolding(balls.rows().data(),
                                                    balls.per_sq_radius.data(),
                                                    count,
                                                    place.data(),
                                                    held.data(),
                                                    part.data());
      held.resize(found);
      EXPECT_EQ(expected, held) << count;
      for (std::size_t k = 0; k < std::min(found, parts.size()); ++k)
        EXPECT_DOUBLE_EQ(parts[k], part[k]);
    });
  }
}

TEST(BlendKernel, FindsTheBallsThatReachIntoABox)
{
  for (const std::size_t count : counts)
    for (const double factor : {1.0, 4.0}) {
      const Balls balls(count);
      const std::array<double, 3> low{0.3, 0.6, 0.5}, high{0.35, 0.6, 0.7};
      std::vector<std::uint32_t> expected;
      for (std::size_t i = 0; i < count; ++i) {
        double sq_gap = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double x = balls.center[axis][i];
          sq_gap += std::pow(x - std::clamp(x, low[axis], high[axis]), 2);
        }
        if (sq_gap < factor * balls.sq_radius[i])
          expected.push_back(static_cast<std::uint32_t>(i));
      }
      uvol_test::forLevels(kernels, [&](const BlendKernels* kernel) {
        std::vector<std::uint32_t> reaching(count + ball_padding);
        reaching.resize(kernel->findReaching(balls.rows().data(),
                                             balls.sq_radius.data(),
                                             factor,
                                             count,
                                             low.data(),
                                             high.data(),
                                             reaching.data()));
        EXPECT_EQ(expected, reaching) << count;
      });
    }
}

/** x^i y^j z^k of the terms of a cubic, in their order (PolynomialFit). */
constexpr int exponents[cubic_terms][3] = {
    {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {1, 1, 0}, {1, 0, 1},
    {0, 2, 0}, {0, 1, 1}, {0, 0, 2}, {3, 0, 0}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0},
    {1, 1, 1}, {1, 0, 2}, {0, 3, 0}, {0, 2, 1}, {0, 1, 2}, {0, 0, 3}};

TEST(BlendKernel, EvaluatesCubicsAndTheirGradients)
{
  constexpr std::size_t fields = 3;
  const std::array<double, 3> place{0.7, -0.4, 1.3};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> coefficients;
  for (std::size_t i = 0; i < fields * cubic_terms; ++i)
    coefficients.push_back(number(random));
  const auto power = [](double x, int n) { return n < 0 ? 0.0 : std::pow(x, n); };
  std::array<double, fields> values{}, expected{};
  std::array<double, 3 * fields> gradients{}, slopes{};
  for (std::size_t f = 0; f < fields; ++f)
    for (std::size_t t = 0; t < cubic_terms; ++t) {
      const double c = coefficients[f * cubic_terms + t];
      const int* const e = exponents[t];
      double term = c;
      for (std::size_t axis = 0; axis < 3; ++axis)
        term *= power(place[axis], e[axis]);
      expected[f] += term;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double slope = c * e[axis] * power(place[axis], e[axis] - 1);
        for (std::size_t other = 0; other < 3; ++other)
          slope *= other == axis ? 1.0 : power(place[other], e[other]);
        slopes[3 * f + axis] += slope;
      }
    }
  uvol_test::forLevels(kernels, [&](const BlendKernels* kernel) {
    std::array<double, fields> alone{};
    kernel->evaluateCubics(
        coefficients.data(), fields, place.data(), alone.data(), nullptr);
    kernel->evaluateCubics(
        coefficients.data(), fields, place.data(), values.data(), gradients.data());
    EXPECT_EQ(alone, values);
    for (std::size_t f = 0; f < fields; ++f)
      EXPECT_NEAR(expected[f], values[f], 1e-14);
    for (std::size_t i = 0; i < 3 * fields; ++i)
      EXPECT_NEAR(slopes[i], gradients[i], 1e-14);
  });
}

} // namespace test_blend_kernel
