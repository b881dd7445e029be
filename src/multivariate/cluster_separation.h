// SPDX-License-Identifier: BSD-3-Clause
// How far apart clusters lie in a projection, and the projection that keeps them apart.
// The work is done in coordinates where the mean covariance of the clusters is 1: there
// all directions count alike, and steps of one length suit all of them.
#pragma once

#include "multivariate/cluster_moments.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Clusters, at least two, and the Fisher ratios of pairs of them in subspaces.
 *
 * A basis is an m x 3 matrix of functionals: in the coordinates of this class their
 * columns are orthonormal or 0. */
class ClusterSeparation {
public:
  /** \param total moments of all clusters
   * \param regularization see StarCoordinateParameters */
  ClusterSeparation(const std::vector<Moments>& clusters,
                    const Moments& total,
                    double regularization);

  /** \brief Functionals of the attributes in the coordinates of this class, made
   * orthonormal; columns that depend on earlier ones become 0. */
  Eigen::MatrixXd
  toBasis(const Eigen::MatrixXd& functionals) const;

  /** \brief Functionals of the attributes that span the same. */
  Eigen::MatrixXd
  toFunctionals(const Eigen::MatrixXd& basis) const;

  std::size_t
  countClusters() const
  {
    return means_.size();
  }

  /** \brief The smallest Fisher ratio of all pairs. */
  double
  smallestRatio(const Eigen::MatrixXd& basis) const;

  /** \brief Pairs with equal centres, which the functions below leave out. */
  std::size_t
  countInseparable() const
  {
    return inseparable_.size();
  }

  /** \brief The smallest ratio of the other pairs; infinite if there are none. */
  double
  findSmallestSeparable(const Eigen::MatrixXd& basis) const;

  /** \brief The directions along which the centres differ most, as columns; 0 where
   * there are fewer than three.
   * \param favours_close pairs count by 1 / distance^2, else by distance^2 */
  Eigen::MatrixXd
  centreAxes(bool favours_close) const;

  /** \brief The discriminant of the pair that is hardest to tell, of the one that is
   * hardest to tell along the former, and so on; 0 where there are fewer than three. */
  Eigen::MatrixXd
  discriminants() const;

  /** \brief Ascend from a basis; what comes of it is no worse. */
  Eigen::MatrixXd
  ascend(const Eigen::MatrixXd& start, unsigned steps) const;

  /** \brief Covariance of the centres in attributes, each cluster counting alike. */
  Eigen::MatrixXd
  computeCentreCovariance() const;

private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  /** Clusters in a subspace; where the basis has a column of 0, offsets are 0 there. */
  struct Projected {
    std::vector<Eigen::Vector3d> means;
    std::vector<Eigen::Matrix3d> covariances;
    std::vector<Eigen::MatrixXd> half_projected; ///< covariance times basis
  };
  struct SoftMinimum;

  /** The Fisher ratio, and the discriminant in the subspace. */
  static double
  computeRatio(const Eigen::Matrix3d& covariance,
               const Eigen::Vector3d& offset,
               Eigen::Vector3d& discriminant);

  Projected
  project(const Eigen::MatrixXd& basis) const;

  double
  findSmallestRatio(const std::vector<Pair>& pairs, const Eigen::MatrixXd& basis) const;

  /** The smallest ratio of the separable pairs. */
  SoftMinimum
  softMinimum(const Eigen::MatrixXd& basis, double sharpness) const;

  Eigen::VectorXd
  computeOffset(const Pair& pair) const
  {
    return means_[pair.first] - means_[pair.second];
  }

  Eigen::MatrixXd root_; ///< lower triangular, root root^T = mean covariance
  std::vector<Eigen::VectorXd> means_;
  std::vector<Eigen::MatrixXd> covariances_;
  std::vector<Pair> separable_, inseparable_;
};

} // namespace pcl_uvol
