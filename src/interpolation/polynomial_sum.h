// SPDX-License-Identifier: BSD-3-Clause
// The weighted mean of polynomials around several samples, at a place.
#pragma once

#include "interpolation/blend_kernel.h"
#include "interpolation/field_model.h"
#include "interpolation/sample_metrics.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Sums up values, gradients and errors of polynomials of several fields. */
class PolynomialSum {
public:
  /** \brief One of every field. */
  struct Polynomial {
    const double* coefficients;    ///< [field][term], see PolynomialFit
    const double* errors;          ///< [field]
    double radius;                 ///< their unit, in the metric
    const StretchedMetric* metric; ///< of their coordinates; null: that of space
  };

  /** \brief What is added. */
  struct Part {
    Polynomial polynomial;
    double weight;
    std::array<double, 3> offset; ///< from the centre, in the metric, in radii
    std::array<double, 3> weight_gradient;
  };

  /** \param gradients false: they are not summed up */
  PolynomialSum(std::size_t fields, bool gradients, const BlendKernels& kernels);

  void
  clear();

  void
  add(const Part& part);

  /** \brief Add polynomials that go straight on beyond a distance, in radii. */
  void
  addStraight(const Part& part, double farthest);

  double
  getWeight() const
  {
    return weight_;
  }

  const std::array<double, 3>&
  getWeightGradient() const
  {
    return weight_gradient_;
  }

  /** \brief The error of the mean of a field, see finish(). */
  double
  computeError(std::size_t field) const;

  /** \brief Store the mean, its gradient, and its error: the mean of the squared errors
   * and the spread of the values. */
  void
  finish(std::size_t query, const Estimates& estimates) const;

private:
  /** Turn gradients in the metric of a part into those in space. */
  void
  leaveMetric(const Part& part);

  /** Add the values and gradients of a part. */
  void
  addValues(const Part& part);

  const BlendKernels& kernels_;
  std::size_t fields_;
  double weight_ = 0.0;
  std::array<double, 3> weight_gradient_{};
  bool is_empty_ = true;
  // One number for each field:
  std::vector<double> values_, gradients_; ///< of a part; gradients by axis as well
  std::vector<double> references_; ///< values are summed relative to the first ones
  std::vector<double> value_sums_, square_sums_, sq_error_sums_;
  std::vector<double> gradient_sums_; ///< by axis as well; none: not wanted
};

} // namespace pcl_uvol::detail
