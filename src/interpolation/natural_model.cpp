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

/** Nearest samples that a cell begins with: those of random samples have 15.5 natural
 * neighbours, and most of these are among them. */
constexpr std::size_t nearest_samples = 40;

/** Share of the distance of the nearest sample: for derivatives by differences. */
constexpr double difference_step = 1e-4;

} // namespace

NaturalNeighborFinder::NaturalNeighborFinder(const SampleSet& samples,
                                             NaturalCoordinates coordinates)
    : cells_(samples)
    , coordinates_(coordinates)
{
}

bool
NaturalNeighborFinder::find(const Query& place,
                            const std::uint32_t* near,
                            std::size_t count)
{
  const bool is_bounded = cells_.find(place, near, count);
  const ConvexCell& cell = cells_.getCell();
  neighbors_.clear();
  offsets_.clear();
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (cell[i].tag == ConvexCell::no_tag)
      continue;
    const std::uint32_t sample =
        cells_.getNeighbors()[static_cast<std::size_t>(cell[i].tag)];
    const Vector3d offset = cells_.offsetOf(sample);
    const PolygonMoments face = computeMoments(cell[i].vertices);
    const double ratio = face.area / offset.norm();
    neighbors_.push_back({sample, ratio, {}});
    // The face moves with the place, farther from its foot more so.
    for (int axis = 0; axis < 3; ++axis)
      neighbors_.back().gradient[static_cast<std::size_t>(axis)] =
          ratio * face.centroid[axis];
    offsets_.push_back(offset);
  }
  if (coordinates_ == NaturalCoordinates::Sibson)
    for (std::size_t i = 0; i < neighbors_.size(); ++i)
      neighbors_[i].weight = stolenVolume(i);
  else
    for (Neighbor& neighbor : neighbors_)
      neighbor.gradient.fill(std::numeric_limits<double>::quiet_NaN());
  std::sort(neighbors_.begin(), neighbors_.end(), [](const auto& a, const auto& b) {
    return a.sample < b.sample;
  });
  return is_bounded;
}

double
NaturalNeighborFinder::stolenVolume(std::size_t face)
{
  const Vector3d& own = offsets_[face];
  part_.start(cells_.getCell());
  // The nearest ones cut most off, so that little is left to cut.
  others_.clear();
  for (std::size_t i = 0; i < offsets_.size(); ++i)
    if (i != face)
      others_.emplace_back((offsets_[i] - own).squaredNorm(), i);
  std::sort(others_.begin(), others_.end());
  for (const auto& other : others_) {
    const Vector3d& offset = offsets_[other.second];
    part_.cut(offset - own,
              0.5 * (offset.squaredNorm() - own.squaredNorm()),
              ConvexCell::no_tag);
  }
  return std::max(0.0, part_.getVolume());
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
      takeSample(nearestOf(query, near), i, estimates);
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
        sqDistance(query, sampled_.samples->getPositions()[nearestOf(query, near)]);
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
  nearestOf(const Query& query, const NearestFinder::Row& near) const
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
  support.expect(queries, count);
  QuerySearch search(*sampled_.samples, nearest_samples, queries, count);
  for (std::size_t i = 0; i < count; ++i) {
    estimates.support[i] = support.find(queries[i]);
    if (estimates.support[i] == FieldSupport::Outside && !estimates.extrapolate)
      continue;
    const auto near = search.find(i);
    if (!interpolator.answer(queries[i], near, i, estimates))
      estimates.support[i] = FieldSupport::Outside;
    if (estimates.gradients && coordinates_ == NaturalCoordinates::Laplace)
      interpolator.differentiate(queries[i], near, i, estimates);
  }
}

} // namespace pcl_uvol::detail
