// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/bucket_fitter.h"

#include "interpolation/blend_kernel.h"
#include "interpolation/fit_bounds.h"
#include "interpolation/reduced_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

namespace {

/** Room for the sample itself, the farthest one, and an even number. */
constexpr std::size_t most_neighbors = BucketFitter::fitted_samples + 2;

/** Share of the largest pivot: residuals are amplified by the reciprocal of a smaller
 * one. */
constexpr double clear_pivot = 0.02;

} // namespace

BucketFitter::BucketFitter(const SampledFields& sampled, const SampleMetrics& metrics)
    : sampled_(sampled)
    , metrics_(metrics)
    , finder_(*sampled.samples, fitted_samples + 1)
    , stretched_finder_(*sampled.samples, fitted_samples + 1, true)
    , kernel_(polynomial_kernel_table.get())
    , samples_(most_neighbors)
    , values_(sampled.fields * most_neighbors)
    , results_(sampled.fields)
{
}

BucketFits
BucketFitter::fit(std::uint32_t begin, std::uint32_t count)
{
  const std::size_t fields = sampled_.fields;
  BucketFits fits;
  fits.radius.resize(count);
  const Position* const centers = &sampled_.samples->getPositions()[begin];
  for (int axis = 0; axis < 3; ++axis) {
    fits.center[axis].resize(count + ball_padding);
    for (std::uint32_t i = 0; i < count; ++i)
      fits.center[axis][i] = centers[i][axis];
  }
  fits.sq_reach.resize(count + ball_padding);
  fits.metric.resize(count);
  fits.is_inner.resize(count);
  fits.is_reduced.resize(count);
  fits.coefficients.resize(count * fields * polynomial_terms);
  fits.errors.resize(count * fields);
  finder_.expect(centers, count);
  for (std::size_t first = 0; first < count; first += polynomial_lanes)
    fitLanes(begin, first, std::min(polynomial_lanes, count - first), fits);
  fits.largest_sq_reach = *std::max_element(fits.sq_reach.begin(), fits.sq_reach.end());
  return fits;
}

void
BucketFitter::fitLanes(std::uint32_t begin,
                       std::size_t first,
                       std::size_t lanes,
                       BucketFits& fits)
{
  for (std::size_t lane = 0; lane < polynomial_lanes; ++lane) {
    clear(lane, 0);
    if (lane < lanes)
      gather(
          begin + static_cast<std::uint32_t>(first + lane), lane, first + lane, fits);
  }
  const std::size_t fields = sampled_.fields;
  kernel_(samples_.data(),
          samples_.size(),
          weighted_,
          values_.front().value,
          fields,
          results_.data());
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t place = first + lane;
    const std::uint32_t sample = begin + static_cast<std::uint32_t>(place);
    const bool is_determined = results_.front().degree[lane] > 0;
    if (!is_determined || hasRunAway(lane)) {
      fits.is_reduced[place] = true;
      fitReduced(sample, lane, place, is_determined, fits);
      continue;
    }
    for (std::size_t f = 0; f < fields; ++f) {
      double* const coefficients =
          &fits.coefficients[(place * fields + f) * polynomial_terms];
      for (std::size_t i = 0; i < polynomial_terms; ++i)
        coefficients[i] = results_[f].coefficient[i][lane];
      coefficients[0] += sampled_.valuesOf(sample)[f];
      fits.errors[place * fields + f] = results_[f].error[lane];
    }
  }
}

void
BucketFitter::clear(std::size_t lane, std::size_t from)
{
  constexpr double outside = 2.0; // no weight there
  for (std::size_t j = from; j < most_neighbors; ++j) {
    samples_[j].x[lane] = outside;
    samples_[j].y[lane] = samples_[j].z[lane] = 0.0;
    for (std::size_t f = 0; f < sampled_.fields; ++f)
      values_[f * most_neighbors + j].value[lane] = 0.0;
  }
  weighted_[lane] = 0;
}

void
BucketFitter::gather(std::uint32_t sample,
                     std::size_t lane,
                     std::size_t place,
                     BucketFits& fits)
{
  fits.metric[place] = metrics_.find(sample);
  findNeighbors(sample, fits.metric[place]);
  const double farthest =
      std::sqrt(*std::max_element(sq_dists_.begin(), sq_dists_.end()));
  const bool are_all = near_.size() <= fitted_samples;
  const double radius =
      farthest > 0.0 ? (are_all ? radius_of_few : 1.0) * farthest : 1.0;
  for (std::size_t j = 0; j < near_.size(); ++j) {
    samples_[j].x[lane] = offsets_[j][0] / radius;
    samples_[j].y[lane] = offsets_[j][1] / radius;
    samples_[j].z[lane] = offsets_[j][2] / radius;
    for (std::size_t f = 0; f < sampled_.fields; ++f)
      values_[f * most_neighbors + j].value[lane] =
          sampled_.valuesOf(near_[j])[f] - sampled_.valuesOf(sample)[f];
  }
  weighted_[lane] = static_cast<int>(
      std::count_if(sq_dists_.begin(), sq_dists_.end(), [&](double sq_dist) {
        return sq_dist < radius * radius;
      }));
  fits.radius[place] = radius;
  fits.is_inner[place] = isInner(lane, near_.size());
  // The sample itself is the nearest.
  if (near_.size() > blended_samples) {
    std::nth_element(
        sq_dists_.begin(), sq_dists_.begin() + blended_samples, sq_dists_.end());
    fits.sq_reach[place] = sq_dists_[blended_samples];
  }
  else
    fits.sq_reach[place] = radius * radius;
}

void
BucketFitter::findNeighbors(std::uint32_t sample, const StretchedMetric* metric)
{
  const std::vector<Position>& positions = sampled_.samples->getPositions();
  const Position& center = positions[sample];
  if (!metric) {
    const auto near = finder_.find(center, length_);
    near_.assign(near.samples, near.samples + near.size);
  }
  else {
    // The neighbours of the sample before are as many, within a distance that is known.
    double sq_limit = std::numeric_limits<double>::infinity();
    if (near_.size() > fitted_samples) {
      sq_limit = 0.0;
      for (const std::uint32_t near : near_)
        sq_limit =
            std::max(sq_limit, offsetIn(metric, center, positions[near]).squaredNorm());
    }
    near_ = stretched_finder_.find(center, metric->matrix, sq_limit);
  }
  offsets_.clear();
  sq_dists_.clear();
  for (const std::uint32_t near : near_) {
    offsets_.push_back(offsetIn(metric, center, positions[near]));
    const Eigen::Vector3d& offset = offsets_.back();
    sq_dists_.push_back(offset[0] * offset[0] + offset[1] * offset[1] +
                        offset[2] * offset[2]);
  }
  if (!metric)
    length_ = static_cast<float>(
        std::sqrt(*std::max_element(sq_dists_.begin(), sq_dists_.end())));
  if (!(length_ > 0.0f))
    length_ = 1.0f;
}

bool
BucketFitter::isInner(std::size_t lane, std::size_t neighbors)
{
  for (std::size_t j = 0; j < 64; ++j) {
    const bool is_there = j < neighbors;
    directions_[0][j] = is_there ? static_cast<float>(samples_[j].x[lane]) : 0.0f;
    directions_[1][j] = is_there ? static_cast<float>(samples_[j].y[lane]) : 0.0f;
    directions_[2][j] = is_there ? static_cast<float>(samples_[j].z[lane]) : 0.0f;
  }
  const std::size_t count = (neighbors + cone_lanes - 1) / cone_lanes * cone_lanes;
  return !cone_.isEmpty(directions_[0], directions_[1], directions_[2], count);
}

bool
BucketFitter::hasRunAway(std::size_t lane) const
{
  for (std::size_t f = 0; f < sampled_.fields; ++f) {
    double spread = 0.0, first = 0.0, second = 0.0;
    for (std::size_t j = 0; j < most_neighbors; ++j)
      spread = std::max(spread, std::abs(values_[f * most_neighbors + j].value[lane]));
    for (std::size_t i = 1; i <= 3; ++i)
      first = std::max(first, std::abs(results_[f].coefficient[i][lane]));
    for (std::size_t i = 4; i <= 9; ++i)
      second = std::max(second, std::abs(results_[f].coefficient[i][lane]));
    if (first > steepest * spread || second > most_curved * spread)
      return true;
  }
  return false;
}

void
BucketFitter::fitReduced(std::uint32_t sample,
                         std::size_t lane,
                         std::size_t place,
                         bool is_determined,
                         BucketFits& fits) const
{
  constexpr auto most = static_cast<Eigen::Index>(most_neighbors);
  const auto fields = static_cast<Eigen::Index>(sampled_.fields);
  Eigen::MatrixX3d offsets(most, 3);
  Eigen::MatrixXd values(most, fields);
  Eigen::Index count = 0;
  for (std::size_t j = 0; j < most_neighbors; ++j) {
    const Eigen::RowVector3d offset(
        samples_[j].x[lane], samples_[j].y[lane], samples_[j].z[lane]);
    if (offset.squaredNorm() >= 1.0)
      continue;
    offsets.row(count) = offset;
    for (Eigen::Index f = 0; f < fields; ++f)
      values(count, f) =
          values_[static_cast<std::size_t>(f) * most_neighbors + j].value[lane];
    ++count;
  }
  offsets.conservativeResize(count, 3);
  values.conservativeResize(count, fields);
  const ReducedFit fit(
      offsets, is_determined ? clear_pivot : ReducedFit::rounding, is_determined);
  for (Eigen::Index f = 0; f < fields; ++f) {
    const std::size_t target = place * sampled_.fields + static_cast<std::size_t>(f);
    fits.errors[target] =
        fit.solve(values.col(f), &fits.coefficients[target * polynomial_terms]);
    fits.coefficients[target * polynomial_terms] +=
        sampled_.valuesOf(sample)[static_cast<std::size_t>(f)];
  }
}

} // namespace pcl_uvol::detail
