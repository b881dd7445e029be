// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/query_search.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

/** Queries that share a copy of the samples around them: with more of them it holds too
 * many samples for each, with fewer it is made too often. */
constexpr std::size_t group_queries = 16;

} // namespace

void
QueryGroups::assign(const Query* queries, std::size_t count)
{
  places_.resize(count);
  std::transform(queries, queries + count, places_.begin(), [](const Query& query) {
    return query.toPosition();
  });
  announced_ = 0;
}

const Position&
QueryGroups::announce(std::size_t query, NearestFinder& finder)
{
  if (query >= announced_) {
    announced_ = std::min(places_.size(), query + group_queries);
    finder.expect(&places_[query], announced_ - query);
  }
  return places_[query];
}

QuerySearch::QuerySearch(const SampleSet& samples,
                         std::size_t k,
                         const Query* queries,
                         std::size_t count)
    : finder_(samples, k)
{
  queries_.assign(queries, count);
}

NearestFinder::Row
QuerySearch::find(std::size_t query)
{
  const auto near = finder_.find(queries_.announce(query, finder_), reach_);
  const float sq_reach = *std::max_element(near.sq_dists, near.sq_dists + near.size);
  if (sq_reach > 0.0f)
    reach_ = std::sqrt(sq_reach);
  return near;
}

WeightedSum::WeightedSum(std::size_t fields)
    : fields_(fields)
    , sums_(fields)
    , squares_(fields)
    , gradients_(3 * fields)
{
}

void
WeightedSum::start(const double* reference)
{
  reference_ = reference;
  weight_ = 0.0;
  weight_gradient_ = {};
  std::fill(sums_.begin(), sums_.end(), 0.0);
  std::fill(squares_.begin(), squares_.end(), 0.0);
  std::fill(gradients_.begin(), gradients_.end(), 0.0);
}

void
WeightedSum::add(const double* values,
                 double weight,
                 const std::array<double, 3>& gradient)
{
  weight_ += weight;
  for (std::size_t axis = 0; axis < 3; ++axis)
    weight_gradient_[axis] += gradient[axis];
  for (std::size_t field = 0; field < fields_; ++field) {
    const double value = values[field] - reference_[field];
    sums_[field] += weight * value;
    squares_[field] += weight * value * value;
    for (std::size_t axis = 0; axis < 3; ++axis)
      gradients_[3 * field + axis] += gradient[axis] * value;
  }
}

void
WeightedSum::finish(std::size_t query, const Estimates& estimates) const
{
  for (std::size_t field = 0; field < fields_; ++field) {
    const double mean = sums_[field] / weight_;
    const std::size_t place = query * fields_ + field;
    estimates.values[place] = reference_[field] + mean;
    if (estimates.errors)
      estimates.errors[place] =
          std::sqrt(std::max(0.0, squares_[field] / weight_ - mean * mean));
    if (estimates.gradients)
      for (std::size_t axis = 0; axis < 3; ++axis)
        estimates.gradients[3 * place + axis] =
            (gradients_[3 * field + axis] - mean * weight_gradient_[axis]) / weight_;
  }
}

void
WeightedSum::finishSum(std::size_t query, const Estimates& estimates) const
{
  finish(query, estimates);
  for (std::size_t field = 0; field < fields_; ++field) {
    const std::size_t place = query * fields_ + field;
    estimates.values[place] = reference_[field] + sums_[field];
    if (estimates.gradients)
      std::copy_n(&gradients_[3 * field], 3, estimates.gradients + 3 * place);
  }
}

} // namespace pcl_uvol::detail
