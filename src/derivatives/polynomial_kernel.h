// SPDX-License-Identifier: BSD-3-Clause
// Weighted least-squares polynomials through scattered values of several fields: eight
// centres at a time, one per vector lane, whose fields share one factorisation. Plain
// arrays, no library headers: the file is compiled once per instruction set.
#pragma once

#include <cstddef>

namespace pcl_uvol {

/** Terms of a cubic: by degree, then falling powers of x and y. */
constexpr std::size_t polynomial_terms = 20;

/** Centres per call, whatever the instruction set: it fixes the order of operations. */
constexpr std::size_t polynomial_lanes = 8;

/** \brief One neighbour of each of the eight centres. */
struct alignas(64) PolynomialSample {
  static constexpr bool has_value = false;
  double x[polynomial_lanes], y[polynomial_lanes],
      z[polynomial_lanes]; ///< relative to the centre, divided by the radius of the
                           ///< support; length 1 and more has no weight
};

/** \brief The eight polynomials of one field, in units of the radius of the support. */
struct alignas(64) PolynomialFit {
  double coefficient[polynomial_terms][polynomial_lanes];
  double error[polynomial_lanes]; ///< standard error of the value at the centre
  double pivot[polynomial_lanes]; ///< least part of a term of the cubic that those
                                  ///< before it do not give at the samples
  int degree[polynomial_lanes];   ///< 1 to 3; 0: the samples do not determine a linear
                                  ///< function, or leave no residual, and the rest is
                                  ///< undefined
};

/** \brief Fit polynomials with the weight (1 - d^2)^2: of the cubic and the quadratic
 * the one with the smaller standard error at the centre, see FitKernel; a linear
 * function where neither is determined, and where the weighted root mean square of the
 * residuals exceeds 15 % of the range of the values, as across a step, which no
 * polynomial follows. One step of refinement makes up for the normal equations: as good
 * as an orthogonal factorisation.
 * \param count neighbours per centre, those without weight included; even
 * \param weighted neighbours with a weight, per lane
 * \param values of one field after another: count times polynomial_lanes numbers, best
 * relative to the value at the centre; aligned to 64 bytes */
using PolynomialKernel = void (*)(const PolynomialSample* samples,
                                  std::size_t count,
                                  const int* weighted,
                                  const double* values,
                                  std::size_t fields,
                                  PolynomialFit* fits);

namespace baseline {
void
fitPolynomials(const PolynomialSample*,
               std::size_t,
               const int*,
               const double*,
               std::size_t,
               PolynomialFit*);
}
namespace avx2 {
void
fitPolynomials(const PolynomialSample*,
               std::size_t,
               const int*,
               const double*,
               std::size_t,
               PolynomialFit*);
}
namespace avx512 {
void
fitPolynomials(const PolynomialSample*,
               std::size_t,
               const int*,
               const double*,
               std::size_t,
               PolynomialFit*);
}

} // namespace pcl_uvol
