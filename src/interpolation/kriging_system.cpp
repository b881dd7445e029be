// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/kriging_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_uvol::detail {

namespace {

/** Share of the sill: added to variances until rounding leaves the matrix positive, as
 * of Gaussian variograms without nugget. */
constexpr double least_ridge = 1e-12, ridge_factor = 10.0, largest_ridge = 1e-2;

/** Places of a block along a side. */
constexpr int places_along = 4;

} // namespace

KrigingTarget::KrigingTarget(const Variogram& variogram)
    : places(Eigen::MatrixX3d::Zero(1, 3))
    , variance(variogram.nugget + variogram.psill)
{
}

KrigingTarget::KrigingTarget(const Variogram& variogram, Eigen::MatrixX3d block)
    : places(std::move(block))
    , variance(0.0)
{
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    for (Eigen::Index j = 0; j < places.rows(); ++j)
      variance += variogram.covariance((places.row(i) - places.row(j)).norm());
  variance /= static_cast<double>(places.rows() * places.rows());
}

Eigen::MatrixX3d
KrigingTarget::divideBlock(const Eigen::Array3f& sides,
                           const Eigen::Matrix3d& to_metric)
{
  Eigen::Array3i counts;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    counts[axis] = sides[axis] > 0.0f ? places_along : 1;
  Eigen::MatrixX3d places(counts.prod(), 3);
  for (int i = 0; i < counts.prod(); ++i) {
    const Eigen::Array3i at(
        i % counts[0], i / counts[0] % counts[1], i / (counts[0] * counts[1]));
    const Eigen::Array3d part = (at.cast<double>() + 0.5) / counts.cast<double>() - 0.5;
    places.row(i) = (to_metric * (part * sides.cast<double>()).matrix()).transpose();
  }
  return places;
}

KrigingSystem::KrigingSystem(const Eigen::MatrixX3d& offsets,
                             const Variogram& variogram,
                             const KrigingTarget& target,
                             int trend)
    : offsets_(offsets)
    , variogram_(variogram)
    , target_(target)
    , trend_(trend)
    , unit_(std::sqrt(offsets.rowwise().squaredNorm().maxCoeff()))
{
  const Eigen::Index count = offsets.rows();
  if (!(unit_ > 0.0))
    unit_ = 1.0;
  while (trend_ > 0 && trendTerms(trend_) > count)
    --trend_;
  const double variance = variogram.nugget + variogram.psill;
  Eigen::MatrixXd matrix(count, count);
  to_target_.setZero(count);
  terms_.resize(count, trendTerms(trend_));
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::RowVector3d at = offsets.row(i);
    for (Eigen::Index j = 0; j < i; ++j)
      matrix(i, j) = variogram.covariance((at - offsets.row(j)).norm());
    matrix(i, i) = variance;
    for (Eigen::Index j = 0; j < target.places.rows(); ++j) {
      const Eigen::RowVector3d offset = at - target.places.row(j);
      to_target_[i] += variogram.covariance(offset.norm());
    }
    terms_.row(i) = trendAt(at.transpose() / unit_, trend_);
  }
  const auto places = static_cast<double>(target.places.rows());
  to_target_ /= places;
  target_terms_.setZero(terms_.cols());
  for (Eigen::Index j = 0; j < target.places.rows(); ++j)
    target_terms_ += trendAt(target.places.row(j).transpose() / unit_, trend_) / places;
  covariance_.compute(matrix);
  for (double ridge = least_ridge;
       covariance_.info() != Eigen::Success && ridge <= largest_ridge;
       ridge *= ridge_factor) {
    Eigen::MatrixXd raised = matrix;
    raised.diagonal().array() += ridge * variance;
    covariance_.compute(raised);
  }
  solved_terms_ = covariance_.solve(terms_);
  const Eigen::MatrixXd equations = terms_.transpose() * solved_terms_;
  trend_equations_.compute(equations);
}

KrigingEstimate
KrigingSystem::estimate(const Eigen::VectorXd& values) const
{
  // Relative to one of them: a constant stays what it is.
  const double reference = values[0];
  const Eigen::VectorXd relative = (values.array() - reference).matrix();
  const Eigen::VectorXd right = solved_terms_.transpose() * relative;
  const Eigen::VectorXd trend = trend_equations_.solve(right);
  const Eigen::VectorXd residuals = relative - terms_ * trend;
  const Eigen::VectorXd dual = covariance_.solve(residuals);
  KrigingEstimate estimate;
  estimate.value = reference + target_terms_.dot(trend) + to_target_.dot(dual);
  estimate.gradient.setZero();
  if (trend_ > 0)
    estimate.gradient = trend.segment<3>(1) / unit_;
  const auto places = static_cast<double>(target_.places.rows());
  for (Eigen::Index i = 0; i < offsets_.rows(); ++i)
    for (Eigen::Index j = 0; j < target_.places.rows(); ++j) {
      const Eigen::Vector3d offset =
          (offsets_.row(i) - target_.places.row(j)).transpose();
      const double distance = offset.norm();
      if (distance > 0.0)
        estimate.gradient -=
            dual[i] * variogram_.covarianceSlope(distance) / places * offset;
    }
  const Eigen::VectorXd solved = covariance_.solve(to_target_);
  Eigen::VectorXd missing = -terms_.transpose() * solved; // of the terms of the target
  missing += target_terms_;
  const double variance = target_.variance - to_target_.dot(solved) +
                          missing.dot(trend_equations_.solve(missing));
  estimate.variance = std::max(0.0, variance);
  return estimate;
}

} // namespace pcl_uvol::detail
