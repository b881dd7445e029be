// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface_memory.h"

#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/levelset/memory_need.h>
#include <pcl_uvol/surface/memory_need.h>

#include <algorithm>

namespace uvol_tools {

namespace {

/** Of a picture in image space, per pixel: measured on 1 and 16 million of them, planes
 * of depths, points, normals and colours in several passes. */
constexpr double pixel_bytes = 50.0;

/** One surface after the other from a level set of its own; isopoints remain. */
void
addLevelSets(const IsosurfaceTask& task,
             double points,
             pcl_uvol::MemoryForecast& forecast)
{
  forecast.hold(sizeof(int) * points); // indices of all
  for (const auto& surface : task.surfaces) {
    forecast.run(pcl_uvol::levelSetNeed(points, surface, *task.level_set));
    forecast.hold(pcl_uvol::phi_point_bytes * points);
    forecast.run(pcl_uvol::isosurfaceNeed(points, {surface}));
    forecast.release((pcl_uvol::phi_point_bytes + sizeof(float)) * points);
  }
}

} // namespace

MemoryGuard::Work
memoryOf(const IsosurfaceTask& task)
{
  return [task](double points, double step, pcl_uvol::MemoryForecast& forecast) {
    if (task.level_set)
      addLevelSets(task, points, forecast);
    else
      forecast.run(pcl_uvol::isosurfaceNeed(points, task.surfaces));
    double isopoints = 0.0, largest = 0.0;
    for (const auto& surface : task.surfaces) {
      isopoints += surface.isopoints;
      largest = std::max(largest, surface.isopoints);
    }
    // Normals of one surface after the other, beside a copy of all where some are
    // missing.
    const auto normals = pcl_uvol::surfaceNormalsNeed(largest, task.normal_neighbors);
    forecast.run({normals.peak + sizeof(PointIso) * isopoints, 0.0});
    // As bytes, and with the other fields.
    forecast.hold((2.0 * sizeof(PointIso) + step) * isopoints);
    // Of a picture: at worst a splat per point, or footprints and pixels.
    if (task.is_ray_traced)
      forecast.run(pcl_uvol::splatsNeed(isopoints, isopoints, true));
    else if (task.pixels > 0.0)
      forecast.run(
          {pixel_bytes * task.pixels + pcl_uvol::splatsNeed(isopoints, 0.0, true).peak,
           0.0});
  };
}

} // namespace uvol_tools
