// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/cluster_separation.h"

#include "multivariate/linear_algebra.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Index = Eigen::Index;

/** Squared distance of centres, in units of the mean covariance, that is rounding. */
constexpr double least_separation = 1e-12;
/** Eigenvalues below this part of the largest one are 0. */
constexpr double least_eigenvalue = 1e-9;

/** Product of a matrix and a basis, column by column: each is read once. */
MatrixXd
timesBasis(const MatrixXd& matrix, const MatrixXd& basis)
{
  MatrixXd product = MatrixXd::Zero(basis.rows(), 3);
  for (Index i = 0; i < matrix.cols(); ++i)
    for (Index k = 0; k < 3; ++k)
      product.col(k) += matrix.col(i) * basis(i, k);
  return product;
}

} // namespace

double
ClusterSeparation::computeRatio(const Matrix3d& covariance,
                                const Vector3d& offset,
                                Vector3d& discriminant)
{
  discriminant = covariance.llt().solve(offset);
  return std::max(offset.dot(discriminant), 0.0);
}

ClusterSeparation::ClusterSeparation(const std::vector<Moments>& clusters,
                                     const Moments& total,
                                     double regularization)
{
  // Attributes that never change get what others have: they do not matter, but keep
  // matrices regular.
  VectorXd spread = total.covariance().diagonal();
  const double usual = spread.mean() > 0.0 ? spread.mean() : 1.0;
  spread = (spread.array() > 0.0).select(spread, usual) * regularization;

  const Index m = spread.size();
  MatrixXd mean_covariance = MatrixXd::Zero(m, m);
  for (const Moments& cluster : clusters) {
    covariances_.push_back(cluster.covariance());
    covariances_.back().diagonal() += spread;
    mean_covariance += covariances_.back() / static_cast<double>(clusters.size());
    means_.push_back(cluster.mean - total.mean);
  }
  root_ = computeCholeskyRoot(mean_covariance);
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    solveLowerInPlace(root_, means_[c]);
    solveLowerInPlace(root_, covariances_[c]);
    covariances_[c].transposeInPlace();
    solveLowerInPlace(root_, covariances_[c]);
    for (std::uint32_t other = 0; other < c; ++other) {
      const bool is_separable =
          computeOffset({other, c}).squaredNorm() > least_separation;
      (is_separable ? separable_ : inseparable_).push_back({other, c});
    }
  }
}

MatrixXd
ClusterSeparation::toBasis(const MatrixXd& functionals) const
{
  return orthonormalized(root_.transpose().lazyProduct(functionals));
}

MatrixXd
ClusterSeparation::toFunctionals(const MatrixXd& basis) const
{
  return solveLowerTransposed(root_, basis);
}

MatrixXd
ClusterSeparation::computeCentreCovariance() const
{
  const Index m = root_.rows();
  const VectorXd zero = VectorXd::Zero(m);
  Moments centres{0.0, zero, MatrixXd::Zero(m, m)};
  for (const VectorXd& mean : means_)
    centres.join({1.0, root_.lazyProduct(mean), MatrixXd::Zero(m, m)});
  return centres.covariance();
}

ClusterSeparation::Projected
ClusterSeparation::project(const MatrixXd& basis) const
{
  Projected projected;
  Matrix3d missing = Matrix3d::Zero();
  for (Index k = 0; k < 3; ++k)
    missing(k, k) = basis.col(k).isZero() ? 1.0 : 0.0;
  for (std::size_t c = 0; c < means_.size(); ++c) {
    projected.means.push_back(basis.transpose().lazyProduct(means_[c]));
    projected.half_projected.push_back(timesBasis(covariances_[c], basis));
    projected.covariances.push_back(
        basis.transpose().lazyProduct(projected.half_projected[c]) + missing);
  }
  return projected;
}

double
ClusterSeparation::findSmallestRatio(const std::vector<Pair>& pairs,
                                     const MatrixXd& basis) const
{
  const Projected projected = project(basis);
  double smallest = std::numeric_limits<double>::infinity();
  Vector3d discriminant;
  for (const auto& [a, b] : pairs)
    smallest =
        std::min(smallest,
                 computeRatio(projected.covariances[a] + projected.covariances[b],
                              projected.means[a] - projected.means[b],
                              discriminant));
  return smallest;
}

double
ClusterSeparation::smallestRatio(const MatrixXd& basis) const
{
  return std::min(findSmallestRatio(separable_, basis),
                  findSmallestRatio(inseparable_, basis));
}

double
ClusterSeparation::findSmallestSeparable(const MatrixXd& basis) const
{
  return findSmallestRatio(separable_, basis);
}

MatrixXd
ClusterSeparation::centreAxes(bool favours_close) const
{
  const Index m = root_.rows();
  MatrixXd between = MatrixXd::Zero(m, m);
  for (const Pair& pair : separable_) {
    const VectorXd offset = computeOffset(pair);
    const double sq_dist = offset.squaredNorm();
    const double weight = favours_close ? 1.0 / (sq_dist * sq_dist) : 1.0;
    between += offset * (weight * offset).transpose();
  }
  const EigenPairs pairs = computeEigenPairs(between);
  const double least = least_eigenvalue * pairs.values[m - 1];
  MatrixXd axes = MatrixXd::Zero(m, 3);
  for (Index k = 0; k < std::min<Index>(3, m); ++k)
    if (pairs.values[m - 1 - k] > least)
      axes.col(k) = pairs.vectors.col(m - 1 - k);
  return axes;
}

MatrixXd
ClusterSeparation::discriminants() const
{
  const Index m = root_.rows();
  MatrixXd basis = MatrixXd::Zero(m, 3);
  std::vector<std::pair<double, Pair>> order;
  for (const Pair& pair : separable_)
    order.emplace_back(computeOffset(pair).squaredNorm(), pair);
  Index count = 0;
  while (!order.empty() && count < std::min<Index>(3, m)) {
    std::sort(order.begin(), order.end());
    for (const auto& [ratio, pair] : order) {
      basis.col(count) = solvePositive(
          covariances_[pair.first] + covariances_[pair.second], computeOffset(pair));
      basis = orthonormalized(basis);
      if (!basis.col(count).isZero())
        break;
    }
    if (basis.col(count).isZero())
      break;
    ++count;
    const Projected projected = project(basis);
    Vector3d discriminant;
    for (auto& [ratio, pair] : order)
      ratio = computeRatio(projected.covariances[pair.first] +
                               projected.covariances[pair.second],
                           projected.means[pair.first] - projected.means[pair.second],
                           discriminant);
  }
  return basis;
}

} // namespace pcl_uvol
