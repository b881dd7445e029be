// SPDX-License-Identifier: BSD-3-Clause
// Weighted least-squares polynomials through scattered values, and the point of their
// zero level next to the centre: eight fits at a time, one per vector lane. Plain
// arrays, no library headers: the file is compiled once per instruction set.
#pragma once

#include <cstddef>

namespace pcl_uvol {

/** Fits per call, whatever the instruction set: it fixes the order of operations. */
constexpr std::size_t fit_lanes = 8;

/** \brief One neighbour of each of the eight centres. */
struct alignas(64) FitSample {
  static constexpr bool has_value = true;
  float x[fit_lanes], y[fit_lanes], z[fit_lanes]; ///< relative to the centre, divided
                                                  ///< by the radius of the support;
                                                  ///< length 1 and more has no weight
  float value[fit_lanes];                         ///< minus the isovalue
};

/** \brief What became of a fit. */
enum FitOrder { fit_failed = 0, fit_quadratic = 2, fit_cubic = 3 };

/** \brief Zero level of the eight fits, in units of the radius of the support. */
struct alignas(64) FitResult {
  double value[fit_lanes];       ///< at the centre; NaN where the samples determine
                                 ///< neither polynomial
  double value_error[fit_lanes]; ///< its standard error
  double offset[3][fit_lanes];   ///< from the centre to the zero level
  double gradient[3][fit_lanes]; ///< there; value per radius
  double hessian[6][fit_lanes];  ///< there: xx xy xz yy yz zz
  double error[fit_lanes];       ///< standard error of the zero level's place
  double bias[fit_lanes];        ///< how far the fourth power of the distance from the
                                 ///< centre, as large as the samples tell, moves the
                                 ///< zero level, since the polynomial has no such term
  double slope_error[fit_lanes]; ///< standard error of the slope there, over the slope
  double residual[fit_lanes];    ///< weighted root mean square of the values' residuals
  double pivot[fit_lanes]; ///< least part of a term of the cubic that those before
                           ///< it do not give at the samples
  int order[fit_lanes]; ///< a FitOrder; but for value, its error and pivot the others
                        ///< are undefined for 0
};

/** \brief Fit a cubic and, from the leading part of the same normal equations, a
 * quadratic with the weight (1 - d^2)^2; go to the zero level of the one with the
 * smaller standard error (Newton along the gradient).
 *
 * The standard error is that of a weighted mean with the weights as precisions: the
 * root of leverage times mean squared residual; residuals stand for noise and for the
 * terms that the polynomial lacks alike. One of these, the fourth power of the distance
 * from the centre, leaves small residuals and moves the zero level nevertheless, since
 * value and curvature stand in for it: the bias is told apart. A fit fails where the
 * normal equations are singular, no degree of freedom is left, or the zero level is not
 * found within the radius.
 * \param count neighbours per centre, those without weight included; even
 * \param weighted neighbours with a weight, per lane */
using FitKernel = void (*)(const FitSample* samples,
                           std::size_t count,
                           const int* weighted,
                           FitResult& result);

namespace baseline {
void
fitZeroLevel(const FitSample*, std::size_t, const int*, FitResult&);
}
namespace avx2 {
void
fitZeroLevel(const FitSample*, std::size_t, const int*, FitResult&);
}
namespace avx512 {
void
fitZeroLevel(const FitSample*, std::size_t, const int*, FitResult&);
}

} // namespace pcl_uvol
