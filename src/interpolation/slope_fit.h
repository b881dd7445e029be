// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of a field at a sample from a least-squares polynomial, with their
// standard error.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl_uvol::detail {

/** \brief Derivatives at the origin, by the axes of the offsets. */
struct Slopes {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  double error; ///< standard error of the gradient: its length; infinite where samples
                ///< do not determine a linear function, NaN without residuals
};

/** \brief Polynomials with the weight (1 - d^2)^2 around the origin, of one, two or
 * three coordinates. */
class SlopeFit {
public:
  /** \param offsets [sample][coordinate], one of the samples at the origin
   * \param root_weights of the samples: 1 - d^2 */
  SlopeFit(const Eigen::MatrixXd& offsets, const Eigen::VectorXd& root_weights);

  /** \brief The derivatives of the quadratic, or of the linear function if its gradient
   * has the smaller standard error, or if samples do not determine a quadratic well or
   * leave less than five degrees of freedom.
   * \param values of the samples */
  Slopes
  solve(const Eigen::VectorXd& values) const;

private:
  struct Degree {
    Eigen::MatrixXd terms;   ///< times the roots of the weights
    Eigen::MatrixXd inverse; ///< of these
    double leverage;         ///< of the gradient
    double freedom;          ///< degrees of it
  };

  Eigen::Index dimensions_;
  Eigen::VectorXd root_weights_;
  std::vector<Degree> degrees_; ///< lowest first
};

} // namespace pcl_uvol::detail
