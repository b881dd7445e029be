// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/slope_fit.h"

#include "common/eigen_solvers.h"

#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

namespace {

/** Residuals of fewer degrees of freedom say nothing about the error. */
constexpr double least_slope_freedom = 5.0;

/** Share of the largest pivot. A smaller one is rounding of coordinates in float: it
 * determines nothing. Above the first degree residuals are amplified by its
 * reciprocal. */
constexpr double rounding = 1e-6, clear_slope_pivot = 0.02;

constexpr int most_degrees = 2;

/** The terms up to a degree: by degree, then by falling powers of the first
 * coordinates. */
Eigen::MatrixXd
makeTerms(const Eigen::MatrixXd& offsets, int degrees)
{
  const Eigen::Index count = offsets.rows(), dimensions = offsets.cols();
  std::vector<Eigen::VectorXd> terms{Eigen::VectorXd::Ones(count)};
  // A term of the next degree is one of this degree times a coordinate that is not
  // before its last one.
  std::vector<Eigen::Index> last{0};
  std::size_t first = 0;
  for (int degree = 1; degree <= degrees; ++degree) {
    const std::size_t end = terms.size();
    for (std::size_t i = first; i < end; ++i)
      for (Eigen::Index axis = last[i]; axis < dimensions; ++axis) {
        terms.emplace_back(terms[i].cwiseProduct(offsets.col(axis)));
        last.push_back(axis);
      }
    first = end;
  }
  Eigen::MatrixXd matrix(count, static_cast<Eigen::Index>(terms.size()));
  for (std::size_t i = 0; i < terms.size(); ++i)
    matrix.col(static_cast<Eigen::Index>(i)) = terms[i];
  return matrix;
}

} // namespace

SlopeFit::SlopeFit(const Eigen::MatrixXd& offsets, const Eigen::VectorXd& root_weights)
    : dimensions_(offsets.cols())
    , root_weights_(root_weights)
{
  const Eigen::Index count = offsets.rows();
  for (int degree = 1; degree <= most_degrees; ++degree) {
    const Eigen::MatrixXd terms =
        root_weights_.asDiagonal() * makeTerms(offsets, degree);
    const double freedom = static_cast<double>(count - terms.cols());
    if (freedom < (degree > 1 ? least_slope_freedom : 0.0))
      break;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors;
    factors.setThreshold(degree > 1 ? clear_slope_pivot : rounding);
    factors.compute(terms);
    if (factors.rank() < terms.cols())
      break;
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(count, count);
    Eigen::MatrixXd inverse = factors.solve(identity);
    const double leverage = inverse.middleRows(1, dimensions_).squaredNorm();
    degrees_.push_back({terms, std::move(inverse), leverage, freedom});
  }
}

Slopes
SlopeFit::solve(const Eigen::VectorXd& values) const
{
  Slopes slopes{Eigen::VectorXd::Zero(dimensions_),
                Eigen::MatrixXd::Zero(dimensions_, dimensions_),
                std::numeric_limits<double>::infinity()};
  const Eigen::VectorXd weighted = root_weights_.cwiseProduct(values);
  Eigen::VectorXd best;
  for (const Degree& degree : degrees_) {
    const Eigen::VectorXd solution = degree.inverse * weighted;
    const double squares = (degree.terms * solution - weighted).squaredNorm();
    const double error = degree.freedom > 0.0
                             ? std::sqrt(degree.leverage * squares / degree.freedom)
                             : std::numeric_limits<double>::quiet_NaN();
    if (best.size() == 0 || error < slopes.error) {
      best = solution;
      slopes.error = error;
    }
  }
  if (best.size() == 0)
    return slopes;
  slopes.gradient = best.segment(1, dimensions_);
  Eigen::Index term = 1 + dimensions_;
  if (best.size() > term)
    for (Eigen::Index i = 0; i < dimensions_; ++i)
      for (Eigen::Index j = i; j < dimensions_; ++j, ++term)
        slopes.hessian(i, j) = slopes.hessian(j, i) = (i == j ? 2.0 : 1.0) * best[term];
  return slopes;
}

} // namespace pcl_uvol::detail
