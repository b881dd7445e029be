// SPDX-License-Identifier: BSD-3-Clause
// The ascent of ClusterSeparation to a basis whose smallest Fisher ratio is larger.
#include "multivariate/cluster_separation.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/** Sharpness of the soft minimum, one after the other: at the last one 100 equal ratios
 * count as one that is 4 % smaller. */
constexpr double sharpnesses[] = {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0};
/** The ascent at one sharpness ends when a step gains less than this, relatively. */
constexpr double least_gain = 1e-7;
/** Lengths of moves of the basis, whose columns are of length 1. */
constexpr double first_move = 0.1, shortest_move = 1e-9, longest_move = 0.7;
/** A step that does not keep this part of what the gradient promises (Armijo 1966) is
 * made shorter by this factor. */
constexpr double sufficient_increase = 1e-4, shortening = 0.25;

/** Ratios that are added: the logarithm of 0 would be infinite. */
constexpr double ratio_floor = 1e-15;

/** The orthonormal basis closest to one that nearly is. */
MatrixXd
retracted(const MatrixXd& basis)
{
  const Matrix3d gram = basis.transpose().lazyProduct(basis);
  return basis.lazyProduct(
      Eigen::SelfAdjointEigenSolver<Matrix3d>(gram).operatorInverseSqrt());
}

} // namespace

/** The power mean of exponent -sharpness of the ratios, times a constant. */
struct ClusterSeparation::SoftMinimum {
  double logarithm;
  MatrixXd gradient; ///< of the logarithm by the basis; perpendicular to the basis
  double smallest;   ///< ratio
};

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
  double best_ratio = findSmallestSeparable(start);
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
        is_gain = there.logarithm >=
                  here.logarithm + sufficient_increase * length * slope * slope;
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
