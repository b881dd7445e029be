// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/support_finder.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

/** As many as fits of isopoints look at. */
constexpr std::size_t nearest_samples = 41;

/** Share of the distance of the farthest of them: a nearest sample that far away lies
 * on the border of a gap. */
constexpr float empty_ball = 0.5f;

/** Enough for cones of 57 degrees, which are a quarter of all directions each. */
constexpr std::size_t most_sparse_samples = 512;

} // namespace

std::vector<Position>
sparseSamples(const SampleSet& samples)
{
  const std::size_t step =
      (samples.size() + most_sparse_samples - 1) / most_sparse_samples;
  std::vector<Position> sparse;
  for (std::size_t i = 0; i < samples.size(); i += step)
    sparse.push_back(samples.getPositions()[i]);
  return sparse;
}

SupportFinder::SupportFinder(const SampleSet& samples,
                             const std::vector<Position>& sparse)
    : samples_(samples)
    , sparse_(sparse)
    , finder_(samples, nearest_samples)
{
  const std::size_t most = std::max(nearest_samples, sparse.size());
  for (auto& coordinate : directions_)
    coordinate.resize((most + 2 * cone_lanes) / cone_lanes * cone_lanes);
}

void
SupportFinder::expect(const Query* queries, std::size_t count)
{
  expected_.assign(queries, count);
}

FieldSupport
SupportFinder::findExpected(std::size_t query)
{
  const Position& center = expected_.announce(query, finder_);
  return judgeNearest(center, finder_.find(center, reach_));
}

FieldSupport
SupportFinder::find(const Query& query)
{
  const Position center = query.toPosition();
  return judgeNearest(center, finder_.find(center, reach_));
}

FieldSupport
SupportFinder::judge(const Query& query, const NearestFinder::Row& near)
{
  if (near.size <= nearest_samples)
    return judgeNearest(query.toPosition(), near);
  by_distance_.resize(near.size);
  for (std::size_t j = 0; j < near.size; ++j)
    by_distance_[j] = {near.sq_dists[j], near.samples[j]};
  std::nth_element(
      by_distance_.begin(), by_distance_.begin() + nearest_samples, by_distance_.end());
  sq_dists_.resize(nearest_samples);
  nearest_.resize(nearest_samples);
  for (std::size_t j = 0; j < nearest_samples; ++j) {
    sq_dists_[j] = by_distance_[j].first;
    nearest_[j] = by_distance_[j].second;
  }
  return judgeNearest(query.toPosition(),
                      {nearest_.data(), sq_dists_.data(), nearest_samples});
}

FieldSupport
SupportFinder::judgeNearest(const Position& center, const NearestFinder::Row& near)
{
  float sq_nearest = near.sq_dists[0], sq_farthest = near.sq_dists[0];
  for (std::size_t j = 1; j < near.size; ++j) {
    sq_nearest = std::min(sq_nearest, near.sq_dists[j]);
    sq_farthest = std::max(sq_farthest, near.sq_dists[j]);
  }
  if (sq_farthest > 0.0f)
    reach_ = std::sqrt(sq_farthest);
  const bool is_far = sq_nearest > empty_ball * empty_ball * sq_farthest;
  if (!leavesConeEmpty(center, samples_.getPositions(), near.samples, near.size))
    return is_far ? FieldSupport::Bridged : FieldSupport::Measured;
  if (!is_far)
    return FieldSupport::Rim;
  return leavesConeEmpty(center, sparse_, nullptr, sparse_.size())
             ? FieldSupport::Outside
             : FieldSupport::Bridged;
}

bool
SupportFinder::leavesConeEmpty(const Position& center,
                               const std::vector<Position>& places,
                               const std::uint32_t* indices,
                               std::size_t count)
{
  // The kernel wants aligned arrays.
  float* aligned[3];
  const std::size_t room = (count + cone_lanes - 1) / cone_lanes * cone_lanes;
  for (int axis = 0; axis < 3; ++axis) {
    void* start = directions_[axis].data();
    std::size_t space = directions_[axis].size() * sizeof(float);
    aligned[axis] = static_cast<float*>(
        std::align(cone_lanes * sizeof(float), room * sizeof(float), start, space));
    for (std::size_t j = 0; j < count; ++j)
      aligned[axis][j] = places[indices ? indices[j] : j][axis] - center[axis];
    std::fill(aligned[axis] + count, aligned[axis] + room, 0.0f);
  }
  return cone_.isEmpty(aligned[0], aligned[1], aligned[2], room);
}

} // namespace pcl_uvol::detail
