// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/cluster_separation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

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

/** Sharpness of the soft minimum, one after the other: at the last one 100 equal ratios
 * count as one that is 4 % smaller. */
constexpr double sharpnesses[] = {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0};
/** The ascent at one sharpness ends when a step gains less than this, relatively. */
constexpr double least_gain = 1e-7;
/** Lengths of moves of the basis, whose columns are of length 1. */
constexpr double first_move = 0.1, shortest_move = 1e-9, longest_move = 0.7;
/** A step that does not keep this part of what the gradient promises (Armijo 1966) is
 * made shorter by this factor. */
constexpr double kept_promise = 1e-4, shortening = 0.25;

/** Columns whose part perpendicular to earlier ones is shorter are none of their own.
 */
constexpr double least_new_part = 1e-6;
/** Squared distance of centres, in units of the mean covariance, that is rounding. */
constexpr double least_separation = 1e-12;
/** Ratios that are added: the logarithm of 0 would be infinite. */
constexpr double ratio_floor = 1e-15;
/** Eigenvalues below this part of the largest one are 0. */
constexpr double least_eigenvalue = 1e-9;

/** The Fisher ratio, and the discriminant in the subspace. */
double
computeRatio(const Matrix3d& covariance, const Vector3d& offset, Vector3d& discriminant)
{
  discriminant = covariance.llt().solve(offset);
  return std::max(offset.dot(discriminant), 0.0);
}

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

/** The orthonormal basis closest to one that nearly is. */
MatrixXd
retracted(const MatrixXd& basis)
{
  const Matrix3d gram = basis.transpose().lazyProduct(basis);
  return basis.lazyProduct(
      Eigen::SelfAdjointEigenSolver<Matrix3d>(gram).operatorInverseSqrt());
}

} // namespace

/** Clusters in a subspace; where the basis has a column of 0, offsets are 0 there. */
struct ClusterSeparation::Projected {
  std::vector<Vector3d> means;
  std::vector<Matrix3d> covariances;
  std::vector<MatrixXd> half_projected; ///< covariance times basis
};

/** The power mean of exponent -sharpness of the ratios, times a constant. */
struct ClusterSeparation::SoftMinimum {
  double logarithm;
  MatrixXd gradient; ///< of the logarithm by the basis; perpendicular to the basis
  double smallest;   ///< ratio
};

MatrixXd
orthonormalized(MatrixXd columns)
{
  for (Index k = 0; k < columns.cols(); ++k) {
    VectorXd column = columns.col(k).stableNormalized();
    for (int pass = 0; pass < 2; ++pass) { // twice is enough (Parlett 1980)
      for (Index earlier = 0; earlier < k; ++earlier)
        column -= columns.col(earlier).dot(column) * columns.col(earlier);
      if (column.norm() < least_new_part)
        column.setZero();
      column.stableNormalize();
    }
    columns.col(k) = column;
  }
  return columns;
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
  root_ = mean_covariance.llt().matrixL();
  const auto lower = root_.triangularView<Eigen::Lower>();
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    lower.solveInPlace(means_[c]);
    lower.solveInPlace(covariances_[c]);
    covariances_[c].transposeInPlace();
    lower.solveInPlace(covariances_[c]);
    for (std::uint32_t other = 0; other < c; ++other) {
      const bool is_separable = offsetOf({other, c}).squaredNorm() > least_separation;
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
  return root_.triangularView<Eigen::Lower>().transpose().solve(basis);
}

MatrixXd
ClusterSeparation::covarianceOfCentres() const
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
ClusterSeparation::smallestOfSeparable(const MatrixXd& basis) const
{
  return findSmallestRatio(separable_, basis);
}

MatrixXd
ClusterSeparation::centreAxes(bool favours_close) const
{
  const Index m = root_.rows();
  MatrixXd between = MatrixXd::Zero(m, m);
  for (const Pair& pair : separable_) {
    const VectorXd offset = offsetOf(pair);
    const double sq_dist = offset.squaredNorm();
    between.selfadjointView<Eigen::Lower>().rankUpdate(
        offset, favours_close ? 1.0 / (sq_dist * sq_dist) : 1.0);
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(between);
  const double least = least_eigenvalue * solver.eigenvalues()[m - 1];
  MatrixXd axes = MatrixXd::Zero(m, 3);
  for (Index k = 0; k < std::min<Index>(3, m); ++k)
    if (solver.eigenvalues()[m - 1 - k] > least)
      axes.col(k) = solver.eigenvectors().col(m - 1 - k);
  return axes;
}

MatrixXd
ClusterSeparation::discriminants() const
{
  const Index m = root_.rows();
  MatrixXd basis = MatrixXd::Zero(m, 3);
  std::vector<std::pair<double, Pair>> order;
  for (const Pair& pair : separable_)
    order.emplace_back(offsetOf(pair).squaredNorm(), pair);
  Index count = 0;
  while (!order.empty() && count < std::min<Index>(3, m)) {
    std::sort(order.begin(), order.end());
    for (const auto& [ratio, pair] : order) {
      basis.col(count) = (covariances_[pair.first] + covariances_[pair.second])
                             .llt()
                             .solve(offsetOf(pair));
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

ClusterSeparation::SoftMinimum
ClusterSeparation::softMinimum(const MatrixXd& basis, double sharpness) const
{
  const Projected projected = project(basis);
  std::vector<Vector3d> discriminants(separable_.size());
  std::vector<double> ratios(separable_.size());
  for (std::size_t p = 0; p < separable_.size(); ++p) {
    const auto& [a, b] = separable_[p];
    ratios[p] =
        ratio_floor + computeRatio(projected.covariances[a] + projected.covariances[b],
                                   projected.means[a] - projected.means[b],
                                   discriminants[p]);
  }
  const double smallest = *std::min_element(ratios.begin(), ratios.end());
  std::vector<double> weights(separable_.size());
  double sum = 0.0;
  for (std::size_t p = 0; p < separable_.size(); ++p)
    sum += weights[p] = std::pow(ratios[p] / smallest, -sharpness);

  // With offset d, covariance S and u = (B^T S B)^-1 B^T d, a ratio is d^T B u and its
  // gradient 2 (d - S B u) u^T: sums of u and u u^T per cluster are all it takes.
  std::vector<Vector3d> by_mean(means_.size(), Vector3d::Zero());
  std::vector<Matrix3d> by_covariance(means_.size(), Matrix3d::Zero());
  for (std::size_t p = 0; p < separable_.size(); ++p) {
    const auto& [a, b] = separable_[p];
    const double weight = 2.0 * weights[p] / (sum * ratios[p]);
    const Vector3d& u = discriminants[p];
    by_mean[a] += weight * u;
    by_mean[b] -= weight * u;
    const Matrix3d square = weight * u * u.transpose();
    by_covariance[a] += square;
    by_covariance[b] += square;
  }
  MatrixXd gradient = MatrixXd::Zero(basis.rows(), 3);
  for (std::size_t c = 0; c < means_.size(); ++c) {
    gradient += means_[c].lazyProduct(by_mean[c].transpose());
    gradient -= projected.half_projected[c].lazyProduct(by_covariance[c]);
  }
  return {std::log(smallest) - std::log(sum) / sharpness, gradient, smallest};
}

MatrixXd
ClusterSeparation::ascend(const MatrixXd& start, unsigned steps) const
{
  if (separable_.empty())
    return start;
  MatrixXd best = start, basis = start;
  double best_ratio = smallestOfSeparable(start);
  for (const double sharpness : sharpnesses) {
    SoftMinimum here = softMinimum(basis, sharpness);
    double length = first_move / std::max(here.gradient.norm(), first_move);
    for (unsigned step = 0; step < steps; ++step) {
      const double slope = here.gradient.norm();
      length = std::min(length, longest_move / std::max(slope, longest_move));
      MatrixXd next;
      SoftMinimum there;
      // Written so that what is not a number ends it.
      bool is_gain = false;
      while (!is_gain && length * slope >= shortest_move) {
        next = retracted(basis + length * here.gradient);
        there = softMinimum(next, sharpness);
        is_gain =
            there.logarithm >= here.logarithm + kept_promise * length * slope * slope;
        length *= shortening;
      }
      if (!is_gain)
        break;
      // The length by which the last step would have met the turn of the gradient
      // (Barzilai, Borwein 1988).
      const MatrixXd move = next - basis;
      const double turn =
          std::abs(move.cwiseProduct(here.gradient - there.gradient).sum());
      length = move.squaredNorm() / std::max(turn, std::numeric_limits<double>::min());
      const bool is_done = there.logarithm - here.logarithm < least_gain;
      basis = std::move(next);
      here = std::move(there);
      if (here.smallest > best_ratio) {
        best_ratio = here.smallest;
        best = basis;
      }
      if (is_done)
        break;
    }
  }
  return best;
}

} // namespace pcl_uvol
