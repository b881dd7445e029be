// SPDX-License-Identifier: BSD-3-Clause
// Polynomials of several fields at once against factorisations in long double.
#include "derivatives/equations.h"
#include "src/derivatives/polynomial_kernel.h"
#include "support/simd_levels.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace test_polynomial_kernel {

using namespace pcl_uvol;
using Real = long double;
using VectorX = uvol_test::LongVector;
using MatrixX = uvol_test::LongMatrix;

const KernelTable<PolynomialKernel> kernels{
    baseline::fitPolynomials, avx2::fitPolynomials, avx512::fitPolynomials};

/** Powers of x, y and z of every term. */
constexpr int powers[20][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0},
                               {1, 1, 0}, {1, 0, 1}, {0, 2, 0}, {0, 1, 1}, {0, 0, 2},
                               {3, 0, 0}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {1, 1, 1},
                               {1, 0, 2}, {0, 3, 0}, {0, 2, 1}, {0, 1, 2}, {0, 0, 3}};
constexpr int terms_of_degree[4] = {1, 4, 10, 20};

constexpr std::size_t room = 44;

struct alignas(64) LaneValues {
  double value[polynomial_lanes];
};

/** Samples of all lanes, and values of some fields. */
struct Samples {
  std::vector<PolynomialSample> samples{room};
  std::vector<LaneValues> values;
  int weighted[polynomial_lanes] = {};

  explicit Samples(std::size_t fields)
      : values(fields * room)
  {
    for (PolynomialSample& sample : samples)
      for (std::size_t lane = 0; lane < polynomial_lanes; ++lane) {
        sample.x[lane] = 2.0;
        sample.y[lane] = sample.z[lane] = 0.0;
      }
    for (LaneValues& value : values)
      std::fill(value.value, value.value + polynomial_lanes, 0.0);
  }

  Real
  term(std::size_t lane, std::size_t j, int i) const
  {
    return std::pow(static_cast<Real>(samples[j].x[lane]), powers[i][0]) *
           std::pow(static_cast<Real>(samples[j].y[lane]), powers[i][1]) *
           std::pow(static_cast<Real>(samples[j].z[lane]), powers[i][2]);
  }

  Real
  rest(std::size_t lane, std::size_t j) const
  {
    return 1.0L - static_cast<Real>(samples[j].x[lane]) * samples[j].x[lane] -
           static_cast<Real>(samples[j].y[lane]) * samples[j].y[lane] -
           static_cast<Real>(samples[j].z[lane]) * samples[j].z[lane];
  }
};

/** Lane l has 38 - 4 l random samples; the last ones are too few for a cubic. */
template <typename Value>
Samples
randomSamples(std::size_t fields, const Value& value, bool planar = false)
{
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Samples s(fields);
  for (std::size_t lane = 0; lane < polynomial_lanes; ++lane)
    for (std::size_t j = 0; j < 40 - 4 * lane;) {
      const double x = uniform(engine), y = uniform(engine),
                   z = planar ? 0.0 : uniform(engine);
      if (x * x + y * y + z * z >= 1.0)
        continue;
      s.samples[j].x[lane] = x;
      s.samples[j].y[lane] = y;
      s.samples[j].z[lane] = z;
      for (std::size_t f = 0; f < fields; ++f)
        s.values[f * room + j].value[lane] = value(f, x, y, z);
      s.weighted[lane] = static_cast<int>(++j);
    }
  return s;
}

std::vector<PolynomialFit>
fit(PolynomialKernel kernel, const Samples& s, std::size_t fields)
{
  std::vector<PolynomialFit> fits(fields);
  kernel(
      s.samples.data(), room, s.weighted, s.values.front().value, fields, fits.data());
  return fits;
}

/** A least-squares fit of a degree, and its standard error at the centre. */
struct Fit {
  VectorX coefficient;
  Real error, residual;

  Fit(const Samples& s, std::size_t lane, std::size_t field, int degree)
  {
    const int n = s.weighted[lane], terms = terms_of_degree[degree];
    MatrixX rows(n, terms);
    VectorX values(n);
    Real weights = 0.0L;
    for (int i = 0; i < n; ++i) {
      const auto j = static_cast<std::size_t>(i);
      const Real rest = s.rest(lane, j);
      for (int k = 0; k < terms; ++k)
        rows(i, k) = rest * s.term(lane, j, k);
      values[i] = rest * s.values[field * room + j].value[lane];
      weights += rest * rest;
    }
    coefficient = uvol_test::solve(rows, values);
    const Real squares = (values - rows * coefficient).squaredNorm();
    const MatrixX inverse = uvol_test::invert(MatrixX(rows.transpose() * rows));
    error = std::sqrt(inverse(0, 0) * squares / (n - terms));
    residual = std::sqrt(squares / weights);
  }
};

TEST(PolynomialKernel, IsTheLeastSquaresFitOfTheDegreeThatErrsLess)
{
  const auto value = [](std::size_t f, double x, double y, double z) {
    return f == 0   ? std::sin(2.0 * x) + y * z + 0.3 * z * z * z
           : f == 1 ? 0.05 * std::cos(90.0 * x + 50.0 * y * z) + 3.0 * x
                    : std::exp(x - y) + 0.1 * z;
  };
  const Samples s = randomSamples(3, value);
  uvol_test::forLevels(kernels, [&](PolynomialKernel kernel) {
    const auto fits = fit(kernel, s, 3);
    for (std::size_t f = 0; f < 3; ++f)
      for (std::size_t lane = 0; lane < polynomial_lanes; ++lane) {
        const int n = s.weighted[lane];
        int degree = n >= 15 ? 2 : 1;
        if (n >= 25 && Fit(s, lane, f, 3).error <= Fit(s, lane, f, 2).error)
          degree = 3;
        ASSERT_EQ(fits[f].degree[lane], degree) << f << " " << lane;
        const Fit truth(s, lane, f, degree);
        for (int i = 0; i < 20; ++i)
          EXPECT_NEAR(fits[f].coefficient[i][lane],
                      i < terms_of_degree[degree]
                          ? static_cast<double>(truth.coefficient[i])
                          : 0.0,
                      1e-11);
        EXPECT_NEAR(fits[f].error[lane], static_cast<double>(truth.error), 1e-11);
      }
  });
}

/** Refinement makes up for the squared condition of the normal equations. */
TEST(PolynomialKernel, GivesCubicsBack)
{
  const auto value = [](std::size_t, double x, double y, double z) {
    return 1.0 + x - 2.0 * y * z + x * x * x - 0.5 * x * y * z + z * z * z;
  };
  const Samples s = randomSamples(1, value);
  uvol_test::forLevels(kernels, [&](PolynomialKernel kernel) {
    const auto fits = fit(kernel, s, 1);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      ASSERT_EQ(fits[0].degree[lane], 3);
      EXPECT_NEAR(fits[0].coefficient[0][lane], 1.0, 1e-12);
      EXPECT_NEAR(fits[0].coefficient[8][lane], -2.0, 1e-12);
      EXPECT_NEAR(fits[0].coefficient[10][lane], 1.0, 1e-12);
      EXPECT_NEAR(fits[0].coefficient[14][lane], -0.5, 1e-12);
      EXPECT_LT(fits[0].error[lane], 1e-13);
    }
  });
}

TEST(PolynomialKernel, StepsGetALinearFit)
{
  const auto value = [](std::size_t, double x, double y, double z) {
    return x + 0.3 * y > 0.1 * z ? 1.0 : (x < -0.3 && y > 0.2 ? 0.9 : 0.0);
  };
  const Samples s = randomSamples(1, value);
  uvol_test::forLevels(kernels, [&](PolynomialKernel kernel) {
    const auto fits = fit(kernel, s, 1);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const int smooth = Fit(s, lane, 0, 3).error <= Fit(s, lane, 0, 2).error ? 3 : 2;
      EXPECT_EQ(fits[0].degree[lane],
                Fit(s, lane, 0, smooth).residual > 0.15L ? 1 : smooth);
    }
  });
}

TEST(PolynomialKernel, SaysWhereSamplesDoNotDetermineIt)
{
  const auto value = [](std::size_t, double x, double y, double) { return x + y; };
  const Samples s = randomSamples(1, value, true); // on a plane
  uvol_test::forLevels(kernels, [&](PolynomialKernel kernel) {
    const auto fits = fit(kernel, s, 1);
    for (const int degree : fits[0].degree)
      EXPECT_EQ(degree, 0);
  });
}

} // namespace test_polynomial_kernel
