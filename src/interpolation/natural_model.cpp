// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/natural_model.h"

#include "interpolation/query_search.h"
#include "interpolation/support_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

/** Share of the distance of the nearest sample: for derivatives by differences. */
constexpr double difference_step = 1e-4;

} // namespace

NaturalNeighborFinder::NaturalNeighborFinder(const SampleSet& samples,
                                             NaturalCoordinates coordinates)
    : search_(samples)
    , coordinates_(coordinates)
{
}

bool
NaturalNeighborFinder::find(const Query& place,
                            const std::uint32_t* near,
                            std::size_t count)
{
  search_.start(place, CellSearch::no_sample, near, count);
  bool is_bounded = true;
  if (!cells_.find(search_) || !takeCell(true)) {
    is_bounded = cells_.findAny(search_);
    takeCell(false);
  }
  if (coordinates_ == NaturalCoordinates::Laplace)
    for (Neighbor& neighbor : neighbors_)
      neighbor.gradient.fill(std::numeric_limits<double>::quiet_NaN());
  std::sort(neighbors_.begin(), neighbors_.end(), [](const auto& a, const auto& b) {
    return a.sample < b.sample;
  });
  return is_bounded;
}

bool
NaturalNeighborFinder::takeCell(bool needs_check)
{
  const SimpleCell& cell = cells_.getCell();
  const std::size_t count = cell.getNumFaces();
  ratios_.resize(count);
  moments_.resize(count);
  volumes_.resize(count);
  if (!cell.measureFaces(ratios_.data(), moments_.data()) && needs_check)
    return false;
  const bool is_sibson = coordinates_ == NaturalCoordinates::Sibson;
  if (is_sibson && !needs_check)
    parts_.measure(cell, volumes_.data());
  else if (is_sibson && !cavity_.measure(cell, ratios_.data(), volumes_.data()))
    return false;
  neighbors_.clear();
  for (std::size_t face = 0; face < count; ++face) {
    if (cell.getFace(face).sample == CellSearch::no_sample)
      continue;
    neighbors_.push_back({cell.getFace(face).sample,
                          std::max(0.0, is_sibson ? volumes_[face] : ratios_[face]),
                          {}});
    // The face moves with the place, farther from its foot more so.
    std::copy_n(moments_[face].data(), 3, neighbors_.back().gradient.begin());
  }
  double sum = 0.0;
  for (const Neighbor& neighbor : neighbors_)
    sum += neighbor.weight;
  if (!(sum > 0.0 && std::isfinite(sum)))
    neighbors_.clear();
  return true;
}

NaturalModel::NaturalModel(const SampledFields& sampled, NaturalCoordinates coordinates)
    : sampled_(sampled)
    , coordinates_(coordinates)
    , sparse_(sparseSamples(*sampled.samples))
{
}

namespace {

/** Answers to the queries of a block. */
class BlockInterpolator {
public:
  BlockInterpolator(const SampledFields& sampled, NaturalCoordinates coordinates)
      : sampled_(sampled)
      , finder_(*sampled.samples, coordinates)
      , sum_(sampled.fields)
  {
  }

  /** \return false outside of the convex hull */
  bool
  answer(const Query& query,
         const NearestFinder::Row& near,
         std::size_t i,
         const Estimates& estimates)
  {
    const std::vector<Position>& positions = sampled_.samples->getPositions();
    for (std::size_t j = 0; j < near.size; ++j)
      if (sqDistance(query, positions[near.samples[j]]) == 0.0) {
        takeSample(near.samples[j], i, estimates);
        return true;
      }
    const bool is_inside = finder_.find(query, near.samples, near.size);
    // So near to a sample, beside the extent of all, that rounding leaves no cell.
    if (finder_.getNeighbors().empty()) {
      takeSample(findNearest(query, near), i, estimates);
      return is_inside;
    }
    sum_.start(sampled_.valuesOf(finder_.getNeighbors().front().sample));
    for (const auto& neighbor : finder_.getNeighbors())
      sum_.add(sampled_.valuesOf(neighbor.sample), neighbor.weight, neighbor.gradient);
    sum_.finish(i, estimates);
    return is_inside;
  }

  /** Replace the gradient by differences of values. */
  void
  differentiate(const Query& query,
                const NearestFinder::Row& near,
                std::size_t i,
                const Estimates& estimates)
  {
    const double sq_nearest =
        sqDistance(query, sampled_.samples->getPositions()[findNearest(query, near)]);
    if (!(sq_nearest > 0.0))
      return;
    const double step = difference_step * std::sqrt(sq_nearest);
    std::vector<double> values(2 * sampled_.fields);
    std::vector<FieldSupport> support(2);
    for (int axis = 0; axis < 3; ++axis) {
      Query ahead = query, behind = query;
      ahead.x[axis] += step;
      behind.x[axis] -= step;
      const Estimates sides{values.data(), nullptr, nullptr, support.data()};
      answer(behind, near, 0, sides);
      answer(ahead, near, 1, sides);
      for (std::size_t f = 0; f < sampled_.fields; ++f)
        estimates
            .gradients[3 * (i * sampled_.fields + f) + static_cast<std::size_t>(axis)] =
            (values[sampled_.fields + f] - values[f]) /
            (ahead.x[axis] - behind.x[axis]);
    }
  }

private:
  std::uint32_t
  findNearest(const Query& query, const NearestFinder::Row& near) const
  {
    const std::vector<Position>& positions = sampled_.samples->getPositions();
    return *std::min_element(
        near.samples, near.samples + near.size, [&](std::uint32_t a, std::uint32_t b) {
          return sqDistance(query, positions[a]) < sqDistance(query, positions[b]);
        });
  }

  /** At a sample, where the gradient jumps. */
  void
  takeSample(std::uint32_t sample, std::size_t i, const Estimates& estimates) const
  {
    std::copy_n(sampled_.valuesOf(sample),
                sampled_.fields,
                estimates.values + i * sampled_.fields);
    if (estimates.errors)
      std::fill_n(estimates.errors + i * sampled_.fields, sampled_.fields, 0.0);
  }

  const SampledFields& sampled_;
  NaturalNeighborFinder finder_;
  WeightedSum sum_;
};

} // namespace

void
NaturalModel::evaluate(const Query* queries,
                       std::size_t count,
                       const Estimates& estimates) const
{
  BlockInterpolator interpolator(sampled_, coordinates_);
  SupportFinder support(*sampled_.samples, sparse_);
  QuerySearch search(*sampled_.samples, CellSearch::usual_near, queries, count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto near = search.find(i);
    estimates.support[i] = support.judge(queries[i], near);
    if (estimates.support[i] == FieldSupport::Outside && !estimates.extrapolate)
      continue;
    if (!interpolator.answer(queries[i], near, i, estimates))
      estimates.support[i] = FieldSupport::Outside;
    if (estimates.gradients && coordinates_ == NaturalCoordinates::Laplace)
      interpolator.differentiate(queries[i], near, i, estimates);
  }
}

} // namespace pcl_uvol::detail
