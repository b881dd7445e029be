// SPDX-License-Identifier: BSD-3-Clause
// Fits of cubics and quadratics against their closed forms in long double.
#include "derivatives/equations.h"
#include "src/derivatives/fit_kernel.h"
#include "support/simd_levels.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace test_fit_kernel {

using namespace pcl_uvol;
using Real = long double;
using Vector3 = Eigen::Matrix<Real, 3, 1>;
using VectorX = uvol_test::LongVector;
using MatrixX = uvol_test::LongMatrix;

const KernelTable<FitKernel> kernels{
    baseline::fitZeroLevel, avx2::fitZeroLevel, avx512::fitZeroLevel};

/** Powers of x, y and z of every term. */
constexpr int powers[20][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0},
                               {1, 1, 0}, {1, 0, 1}, {0, 2, 0}, {0, 1, 1}, {0, 0, 2},
                               {3, 0, 0}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {1, 1, 1},
                               {1, 0, 2}, {0, 3, 0}, {0, 2, 1}, {0, 1, 2}, {0, 0, 3}};
constexpr int quadratic_terms = 10, cubic_terms = 20;

Real
fourthPower(const Vector3& x)
{
  return x.squaredNorm() * x.squaredNorm();
}

/** A term, or a derivative of it: so many times by x, y and z. */
Real
termAt(int term, const Vector3& x, std::array<int, 3> derivative = {0, 0, 0})
{
  Real value = 1.0L;
  for (int axis = 0; axis < 3; ++axis) {
    int power = powers[term][axis];
    for (int i = 0; i < derivative[axis]; ++i)
      value *= power--;
    if (value == 0.0L)
      return 0.0L;
    value *= std::pow(x[axis], static_cast<Real>(power));
  }
  return value;
}

/** A polynomial of the third degree. */
struct Polynomial {
  VectorX coefficient = VectorX::Zero(cubic_terms);

  Real
  derivative(const Vector3& x, std::array<int, 3> of) const
  {
    Real sum = 0.0L;
    for (int i = 0; i < cubic_terms; ++i)
      sum += coefficient[i] * termAt(i, x, of);
    return sum;
  }

  Real
  value(const Vector3& x) const
  {
    return derivative(x, {0, 0, 0});
  }

  Vector3
  gradient(const Vector3& x) const
  {
    return {
        derivative(x, {1, 0, 0}), derivative(x, {0, 1, 0}), derivative(x, {0, 0, 1})};
  }

  /** Newton along the gradient, until nothing changes any more. */
  Vector3
  root() const
  {
    Vector3 x = Vector3::Zero();
    for (int i = 0; i < 30; ++i)
      x -= value(x) / gradient(x).squaredNorm() * gradient(x);
    return x;
  }
};

/** The order of FitResult::hessian. */
constexpr std::array<std::array<int, 3>, 6> second_derivatives{
    {{2, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 2, 0}, {0, 1, 1}, {0, 0, 2}}};

/** Neighbourhoods of all lanes; those beyond a lane's number have no weight. */
struct Samples {
  std::vector<FitSample> samples;
  int weighted[fit_lanes] = {};

  explicit Samples(std::size_t count)
      : samples(count)
  {
    for (FitSample& sample : samples)
      for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
        sample.x[lane] = 2.0f;
        sample.y[lane] = sample.z[lane] = sample.value[lane] = 0.0f;
      }
  }

  void
  add(std::size_t lane, const Vector3& x, Real value)
  {
    FitSample& sample = samples[static_cast<std::size_t>(weighted[lane]++)];
    sample.x[lane] = static_cast<float>(x[0]);
    sample.y[lane] = static_cast<float>(x[1]);
    sample.z[lane] = static_cast<float>(x[2]);
    sample.value[lane] = static_cast<float>(value);
  }

  Vector3
  position(std::size_t lane, int i) const
  {
    const FitSample& sample = samples[static_cast<std::size_t>(i)];
    return {sample.x[lane], sample.y[lane], sample.z[lane]};
  }
};

/** Places of the unit ball whose coordinates are 16ths, so that floats hold the values
 * of polynomials with short coefficients exactly. */
class Places {
public:
  Vector3
  next()
  {
    for (;;) {
      Vector3 x;
      for (int axis = 0; axis < 3; ++axis)
        x[axis] = static_cast<Real>(static_cast<int>(engine_() % 31) - 15) / 16;
      if (x.squaredNorm() < 0.95L)
        return x;
    }
  }

  /** A multiple of 1 / 64 of at most a quarter. */
  Real
  coefficient()
  {
    return static_cast<Real>(static_cast<int>(engine_() % 33) - 16) / 64;
  }

private:
  std::mt19937_64 engine_{11};
};

/** A cubic whose zero level lies about a third of the radius from the centre. */
Polynomial
randomCubic(Places& places, std::size_t lane, int terms = cubic_terms)
{
  Polynomial f;
  for (int i = 0; i < terms; ++i)
    f.coefficient[i] = places.coefficient();
  f.coefficient[0] = lane % 2 == 0 ? 0.375L : -0.5L;
  f.coefficient[1 + static_cast<int>(lane) % 3] = 1.25L;
  return f;
}

/** A weighted least-squares fit by a factorisation of its own. */
struct Fit {
  Polynomial polynomial;
  MatrixX inverse;           ///< of the normal equations
  VectorX with_fourth_power; ///< solution for one more term, which is the last
  Real sq_residuals, weights, variance;
  int terms;

  Fit(const Samples& s, std::size_t lane, int of_terms)
      : terms(of_terms)
  {
    const int n = s.weighted[lane];
    MatrixX rows(n, terms);
    VectorX values(n);
    weights = 0.0L;
    for (int i = 0; i < n; ++i) {
      const Vector3 x = s.position(lane, i);
      const Real rest = 1.0L - x.squaredNorm();
      for (int k = 0; k < terms; ++k)
        rows(i, k) = rest * termAt(k, x); // the root of the weight is the rest
      values[i] = rest * s.samples[static_cast<std::size_t>(i)].value[lane];
      weights += rest * rest;
    }
    const VectorX solution = uvol_test::solve(rows, values);
    polynomial.coefficient.head(terms) = solution;
    sq_residuals = (values - rows * solution).squaredNorm();
    variance = sq_residuals / (n - terms);
    inverse = uvol_test::invert(MatrixX(rows.transpose() * rows));
    rows.conservativeResize(n, terms + 1);
    for (int i = 0; i < n; ++i) {
      const Vector3 x = s.position(lane, i);
      rows(i, terms) = (1.0L - x.squaredNorm()) * fourthPower(x);
    }
    with_fourth_power = uvol_test::solve(rows, values);
  }

  /** How far the fourth power of the distance from the centre moves a value. */
  Real
  bias(const Vector3& x) const
  {
    Real moved = with_fourth_power[terms] * fourthPower(x) - polynomial.value(x);
    for (int i = 0; i < terms; ++i)
      moved += with_fourth_power[i] * termAt(i, x);
    return std::abs(moved);
  }

  /** Squared standard error of the value at a place. */
  Real
  sqError(const Vector3& x) const
  {
    VectorX term(terms);
    for (int i = 0; i < terms; ++i)
      term[i] = termAt(i, x);
    return term.dot(inverse * term) * variance;
  }

  /** That of the derivative there along a unit vector. */
  Real
  sqSlopeError(const Vector3& x, const Vector3& along) const
  {
    VectorX term = VectorX::Zero(terms);
    for (int i = 0; i < terms; ++i)
      for (int axis = 0; axis < 3; ++axis)
        term[i] += along[axis] * termAt(i, x, {axis == 0, axis == 1, axis == 2});
    return term.dot(inverse * term) * variance;
  }
};

TEST(FitKernel, CubicsAreExactOffTheCentre)
{
  Places places;
  Samples s(160);
  std::array<Polynomial, fit_lanes> truth;
  for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
    truth[lane] = randomCubic(places, lane);
    for (std::size_t i = 0; i < s.samples.size(); ++i) {
      const Vector3 x = places.next();
      s.add(lane, x, truth[lane].value(x));
      ASSERT_EQ(truth[lane].value(x), static_cast<Real>(s.samples[i].value[lane]));
    }
  }
  constexpr double exact = 1e-10;
  uvol_test::forLevels(kernels, [&](FitKernel kernel) {
    FitResult result;
    kernel(s.samples.data(), s.samples.size(), s.weighted, result);
    for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
      SCOPED_TRACE(lane);
      ASSERT_EQ(fit_cubic, result.order[lane]);
      const Vector3 root = truth[lane].root(), gradient = truth[lane].gradient(root);
      EXPECT_GT(root.norm(), 0.1L);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(root[axis], result.offset[axis][lane], exact);
        EXPECT_NEAR(gradient[axis], result.gradient[axis][lane], exact);
      }
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(truth[lane].derivative(root, second_derivatives[i]),
                    result.hessian[i][lane],
                    exact);
      // What double precision leaves of the squares.
      EXPECT_LT(result.residual[lane], 1e-7);
      EXPECT_LT(result.error[lane], 1e-7);
      EXPECT_LT(result.bias[lane], exact);
    }
  });
}

/** Noise on cubics, which cubics follow, and on quadratics, where they only follow the
 * noise. */
TEST(FitKernel, LeastSquaresAreThoseOfAnotherFactorisation)
{
  Places places;
  Samples s(40);
  std::mt19937_64 engine(5);
  for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
    const Polynomial f =
        randomCubic(places, lane, lane < 4 ? cubic_terms : quadratic_terms);
    for (std::size_t i = 0; i < s.samples.size(); ++i) {
      const Vector3 x = places.next();
      const Real noise = static_cast<Real>(engine() % 1024) / 1024 - 0.5L;
      s.add(lane, x, f.value(x) + (lane < 4 ? 0.01L : 0.1L) * noise);
    }
  }
  uvol_test::forLevels(kernels, [&](FitKernel kernel) {
    FitResult result;
    kernel(s.samples.data(), s.samples.size(), s.weighted, result);
    int cubics = 0;
    for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
      SCOPED_TRACE(lane);
      const Fit cubic(s, lane, cubic_terms), quadratic(s, lane, quadratic_terms);
      const Vector3 center = Vector3::Zero();
      const bool is_cubic = cubic.sqError(center) <= quadratic.sqError(center);
      cubics += is_cubic ? 1 : 0;
      const Fit& fit = is_cubic ? cubic : quadratic;
      ASSERT_EQ(is_cubic ? fit_cubic : fit_quadratic, result.order[lane]);
      const Vector3 root = fit.polynomial.root(),
                    gradient = fit.polynomial.gradient(root);
      const Real error = std::sqrt(fit.sqError(root)) / gradient.norm(),
                 value_error = std::sqrt(fit.sqError(center));
      EXPECT_NEAR(fit.polynomial.value(center), result.value[lane], 1e-9);
      EXPECT_NEAR(value_error, result.value_error[lane], 1e-9 * value_error);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(root[axis], result.offset[axis][lane], 1e-9);
        EXPECT_NEAR(gradient[axis], result.gradient[axis][lane], 1e-9);
      }
      EXPECT_NEAR(error, result.error[lane], 1e-9 * error);
      EXPECT_NEAR(fit.bias(root) / gradient.norm(), result.bias[lane], 1e-9);
      const Real slope_error =
          std::sqrt(fit.sqSlopeError(root, gradient.normalized())) / gradient.norm();
      EXPECT_NEAR(slope_error, result.slope_error[lane], 1e-9 * slope_error);
      EXPECT_NEAR(
          std::sqrt(fit.sq_residuals / fit.weights), result.residual[lane], 1e-9);
    }
    EXPECT_GE(cubics, 3);
    EXPECT_LE(cubics, 6);
  });
}

/** Without it errors of such fields are too small: the residuals are. */
TEST(FitKernel, FourthPowersAreWhatCubicsMiss)
{
  Places places;
  Samples s(60);
  const Vector3 from(0.25L, -0.5L, 1.0L);
  for (std::size_t lane = 0; lane < fit_lanes; ++lane)
    for (std::size_t i = 0; i < s.samples.size(); ++i) {
      const Vector3 x = places.next();
      s.add(lane,
            x,
            x[0] + 0.125L * x[2] * x[2] + 0.0625L * fourthPower(x - from) - 0.125L);
    }
  uvol_test::forLevels(kernels, [&](FitKernel kernel) {
    FitResult result;
    kernel(s.samples.data(), s.samples.size(), s.weighted, result);
    for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
      SCOPED_TRACE(lane);
      ASSERT_EQ(fit_cubic, result.order[lane]);
      const Vector3 root(
          result.offset[0][lane], result.offset[1][lane], result.offset[2][lane]);
      const Vector3 gradient(
          result.gradient[0][lane], result.gradient[1][lane], result.gradient[2][lane]);
      const Real truth = root[0] + 0.125L * root[2] * root[2] +
                         0.0625L * fourthPower(root - from) - 0.125L;
      EXPECT_GT(std::abs(truth), 1e-5L);
      EXPECT_NEAR(std::abs(truth) / gradient.norm(), result.bias[lane], 1e-7);
    }
  });
}

/** On two spheres about the centre the fourth power is a sum of a constant and the
 * square of the distance, which quadratics have. */
TEST(FitKernel, BiasIsZeroWhereSamplesDoNotDetermineIt)
{
  Places places;
  Samples s(40);
  for (std::size_t lane = 0; lane < fit_lanes; ++lane)
    for (std::size_t i = 0; i < s.samples.size(); ++i) {
      const Vector3 x = places.next().normalized() * (i % 2 == 0 ? 0.5L : 0.75L);
      const Real noise = static_cast<Real>(i % 7) / 64;
      s.add(lane, x, x[0] + 0.25L * x[1] * x[1] - 0.25L + noise);
    }
  uvol_test::forLevels(kernels, [&](FitKernel kernel) {
    FitResult result;
    kernel(s.samples.data(), s.samples.size(), s.weighted, result);
    for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
      ASSERT_NE(fit_failed, result.order[lane]);
      EXPECT_GT(result.error[lane], 0.0);
      EXPECT_EQ(0.0, result.bias[lane]);
    }
  });
}

/** Lanes with too few samples, samples on a plane, and no zero level. */
TEST(FitKernel, FailsWhereItMust)
{
  Places places;
  Samples s(60);
  const Polynomial f = randomCubic(places, 0);
  const auto addSome = [&](std::size_t lane, int count, const auto& value) {
    for (int i = 0; i < count; ++i) {
      const Vector3 x = places.next();
      s.add(lane, x, value(x));
    }
  };
  const auto cubic = [&](const Vector3& x) { return f.value(x); };
  addSome(0, 14, cubic);
  addSome(1, 15, cubic);
  addSome(2, 24, cubic);
  addSome(3, 25, cubic);
  for (int i = 0; i < 40; ++i) {
    Vector3 x = places.next();
    x[2] = 0.0L;
    s.add(4, x, f.value(x));
  }
  addSome(5, 40, [](const Vector3& x) { return x[0] - 0.9375L; });
  addSome(6, 40, [](const Vector3& x) { return x[0] - 1.0625L; });
  addSome(7, 40, [](const Vector3&) { return 1.0L; });
  uvol_test::forLevels(kernels, [&](FitKernel kernel) {
    FitResult result;
    kernel(s.samples.data(), s.samples.size(), s.weighted, result);
    const std::array<int, fit_lanes> expected{
        fit_failed, fit_quadratic, fit_quadratic, fit_cubic, fit_failed};
    for (std::size_t lane = 0; lane < 5; ++lane)
      EXPECT_EQ(expected[lane], result.order[lane]) << lane;
    EXPECT_NE(fit_failed, result.order[5]);
    EXPECT_NEAR(0.9375, result.offset[0][5], 1e-10);
    EXPECT_EQ(fit_failed, result.order[6]) << "beyond the radius";
    EXPECT_EQ(fit_failed, result.order[7]) << "no zero level";
  });
}

/** All numbers of a result, lane by lane. */
std::vector<double>
numbersOf(const FitResult& result)
{
  std::vector<double> numbers;
  for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
    for (const auto& offset : result.offset)
      numbers.push_back(offset[lane]);
    for (const auto& gradient : result.gradient)
      numbers.push_back(gradient[lane]);
    for (const auto& hessian : result.hessian)
      numbers.push_back(hessian[lane]);
    numbers.push_back(result.value[lane]);
    numbers.push_back(result.value_error[lane]);
    numbers.push_back(result.error[lane]);
    numbers.push_back(result.bias[lane]);
    numbers.push_back(result.slope_error[lane]);
    numbers.push_back(result.residual[lane]);
    numbers.push_back(result.order[lane]);
  }
  return numbers;
}

TEST(FitKernel, AllInstructionSetsGiveTheSameNumbers)
{
  Places places;
  Samples s(40);
  for (std::size_t lane = 0; lane < fit_lanes; ++lane)
    for (std::size_t i = 0; i < s.samples.size(); ++i) {
      const Vector3 x = places.next();
      s.add(lane, x, x[0] + 0.3L * std::sin(3 * x[1]) - 0.2L * x[2] * x[2]);
    }
  FitResult first;
  baseline::fitZeroLevel(s.samples.data(), s.samples.size(), s.weighted, first);
  uvol_test::forLevels(kernels, [&](FitKernel kernel) {
    FitResult result;
    kernel(s.samples.data(), s.samples.size(), s.weighted, result);
    EXPECT_EQ(numbersOf(first), numbersOf(result));
  });
}

} // namespace test_fit_kernel
