// SPDX-License-Identifier: BSD-3-Clause
// The equations of kriging in one neighbourhood.
#pragma once

#include "common/eigen_solvers.h"
#include "interpolation/variogram.h"

#include <Eigen/Core>

namespace pcl_uvol::detail {

/** \brief An estimate of a target, and how it changes with its place. */
struct KrigingEstimate {
  double value, variance;
  Eigen::Vector3d gradient;
};

/** \brief What is estimated: the value at the origin, or the mean of a block about it.
 */
struct KrigingTarget {
  /** \brief The value at the origin. Its variance is that of another sample. */
  explicit KrigingTarget(const Variogram& variogram);

  /** \brief The mean over a block, which has no nugget (Journel and Huijbregts, Mining
   * Geostatistics, 1978, section V.A).
   * \param places that stand for all of the block, symmetric about the origin */
  KrigingTarget(const Variogram& variogram, Eigen::MatrixX3d places);

  /** \brief Places that stand for a block about the origin, as rows: four along each
   * side that it has, with which the variance of its mean is known to some percent
   * (Journel and Huijbregts 1978, section II.D.2).
   * \param sides in the input
   * \param to_metric from offsets of the input to those of the variogram */
  static Eigen::MatrixX3d
  divideBlock(const Eigen::Array3f& sides, const Eigen::Matrix3d& to_metric);

  Eigen::MatrixX3d places;
  double variance; ///< without any sample
};

/** \brief Solves for the estimate of a target from samples around it. */
class KrigingSystem {
public:
  /** \param offsets of the samples, whose length is the distance of the variogram
   * \param trend degree of the polynomial of which the mean is one: 0, 1 or 2; lower
   * where samples are fewer than its terms */
  KrigingSystem(const Eigen::MatrixX3d& offsets,
                const Variogram& variogram,
                const KrigingTarget& target,
                int trend);

  KrigingEstimate
  estimate(const Eigen::VectorXd& values) const;

private:
  const Eigen::MatrixX3d& offsets_;
  const Variogram& variogram_;
  const KrigingTarget& target_;
  int trend_;
  double unit_; ///< of lengths in the terms of the trend
  Eigen::LLT<Eigen::MatrixXd> covariance_;
  Eigen::VectorXd to_target_, target_terms_; ///< covariances with it, and terms there
  Eigen::MatrixXd terms_, solved_terms_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> trend_equations_;
};

} // namespace pcl_uvol::detail
