// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/memory_need.h"

#include "interpolation/variogram.h"
#include "isosurface/memory_need.h"
#include "levelset/memory_need.h"
#include "levelset/phi_cloud.h"
#include "mesh/memory_need.h"
#include "neighbors/exact_neighbors.h"
#include "pipeline/gap_filling.h"
#include "pipeline/periodic_surface.h"
#include "surface/memory_need.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_uvol {

namespace {

/** A sample in the tree, with its value. */
constexpr double tree_bytes = 60.0;

/** A sample while gaps are filled: in the trees of two kriged fields. */
constexpr double gap_bytes = 150.0;

/** Samples of an outer layer over the power 2/3 of the samples, which those at the
 * surface of a body grow with: 7 around a cube, 12 around a splash of water, whose
 * surface is larger. The layer itself is known once it is made. */
constexpr double layer_samples = 12.0;

/** Nodes of the lattice in gaps for each sample, about: their number shows when gaps
 * are filled, and is checked then. */
constexpr double nodes_per_sample = 4.0;

/** Bytes of a level set with its tree. */
double
levelSetBytes(double samples, const LevelSetParameters& parameters)
{
  return orderedBytes(samples) + bandBytes(samples, usualCrossing(samples), parameters);
}

/** Points with images over points: an even cube gets layers of images on both sides. */
double
imagesFactor(const std::array<double, 3>& sides, double spacings, double points)
{
  double factor = 1.0;
  for (const double side : sides)
    if (side > 0.0)
      factor *= std::min(3.0, 1.0 + 2.0 * spacings / std::cbrt(std::max(points, 1.0)));
  return factor;
}

} // namespace

double
pipelineBytes(double samples,
              double point_step,
              const IsosurfacePipelineParameters& parameters)
{
  const std::size_t isovalues = parameters.isosurface.isovalues.size();
  double bytes = 0.0;
  if ((parameters.periodic > 0.0).any()) { // a copy with images
    samples *=
        imagesFactor(sidesOf(parameters), reachFor(parameters).spacings, samples);
    bytes += point_step * samples;
  }
  if (parameters.outside_value) { // a copy with the layer
    samples += layer_samples * std::pow(samples, 2.0 / 3.0);
    bytes += point_step * samples;
  }
  if ((parameters.rotation != 0.0).any()) // a turned copy
    bytes += point_step * samples;
  if (parameters.isosurface.neighbors == NeighborSource::Exact)
    bytes += ExactNeighbors::bytesPerSample() * samples;
  if (parameters.fill_gaps)
    bytes +=
        detail::variogramBytes(samples) + (point_step + gap_bytes) * samples +
        detail::gap_node_bytes * std::min(nodes_per_sample * samples,
                                          static_cast<double>(detail::most_gap_nodes));
  double extracting = isosurfaceBytes(samples, isovalues);
  if (parameters.smooth) // one isovalue after the other
    extracting = std::max(levelSetBytes(samples, parameters.level_set),
                          phi_point_bytes * samples + isosurfaceBytes(samples, 1));
  if (parameters.validation.folds > 0) // once more, beside the whole surface
    extracting += isosurfaceBytes(samples, isovalues);
  // The tree stays while isopoints become a surface.
  const double isopoints = usualIsopoints(samples);
  const double of_one =
      parameters.mesh
          ? meshBytes(usualCrossing(samples))
          : surfaceNormalsBytes(isopoints,
                                static_cast<double>(parameters.normal_neighbors));
  const double finishing =
      tree_bytes * samples + of_one +
      surfaceFieldsBytes(static_cast<double>(isovalues) * isopoints, point_step);
  return bytes + std::max(extracting, finishing);
}

double
levelSetJobBytes(double samples, double point_step, const LevelSetRequest& request)
{
  double bytes = 0.0;
  if (isPeriodic(request.periodic)) { // a copy, and one with images
    bytes += point_step * samples;
    samples *= imagesFactor(request.periodic, PeriodicReach::of_level_sets, samples);
    bytes += point_step * samples;
  }
  if ((request.level_set.rotation != 0.0).any()) // a turned copy
    bytes += point_step * samples;
  double evolving = levelSetBytes(samples, request.level_set);
  const double of_phi = phi_point_bytes * samples;
  if (request.snapshots > 0) // extracted beside the level set
    evolving += of_phi + isosurfaceBytes(samples, 1);
  // Indices, edges and the output, phi longer than the input.
  constexpr double index_bytes = sizeof(std::uint32_t), phi_bytes = sizeof(float);
  const double writing =
      of_phi + (4.0 * index_bytes + sizeof(IsoEdge) + point_step + phi_bytes) * samples;
  return bytes + index_bytes * samples + std::max(evolving, writing);
}

} // namespace pcl_uvol
