// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: weighted least-squares cubics and quadratics, one fit per lane,
// by normal equations that the polynomials of all degrees share.
#pragma once

#include "common/register_bytes.h"

#include <cmath>
#include <cstddef>

namespace pcl_uvol::PCL_UVOL_SIMD {

constexpr std::size_t register_lanes = register_bytes / sizeof(double);

/** One number per fit, as many as a register holds. */
using Lanes = double __attribute__((vector_size(register_bytes)));
using Mask = decltype(Lanes{} < Lanes{});

constexpr int linear_terms = 4;
constexpr int quadratic_terms = 10;
constexpr int cubic_terms = 20;
constexpr int degree = 3;
constexpr int moment_count = 84; // monomials up to twice the degree: products of terms

/** Share of a term's own diagonal entry: a smaller pivot is rounding, and the term
 * cannot be told from those before it (samples on a plane, on few layers of a lattice).
 */
constexpr double smallest_pivot = 1e-9;
/** Residuals of fewer degrees of freedom say nothing about the error. */
constexpr double least_freedom = 5.0;

/** Monomials x^a y^b z^c by degree, then falling powers of x and y; those of a lower
 * degree come first, so that the quadratic fit is the leading part of the cubic one. */
struct Monomials {
  int index[2 * degree + 1][2 * degree + 1][2 * degree + 1]{}; ///< by the three powers
  int power[cubic_terms][3]{};                                 ///< of x, y and z
  int parent[cubic_terms]{}; ///< the term without one factor ...
  int axis[cubic_terms]{};   ///< ... and the coordinate that this factor is
  int product[cubic_terms][cubic_terms]{};

  constexpr Monomials()
  {
    int count = 0;
    for (int sum = 0; sum <= 2 * degree; ++sum)
      for (int a = sum; a >= 0; --a)
        for (int b = sum - a; b >= 0; --b) {
          if (count < cubic_terms) {
            power[count][0] = a;
            power[count][1] = b;
            power[count][2] = sum - a - b;
          }
          index[a][b][sum - a - b] = count++;
        }
    for (int i = 1; i < cubic_terms; ++i) {
      const int* const p = power[i];
      axis[i] = p[0] > 0 ? 0 : p[1] > 0 ? 1 : 2;
      parent[i] =
          index[p[0] - (axis[i] == 0)][p[1] - (axis[i] == 1)][p[2] - (axis[i] == 2)];
    }
    for (int i = 0; i < cubic_terms; ++i)
      for (int j = 0; j < cubic_terms; ++j)
        product[i][j] = index[power[i][0] + power[j][0]][power[i][1] + power[j][1]]
                             [power[i][2] + power[j][2]];
  }
};

inline constexpr Monomials monomials;

inline Lanes
load(const float* values)
{
  using Singles = float __attribute__((vector_size(register_lanes * sizeof(float))));
  return __builtin_convertvector(*reinterpret_cast<const Singles*>(values), Lanes);
}

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
atLeastZero(const Lanes& a)
{
  const Lanes zero{};
  return a > zero ? a : zero;
}

/** The terms of a cubic. */
inline void
evaluateTerms(const Lanes& x, const Lanes& y, const Lanes& z, Lanes* value)
{
  value[0] = Lanes{} + 1.0;
#pragma GCC unroll 20
  for (int i = 1; i < cubic_terms; ++i)
    value[i] = value[monomials.parent[i]] * (monomials.axis[i] == 0   ? x
                                             : monomials.axis[i] == 1 ? y
                                                                      : z);
}

/** Their derivatives along a direction.
 * \param value the terms */
inline void
differentiateTerms(const Lanes* value,
                   const Lanes& x,
                   const Lanes& y,
                   const Lanes& z,
                   const Lanes* direction,
                   Lanes* derivative)
{
  const Lanes place[3] = {x, y, z};
  derivative[0] = Lanes{};
#pragma GCC unroll 20
  for (int i = 1; i < cubic_terms; ++i) {
    const int parent = monomials.parent[i], axis = monomials.axis[i];
    derivative[i] = derivative[parent] * place[axis] + value[parent] * direction[axis];
  }
}

/** A sample of every fit, its weight, and the fourth power of its distance from the
 * centre. */
struct Term {
  Lanes x, y, z, value{}, weight, fourth_power;

  template <typename Sample>
  Term(const Sample& sample, std::size_t first)
      : x(load(sample.x + first))
      , y(load(sample.y + first))
      , z(load(sample.z + first))
  {
    if constexpr (Sample::has_value)
      value = load(sample.value + first);
    const Lanes square = x * x + y * y + z * z;
    const Lanes rest = atLeastZero(1.0 - square);
    weight = rest * rest;
    fourth_power = square * square;
  }
};

/** The normal equations of the cubic fit and their Cholesky factor, row by row. */
struct NormalEquations {
  Lanes moment[moment_count]{};
  Lanes right[cubic_terms]{};
  Lanes squares{};                        // of the values
  Lanes fourth_power[cubic_terms]{};      // its products with the terms of third degree
  Lanes fourth_square{}, fourth_right{};  // ... with itself and with the values
  Lanes factor[cubic_terms][cubic_terms]; // lower triangle
  Lanes inverse_pivot[cubic_terms];
  Lanes least_pivot; // of its own diagonal entry
  Mask linear_regular, quadratic_regular, cubic_regular;

  /** The left sides and, of samples with a value, the right ones. Two samples at a
   * time, for half the traffic of the sums; along x in registers. */
  template <typename Sample>
  void
  accumulate(const Sample* samples, std::size_t count, std::size_t first)
  {
    for (std::size_t j = 0; j < count; j += 2) {
      const Term one(samples[j], first), two(samples[j + 1], first);
      if constexpr (Sample::has_value) {
        squares +=
            one.weight * one.value * one.value + two.weight * two.value * two.value;
        const Lanes one_fourth = one.weight * one.fourth_power,
                    two_fourth = two.weight * two.fourth_power;
        fourth_square += one_fourth * one.fourth_power + two_fourth * two.fourth_power;
        fourth_right += one_fourth * one.value + two_fourth * two.value;
      }
      Lanes one_z = one.weight, two_z = two.weight;
#pragma GCC unroll 7
      for (int c = 0; c <= 2 * degree; ++c) {
        Lanes one_yz = one_z, two_yz = two_z;
#pragma GCC unroll 7
        for (int b = 0; b <= 2 * degree - c; ++b) {
          Lanes one_xyz = one_yz, two_xyz = two_yz;
#pragma GCC unroll 7
          for (int a = 0; a <= 2 * degree - c - b; ++a) {
            const int i = monomials.index[a][b][c];
            moment[i] += one_xyz + two_xyz;
            if (Sample::has_value && a + b + c <= degree)
              right[i] += one_xyz * one.value + two_xyz * two.value;
            if (Sample::has_value && a + b + c == degree)
              fourth_power[i] +=
                  one_xyz * one.fourth_power + two_xyz * two.fourth_power;
            one_xyz *= one.x;
            two_xyz *= two.x;
          }
          one_yz *= one.y;
          two_yz *= two.y;
        }
        one_z *= one.z;
        two_z *= two.z;
      }
    }
  }

  void
  factorize()
  {
    const Lanes zero{}, one = zero + 1.0;
    least_pivot = one;
    linear_regular = quadratic_regular = cubic_regular = zero == zero;
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
      const Lanes part = regular ? pivot / diagonal : zero;
      least_pivot = part < least_pivot ? part : least_pivot;
      cubic_regular &= regular;
      if (i < quadratic_terms)
        quadratic_regular &= regular;
      if (i < linear_terms)
        linear_regular &= regular;
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
sumSquares(const Lanes* values, int begin, int end)
{
  Lanes sum{};
  for (int i = begin; i < end; ++i)
    sum += values[i] * values[i];
  return sum;
}

inline Lanes
evaluate(const Lanes* coefficient, const Lanes& x, const Lanes& y, const Lanes& z)
{
  Lanes term[cubic_terms];
  evaluateTerms(x, y, z, term);
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

} // namespace pcl_uvol::PCL_UVOL_SIMD
