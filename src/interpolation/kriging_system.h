// SPDX-License-Identifier: BSD-3-Clause
// The equations of kriging in one neighbourhood.
#pragma once

#include "interpolation/variogram.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>

namespace pcl_uvol::detail {

/** \brief An estimate at the origin. */
struct KrigingEstimate {
  double value, variance;
  Eigen::Vector3d gradient;
};

/** \brief Solves for the estimate at the origin from samples around it. */
class KrigingSystem {
public:
  /** \param offsets of the samples, whose length is the distance of the variogram
   * \param trend degree of the polynomial of which the mean is one: 0, 1 or 2; lower
   * where samples are fewer than its terms */
  KrigingSystem(const Eigen::MatrixX3d& offsets, const Variogram& variogram, int trend);

  KrigingEstimate
  estimate(const Eigen::VectorXd& values) const;

private:
  const Eigen::MatrixX3d& offsets_;
  const Variogram& variogram_;
  int trend_;
  double unit_; ///< of lengths in the terms of the trend
  Eigen::LLT<Eigen::MatrixXd> covariance_;
  Eigen::VectorXd to_origin_; ///< covariances with the value there
  Eigen::MatrixXd terms_, solved_terms_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> trend_equations_;
};

} // namespace pcl_uvol::detail
