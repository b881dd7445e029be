// SPDX-License-Identifier: BSD-3-Clause
// Least-squares polynomials where samples do not determine all terms: samples on a
// plane, a line, few layers, or few samples.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>

#include <vector>

namespace pcl_uvol::detail {

/** \brief Polynomials with the weight (1 - d^2)^2 around the origin: of all with the
 * least squared residuals those of the least coefficients, so that derivatives across a
 * plane or a line of samples are 0. */
class ReducedFit {
public:
  /** \brief A smaller pivot is rounding of coordinates in float. */
  static constexpr double rounding = 1e-6;

  /** \param offsets of the samples, shorter than 1; one of them zero
   * \param smallest_pivot of the largest one: what is smaller does not determine a term
   * \param all_terms leave degrees above the first out of which samples do not
   * determine all terms */
  explicit ReducedFit(const Eigen::MatrixX3d& offsets,
                      double smallest_pivot = rounding,
                      bool all_terms = false);

  /** \brief The polynomial of the degree up to 3 with the smallest standard error of
   * the value at the origin, a linear one where no degree leaves five degrees of
   * freedom.
   * \param coefficients set: 20 of them, see PolynomialFit
   * \return that standard error; NaN if no degree of freedom tells it */
  double
  solve(const Eigen::VectorXd& values, double* coefficients) const;

private:
  struct Degree {
    Eigen::MatrixXd terms;   ///< times the roots of the weights
    Eigen::MatrixXd inverse; ///< of these
    double leverage;         ///< at the origin
    double freedom;          ///< degrees of it
  };

  Eigen::VectorXd root_weights_;
  std::vector<Degree> degrees_; ///< lowest first
};

} // namespace pcl_uvol::detail
