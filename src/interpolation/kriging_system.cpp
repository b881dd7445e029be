// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/kriging_system.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

/** Share of the sill: added to variances until rounding leaves the matrix positive, as
 * of Gaussian variograms without nugget. */
constexpr double least_ridge = 1e-12, ridge_factor = 10.0, largest_ridge = 1e-2;

} // namespace

KrigingSystem::KrigingSystem(const Eigen::MatrixX3d& offsets,
                             const Variogram& variogram,
                             int trend)
    : offsets_(offsets)
    , variogram_(variogram)
    , trend_(trend)
    , unit_(std::sqrt(offsets.rowwise().squaredNorm().maxCoeff()))
{
  const Eigen::Index count = offsets.rows();
  if (!(unit_ > 0.0))
    unit_ = 1.0;
  while (trend_ > 0 && trendTerms(trend_) > count)
    --trend_;
  const double variance = variogram.nugget + variogram.sill;
  Eigen::MatrixXd matrix(count, count);
  to_origin_.resize(count);
  terms_.resize(count, trendTerms(trend_));
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::RowVector3d at = offsets.row(i);
    for (Eigen::Index j = 0; j < i; ++j)
      matrix(i, j) = variogram.covariance((at - offsets.row(j)).norm());
    matrix(i, i) = variance;
    to_origin_[i] = variogram.covariance(at.norm());
    terms_.row(i) = trendAt(at.transpose() / unit_, trend_);
  }
  covariance_.compute(matrix);
  for (double ridge = least_ridge;
       covariance_.info() != Eigen::Success && ridge <= largest_ridge;
       ridge *= ridge_factor) {
    Eigen::MatrixXd raised = matrix;
    raised.diagonal().array() += ridge * variance;
    covariance_.compute(raised);
  }
  solved_terms_ = covariance_.solve(terms_);
  trend_equations_.compute(terms_.transpose() * solved_terms_);
}

KrigingEstimate
KrigingSystem::estimate(const Eigen::VectorXd& values) const
{
  // Relative to one of them: a constant stays what it is.
  const double reference = values[0];
  const Eigen::VectorXd relative = (values.array() - reference).matrix();
  const Eigen::VectorXd trend =
      trend_equations_.solve(solved_terms_.transpose() * relative);
  const Eigen::VectorXd dual = covariance_.solve(relative - terms_ * trend);
  KrigingEstimate estimate;
  estimate.value = reference + trend[0] + to_origin_.dot(dual);
  estimate.gradient.setZero();
  if (trend_ > 0)
    estimate.gradient = trend.segment<3>(1) / unit_;
  for (Eigen::Index i = 0; i < offsets_.rows(); ++i) {
    const double distance = offsets_.row(i).norm();
    if (distance > 0.0)
      estimate.gradient -=
          dual[i] * variogram_.covarianceSlope(distance) * offsets_.row(i).transpose();
  }
  const Eigen::VectorXd solved = covariance_.solve(to_origin_);
  Eigen::VectorXd missing = -terms_.transpose() * solved; // of the terms at the origin
  missing[0] += 1.0;
  const double variance = variogram_.nugget + variogram_.sill - to_origin_.dot(solved) +
                          missing.dot(trend_equations_.solve(missing));
  estimate.variance = std::max(0.0, variance);
  return estimate;
}

} // namespace pcl_uvol::detail
