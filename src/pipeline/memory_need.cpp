// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/memory_need.h"

#include "levelset/memory_need.h"
#include "levelset/phi_cloud.h"
#include "neighbors/exact_neighbors.h"
#include "pipeline/gap_filling.h"
#include "pipeline/periodic_surface.h"
#include "surface/memory_need.h"
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** A mesh has twice as many vertices as there are isopoints before it is remeshed, each
 * with two triangles, their neighbours and the cells beside it. */
constexpr double mesh_bytes_per_isopoint = 1500.0;

/** A node of the lattice that gaps are filled on: in tables, as a sample of the
 * surface, and in a tree. */
constexpr double bytes_per_gap_node = 300.0;

/** A sample while gaps are filled: in the trees of two kriged fields. */
constexpr double gap_bytes_per_sample = 150.0;

/** One surface after the other from a level set of its own; isopoints remain. */
void
addLevelSets(const LevelSetParameters& parameters,
             const std::vector<SurfaceSize>& surfaces,
             double points,
             MemoryForecast& forecast)
{
  forecast.hold(sizeof(int) * points); // indices of all
  for (const SurfaceSize& surface : surfaces) {
    forecast.run(levelSetNeed(points, surface, parameters));
    forecast.hold(phi_point_bytes * points);
    forecast.run(isosurfaceNeed(points, {surface}));
    forecast.release((phi_point_bytes + sizeof(float)) * points);
  }
}

/** Points with images over points: an even cube gets layers of images on both sides. */
double
imagesFactor(const IsosurfacePipelineParameters& parameters, double points)
{
  const double layers = 2.0 * reachFor(parameters).spacings;
  double factor = 1.0;
  for (const double side : parameters.periodic)
    if (side > 0.0)
      factor *= std::min(3.0, 1.0 + layers / std::cbrt(std::max(points, 1.0)));
  return factor;
}

} // namespace

void
addMemoryNeed(const IsosurfacePipelineParameters& parameters,
              double points,
              double point_step,
              std::vector<SurfaceSize> surfaces,
              double gap_nodes,
              MemoryForecast& forecast)
{
  surfaces.resize(parameters.isosurface.isovalues.size());
  std::transform(surfaces.begin(), surfaces.end(), surfaces.begin(), allowForDetail);
  if ((parameters.periodic > 0.0).any()) {
    points *= imagesFactor(parameters, points);
    forecast.hold(point_step * points); // the samples with images
  }
  if ((parameters.rotation != 0.0).any()) // the samples as they are seen
    forecast.hold(point_step * points);
  if (parameters.isosurface.neighbors == NeighborSource::Exact)
    forecast.hold(ExactNeighbors::bytesPerSample() * points);
  if (parameters.fill_gaps) // a copy of the samples with more behind them
    forecast.hold(detail::variogramBytes(points) +
                  (point_step + gap_bytes_per_sample) * points +
                  (point_step + bytes_per_gap_node) * gap_nodes);
  if (parameters.smooth)
    addLevelSets(parameters.level_set, surfaces, points, forecast);
  else
    forecast.run(isosurfaceNeed(points, surfaces));
  double isopoints = 0.0, largest = 0.0;
  for (const SurfaceSize& surface : surfaces) {
    isopoints += surface.isopoints;
    largest = std::max(largest, surface.isopoints);
  }
  if (parameters.mesh)
    forecast.run({mesh_bytes_per_isopoint * largest, 0.0});
  else // the extraction stays with the pipeline
    forecast.hold(extractionBytes(points) + sizeof(IsoEdge) * isopoints);
  if (parameters.validation.folds > 0) // beside what the whole surface keeps
    forecast.run(isosurfaceNeed(points, surfaces));
  // Normals of one surface after the other, beside a copy of all where some are
  // missing.
  const auto normals =
      surfaceNormalsNeed(largest, static_cast<double>(parameters.normal_neighbors));
  forecast.run({normals.peak + sizeof(PointIso) * isopoints, 0.0});
  // As bytes, and with the other fields.
  forecast.hold((2.0 * sizeof(PointIso) + point_step) * isopoints);
}

double
estimatePeak(const std::shared_ptr<const Dataset>& samples,
             const IsosurfacePipelineParameters& parameters,
             unsigned threads)
{
  const auto& cloud = samples->cloud;
  MemoryForecast forecast(0.0);
  addMemoryNeed(parameters,
                static_cast<double>(cloud.width) * static_cast<double>(cloud.height),
                static_cast<double>(cloud.point_step),
                estimateSurfaces(viewOf(cloud), parameters.isosurface, threads),
                parameters.fill_gaps
                    ? detail::estimateGapNodes(samples, parameters, threads)
                    : 0.0,
                forecast);
  return forecast.getPeak();
}

} // namespace pcl_uvol
