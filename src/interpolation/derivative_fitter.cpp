// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/derivative_fitter.h"

#include "interpolation/fit_bounds.h"
#include "interpolation/sample_metrics.h"
#include "interpolation/slope_fit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

namespace {

/** Samples with a weight in a fit: twice the 20 terms of a cubic, as for isopoints. */
constexpr std::size_t fitted_samples = 40;

/** The same of a fit in a metric: a quadratic, and the samples of a cube of 3 x 3 x 3
 * but for the one in its middle. Cells of stretched grids are as wide as their finest
 * features: with 40 samples and cubics, Q of the momentum of a combustor has the
 * correlation 0.85 with the derivatives of its cells, with 26 samples 0.91, with 20
 * samples 0.92 and gaps (tests/benchmarks). */
constexpr std::size_t samples_in_metric = 26;

/** Room for the sample itself, the farthest one, and an even number. */
constexpr std::size_t most_fitted = fitted_samples + 2;

/** Least pivots of fits that need no other metric, and of fits that are worth
 * something, and how much stretching matters then: as for isopoints, see
 * smooth_roots.cpp. */
constexpr double good_pivot = 0.02, singular_pivot = 1e-3, little_stretching = 1.1;

/** The standard error of a value over the largest difference of the values around: with
 * more, a cubic through 40 samples does not follow them. The smaller bound is for terms
 * that the samples hardly determine: with 0.005 as the only bound, the gradient of the
 * density of a combustor has the correlation 0.94 with the derivatives of its cells,
 * instead of 0.97. */
constexpr double large_error = 0.01, small_error = 0.001;

/** The same of values that are a cubic: only rounding is left. */
constexpr double rounding_error = 1e-9;

/** The standard error of a gradient over the largest difference of the values by the
 * radius of the support: with more the values do not determine it. */
constexpr double largest_error = 1.0;

/** Derivatives of a polynomial at its centre, see PolynomialFit for the order of terms.
 */
PointDerivatives
derive(const PolynomialFit& fit, std::size_t lane, double radius)
{
  std::array<double, 10> c{};
  for (std::size_t i = 0; i < c.size(); ++i)
    c[i] = fit.coefficient[i][lane];
  PointDerivatives derivatives;
  derivatives.gradient = Eigen::Vector3d(c[1], c[2], c[3]) / radius;
  derivatives.hessian << 2.0 * c[4], c[5], c[6], //
      c[5], 2.0 * c[7], c[8],                    //
      c[6], c[8], 2.0 * c[9];
  derivatives.hessian /= radius * radius;
  return derivatives;
}

PointDerivatives
unknownDerivatives()
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {Eigen::Vector3d::Constant(none), Eigen::Matrix3d::Constant(none)};
}

/** Orthogonal axes along which samples extend, the widest first. */
Eigen::Matrix3d
findAxes(const Eigen::MatrixX3d& offsets, const Eigen::VectorXd& root_weights)
{
  const Eigen::MatrixX3d weighted = root_weights.asDiagonal() * offsets;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(weighted.transpose() *
                                                             weighted);
  return eigen.eigenvectors().rowwise().reverse();
}

} // namespace

DerivativeFitter::DerivativeFitter(const SampledFields& sampled)
    : sampled_(sampled)
    , finder_(*sampled.samples, fitted_samples + 1)
    , finder_in_metric_(*sampled.samples, samples_in_metric + 1, true)
    , metrics_(*sampled.samples)
    , group_metrics_(*sampled.samples)
    , kernel_(polynomial_kernel_table.get())
    , samples_(most_fitted)
    , values_(sampled.fields * most_fitted)
    , results_(sampled.fields)
{
}

BlockDerivatives
DerivativeFitter::fit(std::uint32_t begin, std::uint32_t count)
{
  BlockDerivatives found;
  found.derivatives.assign(count * sampled_.fields, unknownDerivatives());
  uncertain_fits_.clear();
  finder_.expect(&sampled_.samples->getPositions()[begin], count);
  for (std::size_t first = 0; first < count; first += polynomial_lanes)
    fitLanes(begin, first, std::min(polynomial_lanes, count - first), found);
  for (const UncertainFit& doubt : uncertain_fits_)
    fitAnew(doubt, &found.derivatives[(doubt.sample - begin) * sampled_.fields], found);
  return found;
}

void
DerivativeFitter::fitLanes(std::uint32_t begin,
                           std::size_t first,
                           std::size_t lanes,
                           BlockDerivatives& found)
{
  const std::size_t fields = sampled_.fields;
  const auto sampleOf = [&](std::size_t lane) {
    return begin + static_cast<std::uint32_t>(first + lane);
  };
  for (std::size_t lane = 0; lane < polynomial_lanes; ++lane) {
    clear(lane, 0);
    if (lane < lanes)
      gather(sampleOf(lane), lane);
  }
  kernel_(samples_.data(),
          samples_.size(),
          weighted_,
          values_.front().value,
          fields,
          results_.data());
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double pivot = results_.front().pivot[lane];
    const bool is_close = followsValues(lane, small_error);
    const bool is_sane = is_close || followsValues(lane, large_error);
    const bool is_exact = followsValues(lane, rounding_error);
    const bool is_bounded =
        is_sane || followsValues(lane, std::numeric_limits<double>::infinity());
    const bool is_determined = pivot >= good_pivot;
    const bool is_trusted =
        is_determined ? is_sane : is_close && pivot >= singular_pivot;
    if (!is_exact && !is_trusted)
      uncertain_fits_.push_back(
          {sampleOf(lane), pivot, is_close || (is_bounded && is_determined)});
    if (is_bounded)
      for (std::size_t f = 0; f < fields; ++f)
        found.derivatives[(first + lane) * fields + f] =
            derive(results_[f], lane, radius_[lane]);
  }
}

void
DerivativeFitter::clear(std::size_t lane, std::size_t from)
{
  constexpr double outside = 2.0; // no weight there
  for (std::size_t j = from; j < most_fitted; ++j) {
    samples_[j].x[lane] = outside;
    samples_[j].y[lane] = samples_[j].z[lane] = 0.0;
    for (std::size_t f = 0; f < sampled_.fields; ++f)
      values_[f * most_fitted + j].value[lane] = 0.0;
  }
  weighted_[lane] = 0;
}

void
DerivativeFitter::gather(std::uint32_t sample, std::size_t lane)
{
  const std::vector<Position>& positions = sampled_.samples->getPositions();
  const auto near = finder_.find(positions[sample], length_);
  double sq_farthest = 0.0;
  for (std::size_t j = 0; j < near.size; ++j)
    sq_farthest = std::max(
        sq_farthest,
        offsetIn(nullptr, positions[sample], positions[near.samples[j]]).squaredNorm());
  const bool are_all = near.size <= fitted_samples;
  const double radius = sq_farthest > 0.0
                            ? (are_all ? radius_of_few : 1.0) * std::sqrt(sq_farthest)
                            : 1.0;
  length_ = static_cast<float>(radius);
  radius_[lane] = radius;
  for (std::size_t j = 0; j < near.size; ++j) {
    const Eigen::Vector3d u =
        offsetIn(nullptr, positions[sample], positions[near.samples[j]]) / radius;
    samples_[j].x[lane] = u[0];
    samples_[j].y[lane] = u[1];
    samples_[j].z[lane] = u[2];
    weighted_[lane] += u.squaredNorm() < 1.0;
    for (std::size_t f = 0; f < sampled_.fields; ++f)
      values_[f * most_fitted + j].value[lane] =
          sampled_.valuesOf(near.samples[j])[f] - sampled_.valuesOf(sample)[f];
  }
}

bool
DerivativeFitter::followsValues(std::size_t lane, double most_error) const
{
  if (results_.front().degree[lane] == 0)
    return false;
  for (std::size_t f = 0; f < sampled_.fields; ++f) {
    double spread = 0.0, first = 0.0, second = 0.0;
    for (std::size_t j = 0; j < most_fitted; ++j)
      spread = std::max(spread, std::abs(values_[f * most_fitted + j].value[lane]));
    for (std::size_t i = 1; i <= 3; ++i)
      first = std::max(first, std::abs(results_[f].coefficient[i][lane]));
    for (std::size_t i = 4; i <= 9; ++i)
      second = std::max(second, std::abs(results_[f].coefficient[i][lane]));
    if (first > steepest * spread || second > most_curved * spread ||
        results_[f].error[lane] > most_error * spread)
      return false;
  }
  return true;
}

DerivativeFitter::Spacings
DerivativeFitter::findSpacings(const UncertainFit& doubt)
{
  const double least_ratio =
      doubt.pivot < singular_pivot ? little_stretching : LocalMetricFinder::even_ratio;
  const bool has_group =
      group_metrics_.find(group_metrics_.findAnchor(doubt.sample), least_ratio);
  if (group_metrics_.hasFailed())
    return Spacings::Sheet;
  const bool is_found = has_group
                            ? metrics_.refine(doubt.sample, group_metrics_, least_ratio)
                            : metrics_.find(doubt.sample, least_ratio);
  if (is_found)
    return Spacings::Stretched;
  if (metrics_.isEven(least_ratio))
    return Spacings::Even;
  return metrics_.hasFailed() ? Spacings::Sheet : Spacings::Unclear;
}

void
DerivativeFitter::fitAnew(const UncertainFit& doubt,
                          PointDerivatives* derivatives,
                          BlockDerivatives& found)
{
  const Spacings spacings = findSpacings(doubt);
  if (spacings == Spacings::Even && doubt.is_kept_if_even)
    return;
  const std::vector<Position>& positions = sampled_.samples->getPositions();
  const Position& center = positions[doubt.sample];
  const Eigen::Matrix3d metric = spacings == Spacings::Stretched
                                     ? metrics_.getMetric()
                                     : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  const std::vector<std::uint32_t>& near = finder_in_metric_.find(center, metric);
  const auto rows = static_cast<Eigen::Index>(near.size());
  Eigen::MatrixX3d offsets(rows, 3);
  for (Eigen::Index j = 0; j < rows; ++j)
    offsets.row(j) =
        (metric *
         offsetIn(nullptr, center, positions[near[static_cast<std::size_t>(j)]]))
            .transpose();
  const double radius = (near.size() <= samples_in_metric ? radius_of_few : 1.0) *
                        offsets.rowwise().norm().maxCoeff();
  offsets /= radius;
  const Eigen::VectorXd root_weights =
      (1.0 - offsets.rowwise().squaredNorm().array()).max(0.0).matrix();
  const Eigen::Matrix3d axes = findAxes(offsets, root_weights);
  std::vector<bool> is_done(sampled_.fields, false);
  const Eigen::Index least_dimensions = spacings == Spacings::Sheet ? 1 : 3;
  Eigen::Index dimensions = 4;
  const auto areDone = [&] {
    return std::all_of(is_done.begin(), is_done.end(), [](bool is) { return is; });
  };
  std::fill_n(derivatives, sampled_.fields, unknownDerivatives());
  while (dimensions > least_dimensions && !areDone()) {
    --dimensions;
    const Eigen::Matrix<double, 3, Eigen::Dynamic> along = axes.leftCols(dimensions);
    const SlopeFit fit(offsets * along, root_weights);
    for (std::size_t f = 0; f < sampled_.fields; ++f) {
      if (is_done[f])
        continue;
      Eigen::VectorXd values(rows);
      for (Eigen::Index j = 0; j < rows; ++j)
        values[j] = sampled_.valuesOf(near[static_cast<std::size_t>(j)])[f] -
                    sampled_.valuesOf(doubt.sample)[f];
      const double spread = values.cwiseAbs().maxCoeff();
      const Slopes slopes = fit.solve(values);
      if (slopes.error > largest_error * spread ||
          !(slopes.gradient.cwiseAbs().maxCoeff() <= steepest * spread))
        continue;
      const Eigen::Matrix<double, 3, Eigen::Dynamic> to_space =
          metric.transpose() * along / radius;
      derivatives[f].gradient = to_space * slopes.gradient;
      derivatives[f].hessian = to_space * slopes.hessian * to_space.transpose();
      is_done[f] = true;
    }
  }
  found.reduced += areDone() && dimensions < 3;
  found.unknown += !areDone();
}

} // namespace pcl_uvol::detail
