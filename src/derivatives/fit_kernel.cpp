// SPDX-License-Identifier: BSD-3-Clause
#include "fit_kernel.h"

#include <cmath>

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

#if defined(__AVX512F__)
constexpr std::size_t register_lanes = 8;
#elif defined(__AVX2__)
constexpr std::size_t register_lanes = 4;
#else
constexpr std::size_t register_lanes = 2;
#endif

/** One number per fit, as many as a register holds. */
using Lanes = double __attribute__((vector_size(register_lanes * sizeof(double))));
using Mask = decltype(Lanes{} < Lanes{});

constexpr int quadratic_terms = 10;
constexpr int cubic_terms = 20;
constexpr int moment_count = 84; // monomials up to degree 6: products of two cubic ones
constexpr int newton_steps = 6;

/** Of a term's own diagonal entry: a smaller pivot is rounding, and the term cannot be
 * told from those before it (samples on a plane, on few layers of a lattice). */
constexpr double smallest_pivot = 1e-9;
/** Residuals of fewer degrees of freedom say nothing about the error. */
constexpr double least_freedom = 5.0;
/** Newton's last step in radii: far below what coordinates in float resolve. */
constexpr double converged_step = 1e-7;

/** Monomials x^a y^b z^c by degree, then falling powers of x and y; those of a lower
 * degree come first, so that the quadratic fit is the leading part of the cubic one. */
struct Monomials {
  int power[moment_count][3]{};
  int parent[moment_count]{}; ///< the monomial without one factor ...
  int axis[moment_count]{};   ///< ... and the coordinate that this factor is
  int product[cubic_terms][cubic_terms]{};

  constexpr int
  find(int a, int b, int c) const
  {
    for (int i = 0; i < moment_count; ++i)
      if (power[i][0] == a && power[i][1] == b && power[i][2] == c)
        return i;
    return -1;
  }

  constexpr Monomials()
  {
    int i = 0;
    for (int degree = 0; degree <= 6; ++degree)
      for (int a = degree; a >= 0; --a)
        for (int b = degree - a; b >= 0; --b, ++i) {
          power[i][0] = a;
          power[i][1] = b;
          power[i][2] = degree - a - b;
        }
    for (i = 1; i < moment_count; ++i) {
      axis[i] = power[i][0] > 0 ? 0 : power[i][1] > 0 ? 1 : 2;
      parent[i] = find(power[i][0] - (axis[i] == 0),
                       power[i][1] - (axis[i] == 1),
                       power[i][2] - (axis[i] == 2));
    }
    for (i = 0; i < cubic_terms; ++i)
      for (int j = 0; j < cubic_terms; ++j)
        product[i][j] = find(power[i][0] + power[j][0],
                             power[i][1] + power[j][1],
                             power[i][2] + power[j][2]);
  }
};

constexpr Monomials monomials;

inline Lanes
load(const double* values)
{
  return *reinterpret_cast<const Lanes*>(values);
}

inline void
store(const Lanes& values, double* target)
{
  *reinterpret_cast<Lanes*>(target) = values;
}

inline Lanes
squareRoot(const Lanes& a)
{
  Lanes root;
  for (std::size_t lane = 0; lane < register_lanes; ++lane)
    root[lane] = std::sqrt(a[lane]);
  return root;
}

inline Lanes
weightOf(const Lanes& x, const Lanes& y, const Lanes& z)
{
  const Lanes zero{};
  const Lanes rest = 1.0 - (x * x + y * y + z * z);
  const Lanes positive = rest > zero ? rest : zero;
  return positive * positive;
}

/** All monomials up to a count, times a factor. */
template <int count>
inline void
evaluateMonomials(
    const Lanes& factor, const Lanes& x, const Lanes& y, const Lanes& z, Lanes* value)
{
  value[0] = factor;
#pragma GCC unroll 84
  for (int i = 1; i < count; ++i)
    value[i] = value[monomials.parent[i]] * (monomials.axis[i] == 0   ? x
                                             : monomials.axis[i] == 1 ? y
                                                                      : z);
}

/** The normal equations of the cubic fit and their Cholesky factor, row by row. */
struct NormalEquations {
  Lanes moment[moment_count]{};
  Lanes right[cubic_terms]{};
  Lanes factor[cubic_terms][cubic_terms]; // lower triangle
  Lanes inverse_pivot[cubic_terms];
  Mask quadratic_regular, cubic_regular;

  void
  accumulate(const FitSample* samples, std::size_t count, std::size_t first)
  {
    for (std::size_t j = 0; j < count; ++j) {
      const Lanes x = load(samples[j].x + first), y = load(samples[j].y + first),
                  z = load(samples[j].z + first);
      const Lanes value = load(samples[j].value + first);
      Lanes term[moment_count];
      evaluateMonomials<moment_count>(weightOf(x, y, z), x, y, z, term);
#pragma GCC unroll 84
      for (int i = 0; i < moment_count; ++i)
        moment[i] += term[i];
#pragma GCC unroll 20
      for (int i = 0; i < cubic_terms; ++i)
        right[i] += term[i] * value;
    }
  }

  void
  factorize()
  {
    const Lanes zero{}, one = zero + 1.0;
    quadratic_regular = cubic_regular = zero == zero;
    for (int i = 0; i < cubic_terms; ++i) {
      for (int j = 0; j < i; ++j) {
        Lanes sum = moment[monomials.product[i][j]];
        for (int k = 0; k < j; ++k)
          sum -= factor[i][k] * factor[j][k];
        factor[i][j] = sum * inverse_pivot[j];
      }
      const Lanes diagonal = moment[monomials.product[i][i]];
      Lanes pivot = diagonal;
      for (int k = 0; k < i; ++k)
        pivot -= factor[i][k] * factor[i][k];
      const Mask regular = pivot > smallest_pivot * diagonal;
      cubic_regular &= regular;
      if (i < quadratic_terms)
        quadratic_regular &= regular;
      inverse_pivot[i] = one / squareRoot(regular ? pivot : one);
    }
  }

  /** Solve with the lower triangle, in place. */
  void
  forward(Lanes* vector) const
  {
    for (int i = 0; i < cubic_terms; ++i) {
      for (int k = 0; k < i; ++k)
        vector[i] -= factor[i][k] * vector[k];
      vector[i] *= inverse_pivot[i];
    }
  }

  /** Solve with the upper triangle of the leading terms. */
  void
  backward(const Lanes* vector, int terms, Lanes* solution) const
  {
    for (int i = terms - 1; i >= 0; --i) {
      solution[i] = vector[i];
      for (int k = i + 1; k < terms; ++k)
        solution[i] -= factor[k][i] * solution[k];
      solution[i] *= inverse_pivot[i];
    }
  }
};

inline Lanes
sumOfSquares(const Lanes* values, int begin, int end)
{
  Lanes sum{};
  for (int i = begin; i < end; ++i)
    sum += values[i] * values[i];
  return sum;
}

inline Lanes
evaluate(const Lanes* coefficient, const Lanes& x, const Lanes& y, const Lanes& z)
{
  const Lanes one = Lanes{} + 1.0;
  Lanes term[cubic_terms];
  evaluateMonomials<cubic_terms>(one, x, y, z, term);
  Lanes sum = coefficient[0];
  for (int i = 1; i < cubic_terms; ++i)
    sum += coefficient[i] * term[i];
  return sum;
}

inline void
evaluateGradient(
    const Lanes* c, const Lanes& x, const Lanes& y, const Lanes& z, Lanes* gradient)
{
  gradient[0] = c[1] + x * (2.0 * c[4] + 3.0 * c[10] * x + 2.0 * c[11] * y) +
                y * (c[5] + c[13] * y + c[14] * z) +
                z * (c[6] + 2.0 * c[12] * x + c[15] * z);
  gradient[1] = c[2] + x * (c[5] + c[11] * x + 2.0 * c[13] * y) +
                y * (2.0 * c[7] + 3.0 * c[16] * y + 2.0 * c[17] * z) +
                z * (c[8] + c[14] * x + c[18] * z);
  gradient[2] = c[3] + x * (c[6] + c[12] * x + c[14] * y) +
                y * (c[8] + c[17] * y + 2.0 * c[18] * z) +
                z * (2.0 * c[9] + 2.0 * c[15] * x + 3.0 * c[19] * z);
}

inline void
evaluateHessian(
    const Lanes* c, const Lanes& x, const Lanes& y, const Lanes& z, Lanes* hessian)
{
  hessian[0] = 2.0 * (c[4] + 3.0 * c[10] * x + c[11] * y + c[12] * z);
  hessian[1] = c[5] + 2.0 * (c[11] * x + c[13] * y) + c[14] * z;
  hessian[2] = c[6] + 2.0 * (c[12] * x + c[15] * z) + c[14] * y;
  hessian[3] = 2.0 * (c[7] + c[13] * x + 3.0 * c[16] * y + c[17] * z);
  hessian[4] = c[8] + c[14] * x + 2.0 * (c[17] * y + c[18] * z);
  hessian[5] = 2.0 * (c[9] + c[15] * x + c[18] * y + 3.0 * c[19] * z);
}

Lanes
squaredResiduals(const FitSample* samples,
                 std::size_t count,
                 std::size_t first,
                 const Lanes* coefficient)
{
  Lanes sum{};
  for (std::size_t j = 0; j < count; ++j) {
    const Lanes x = load(samples[j].x + first), y = load(samples[j].y + first),
                z = load(samples[j].z + first);
    const Lanes residual =
        load(samples[j].value + first) - evaluate(coefficient, x, y, z);
    sum += weightOf(x, y, z) * residual * residual;
  }
  return sum;
}

/** The fits of one register, from the given lane on. */
void
fitRegister(const FitSample* samples,
            std::size_t count,
            const int* weighted,
            std::size_t first,
            FitResult& result)
{
  const Lanes zero{}, one = zero + 1.0;
  NormalEquations equations;
  equations.accumulate(samples, count, first);
  equations.factorize();

  Lanes reduced[cubic_terms];
  for (int i = 0; i < cubic_terms; ++i)
    reduced[i] = equations.right[i];
  equations.forward(reduced);
  Lanes coefficient[cubic_terms], quadratic[cubic_terms]{};
  equations.backward(reduced, cubic_terms, coefficient);
  equations.backward(reduced, quadratic_terms, quadratic);

  // Squared residuals of the quadratic: what the cubic terms explain comes on top.
  const Lanes cubic_residuals = squaredResiduals(samples, count, first, coefficient);
  const Lanes quadratic_residuals =
      cubic_residuals + sumOfSquares(reduced, quadratic_terms, cubic_terms);
  Lanes neighbors;
  for (std::size_t lane = 0; lane < register_lanes; ++lane)
    neighbors[lane] = weighted[first + lane];
  const Lanes cubic_variance = cubic_residuals / (neighbors - cubic_terms);
  const Lanes quadratic_variance = quadratic_residuals / (neighbors - quadratic_terms);

  // Leverage at the centre, where the value is the constant term.
  Lanes influence[cubic_terms]{};
  influence[0] = one;
  equations.forward(influence);
  const Lanes quadratic_leverage = sumOfSquares(influence, 0, quadratic_terms);
  const Lanes cubic_leverage =
      quadratic_leverage + sumOfSquares(influence, quadratic_terms, cubic_terms);
  const Mask quadratic_possible =
      equations.quadratic_regular & (neighbors >= quadratic_terms + least_freedom);
  const Mask cubic_possible =
      equations.cubic_regular & (neighbors >= cubic_terms + least_freedom);
  const Mask is_cubic =
      cubic_possible &
      (~quadratic_possible |
       (cubic_leverage * cubic_variance <= quadratic_leverage * quadratic_variance));
  for (int i = 0; i < cubic_terms; ++i)
    coefficient[i] = is_cubic ? coefficient[i] : quadratic[i];

  Lanes x = zero, y = zero, z = zero, gradient[3];
  for (int step = 0; step < newton_steps; ++step) {
    evaluateGradient(coefficient, x, y, z, gradient);
    const Lanes factor = evaluate(coefficient, x, y, z) / sumOfSquares(gradient, 0, 3);
    x -= factor * gradient[0];
    y -= factor * gradient[1];
    z -= factor * gradient[2];
  }
  Lanes hessian[6];
  evaluateGradient(coefficient, x, y, z, gradient);
  evaluateHessian(coefficient, x, y, z, hessian);
  const Lanes slope = squareRoot(sumOfSquares(gradient, 0, 3));
  const Lanes rest = evaluate(coefficient, x, y, z) / slope;
  const Mask found = (rest < converged_step) & (rest > -converged_step) &
                     (x * x + y * y + z * z < one) & (is_cubic | quadratic_possible);

  evaluateMonomials<cubic_terms>(one, x, y, z, influence);
  equations.forward(influence);
  const Lanes leverage =
      sumOfSquares(influence, 0, quadratic_terms) +
      (is_cubic ? sumOfSquares(influence, quadratic_terms, cubic_terms) : zero);
  const Lanes variance = is_cubic ? cubic_variance : quadratic_variance;
  store(x, result.offset[0] + first);
  store(y, result.offset[1] + first);
  store(z, result.offset[2] + first);
  for (int axis = 0; axis < 3; ++axis)
    store(gradient[axis], result.gradient[axis] + first);
  for (int i = 0; i < 6; ++i)
    store(hessian[i], result.hessian[i] + first);
  store(squareRoot(leverage * variance) / slope, result.error + first);
  store(squareRoot((is_cubic ? cubic_residuals : quadratic_residuals) /
                   equations.moment[0]),
        result.residual + first);
  for (std::size_t lane = 0; lane < register_lanes; ++lane)
    result.order[first + lane] = !found[lane]     ? fit_failed
                                 : is_cubic[lane] ? fit_cubic
                                                  : fit_quadratic;
}

} // namespace

void
fitZeroLevel(const FitSample* samples,
             std::size_t count,
             const int* weighted,
             FitResult& result)
{
  for (std::size_t first = 0; first < fit_lanes; first += register_lanes)
    fitRegister(samples, count, weighted, first, result);
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
