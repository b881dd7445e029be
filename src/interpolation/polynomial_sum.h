// SPDX-License-Identifier: BSD-3-Clause
// The weighted mean of polynomials around several samples, at a place.
#pragma once

#include "derivatives/polynomial_kernel.h"
#include "interpolation/field_model.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Sums up values, gradients and errors of polynomials of several fields. */
class PolynomialSum {
public:
  /** \brief One of every field. */
  struct Polynomial {
    const double* coefficients; ///< [field][term], see PolynomialFit
    const double* errors;       ///< [field]
    double radius;              ///< their unit
  };

  /** \brief What is added. */
  struct Part {
    Polynomial polynomial;
    double weight;
    std::array<double, 3> offset; ///< from the centre, in units of the radius
    std::array<double, 3> weight_gradient;
  };

  explicit PolynomialSum(std::size_t fields);

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

  /** \brief Store the mean, its gradient, and its error: the mean of the squared errors
   * and the spread of the values. */
  void
  finish(std::size_t query, const Estimates& estimates) const;

private:
  struct Sums {
    double reference; ///< values are summed relative to the first one
    double value, square, sq_error;
    std::array<double, 3> gradient;
  };

  void
  addValues(std::size_t field,
            const Part& part,
            double value,
            const std::array<double, 3>& gradient);

  double weight_ = 0.0;
  std::array<double, 3> weight_gradient_{};
  bool is_empty_ = true;
  std::vector<Sums> sums_; ///< [field]
};

} // namespace pcl_uvol::detail
