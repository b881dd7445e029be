// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/reinitialization.h"

#include "common/parallel.h"
#include "isosurface/isopoints.h"
#include "levelset/constants.h"
#include "levelset/evolution_kernel.h"
#include "levelset/parallel_kernels.h"
#include "neighbors/nearest_finder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t distance_block = 1024;

} // namespace

std::vector<float>
distanceToZeroLevel(const Band& band,
                    const SampleSet& samples,
                    const std::vector<float>& phi,
                    double spacing,
                    unsigned threads,
                    Report& report)
{
  const StepTimer timer(report, "reinitialization");
  std::vector<std::uint32_t> sources(phi.size());
  std::iota(sources.begin(), sources.end(), 0u);
  const NodeRanges ranges = samples.getTree().computeRanges(phi, threads);
  pcl::PointCloud<PointIso> isopoints;
  IsoEdges edges;
  SurfaceTally tally;
  Report ignored;
  const TouchingCells candidates(samples);
  appendIsopoints({samples,
                   phi,
                   ranges,
                   candidates,
                   AngleCriterion::Kept,
                   Outside::Higher,
                   Interpolation::Fit,
                   threads},
                  sources,
                  0.0f,
                  isopoints,
                  edges,
                  tally,
                  ignored);
  std::vector<float> distance(band.places(), 0.0f);
  band.forPlaces(
      [&](std::size_t place, std::uint32_t sample) { distance[place] = phi[sample]; });
  if (isopoints.empty())
    return distance;

  // Isopoints lie in the original space, their normals as well.
  const Position& scale = samples.getScale();
  std::vector<Position> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> all(isopoints.size());
  std::iota(all.begin(), all.end(), 0u);
  for (const PointIso& point : isopoints) {
    positions.push_back({{point.x * scale[0], point.y * scale[1], point.z * scale[2]}});
    normals.push_back(
        (point.getNormalVector3fMap().array() /
         (Eigen::Array3f(scale[0], scale[1], scale[2]) / samples.getUnit().factor))
            .matrix()
            .normalized());
  }
  const auto surface = SampleSet::buildInUnit(
      positions.front().x, 3, all, LengthUnit{}, threads, ignored);
  const bool is_even = scale[0] == scale[1] && scale[1] == scale[2];
  // How much the surface bends away from its tangent plane, both ways alike.
  const auto bending = [&](const PointIso& point) {
    const double most = 0.5 / spacing;
    const double curvature = point.mean_curvature / scale[0];
    return is_even && std::isfinite(curvature) ? std::clamp(curvature, -most, most)
                                               : 0.0;
  };
  const auto planar = static_cast<float>(level_set.planar_distance * spacing);
  const auto measure = [&](NearestFinder& finder, std::size_t place, auto sample) {
    const Position& x = samples.getPositions()[sample];
    const auto row = finder.find(x, static_cast<float>(spacing));
    const float length = std::sqrt(row.sq_dists[0]);
    const std::uint32_t isopoint = surface->getInputIndex(row.samples[0]);
    const Eigen::Vector3f& normal = normals[isopoint];
    const Position& foot = surface->getPositions()[row.samples[0]];
    float along = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
      along += (x[axis] - foot[axis]) * normal[axis];
    if (length < planar) {
      const double curvature = bending(isopoints[isopoint]),
                   sq_across = std::max(
                       0.0, static_cast<double>(row.sq_dists[0]) - along * along);
      distance[place] = static_cast<float>(
          along + 0.5 * curvature * sq_across / std::max(0.5, 1.0 + curvature * along));
    }
    else
      distance[place] = std::copysign(length, phi[sample]);
  };
  parallelBlocks(
      band.centers.size(), distance_block, threads, [&](auto begin, auto end) {
        NearestFinder finder(*surface, 1);
        for (std::size_t i = begin; i < end; ++i)
          measure(finder, i, band.centers[i]);
      });
  parallelBlocks(
      band.others.size(), distance_block, threads, [&](auto begin, auto end) {
        NearestFinder finder(*surface, 1);
        for (std::size_t i = begin; i < end; ++i)
          measure(finder, band.centerPlaces() + i, band.others[i]);
      });
  return distance;
}

std::vector<float>
relaxToDistance(const Band& band,
                const std::vector<float>& phi,
                double spacing,
                unsigned threads)
{
  const auto& stiffness = band.stencils.getStiffness();
  const double stiffest = *std::max_element(stiffness.begin(), stiffness.end());
  // The trace of the Hessian has at most twice the weight of curvature.
  const double dt =
      level_set.relaxation_safety /
      (1.0 + 2.0 * level_set.viscosity * spacing * spacing * stiffest); // in spacings
  const auto h = static_cast<float>(spacing);
  std::vector<float> now = phi, next = phi, slope(band.centerPlaces()),
                     sign(band.centerPlaces());
  for (std::size_t i = 0; i < sign.size(); ++i)
    sign[i] = phi[i] / std::sqrt(phi[i] * phi[i] + h * h);
  const auto steps = static_cast<int>(std::ceil(level_set.relaxation_time / dt));
  for (int i = 0; i < steps; ++i) {
    band.extrapolate(now);
    const DistanceStep step{
        band.stencils.view(),
        now.data(),
        sign.data(),
        static_cast<float>(dt * spacing),
        static_cast<float>(dt * level_set.viscosity * spacing * spacing),
        next.data(),
        slope.data()};
    parallelBlocks(
        band.stencils.groups(), block_groups, threads, [&](auto begin, auto end) {
          evolution_kernel_table.get()->relaxToDistance(step, begin, end);
        });
    now.swap(next);
  }
  return now;
}

} // namespace pcl_uvol
