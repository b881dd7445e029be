// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/planar_roots.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Samples that have to lie on a plane: as many as a fit in space looks at. */
constexpr std::size_t seen_samples = 41;

/** Samples with a weight in a fit, twice the 10 terms of a cubic; the next farther one
 * sets the radius of the support. */
constexpr std::size_t planar_samples = 20;

} // namespace

PlanarRoots::PlanarRoots(const IsopointInput& input, float isovalue)
    : input_(input)
    , isovalue_(isovalue)
    , finder_(input.samples, seen_samples)
{
}

bool
PlanarRoots::findPlaneAround(const Surroundings& surroundings, PlaneAxes& axes)
{
  const auto row =
      finder_.find(surroundings.center, static_cast<float>(surroundings.edge_length));
  nearest_.clear();
  for (std::size_t j = 0; j < row.size; ++j)
    nearest_.emplace_back(row.sq_dists[j], row.samples[j]);
  std::sort(nearest_.begin(), nearest_.end());
  const std::vector<Position>& positions = input_.samples.getPositions();
  Eigen::Matrix3Xd offsets(3, static_cast<Eigen::Index>(nearest_.size()));
  for (Eigen::Index j = 0; j < offsets.cols(); ++j)
    for (int axis = 0; axis < 3; ++axis)
      offsets(axis, j) = static_cast<double>(
          positions[nearest_[static_cast<std::size_t>(j)].second][axis] -
          surroundings.center[axis]);
  return findPlane(offsets, axes);
}

void
PlanarRoots::fillLane(const IsoEdge& edge, Surroundings& surroundings)
{
  const std::vector<Position>& positions = input_.samples.getPositions();
  const std::vector<float>& values = input_.values;
  const std::size_t count = std::min(nearest_.size(), planar_samples + 1);
  const float radius = std::sqrt(nearest_[count - 1].first), per_radius = 1.0f / radius;
  float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
  neighbors_.clear();
  samples_.assign(count, FitSample{});
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t neighbor = nearest_[j].second;
    const Position &x = positions[neighbor], &center = surroundings.center;
    FitSample& sample = samples_[j];
    sample.x[0] = (x[0] - center[0]) * per_radius;
    sample.y[0] = (x[1] - center[1]) * per_radius;
    sample.z[0] = (x[2] - center[2]) * per_radius;
    sample.value[0] = values[neighbor] - isovalue_;
    lowest = std::min(lowest, values[neighbor]);
    highest = std::max(highest, values[neighbor]);
    neighbors_.push_back(neighbor);
  }
  surroundings.radius = static_cast<double>(radius);
  surroundings.values = {lowest, highest, {values[edge.first], values[edge.second]}};
  surroundings.has_steps = areLabels(values, neighbors_.data(), count);
}

void
PlanarRoots::smooth(const Position& center,
                    const IsoEdge& edge,
                    const PointIso& given,
                    PointIso& point,
                    RootFit& fit)
{
  const Position &a = input_.samples.getPositions()[edge.first],
                 &b = input_.samples.getPositions()[edge.second];
  Surroundings surroundings;
  surroundings.center = center;
  surroundings.edge_length = std::hypot(static_cast<double>(a[0]) - b[0],
                                        static_cast<double>(a[1]) - b[1],
                                        static_cast<double>(a[2]) - b[2]);
  PlaneAxes axes;
  if (!findPlaneAround(surroundings, axes))
    return;
  fillLane(edge, surroundings);
  surroundings.support =
      supportInPlane(surroundings, samples_.data(), samples_.size(), 0, axes);
  FitResult result;
  fitZeroLevelInPlane(samples_.data(), samples_.size(), 0, axes, result);
  point = given;
  fit.outcome = judge(result, 0, surroundings);
  fit.value = static_cast<float>(result.value[0]);
  if (goesPastSamples(result, 0, fit.outcome, surroundings, samples_))
    surroundings.support = IsoSupport::Bridged;
  const bool is_smooth = fit.outcome <= RootOutcome::Quadratic;
  setIsopoint(input_, result, 0, surroundings, is_smooth, edge, point);
}

} // namespace pcl_uvol
