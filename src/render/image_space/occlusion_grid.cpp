// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/occlusion_grid.h"

#include "common/constants.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pcl_uvol {

namespace {

/** Surfaces in the light of a point are no farther than this part of the cloud's
 * radius: as rays have it. */
constexpr double near_part = 0.2;

/** Nor farther than this part of the picture's shorter side. */
constexpr double picture_part = 0.125;

/** Pixels of a cell's side, a power of two; more where the picture's shorter side has
 * more than so many cells. */
constexpr int smallest_cell = 4, most_cells = 768;

} // namespace

OcclusionGrid::OcclusionGrid(const Frame& frame)
{
  const View& view = frame.view;
  if (!(frame.settings.ambient_occlusion > 0.0) || !frame.settings.shading)
    return;
  for (cell = smallest_cell; cell * most_cells < view.shorter_side;)
    cell *= 2;
  per_cell = 1.0f / static_cast<float>(cell);
  columns = (view.bufferWidth() + cell - 1) / cell;
  rows = (view.bufferHeight() + cell - 1) / cell;
  const double cloud_radius = view.unit * frame.cloud.getBounds().radius;
  const double distance =
      std::max(static_cast<double>(view.translation[2]), cloud_radius);
  const double pixels = std::min(near_part * cloud_radius / distance * view.focal,
                                 picture_part * view.shorter_side);
  if (!(pixels >= cell)) // also where the cloud has no extent
    return;
  radius = static_cast<float>(pixels / view.focal);
  tolerance = 0.5f * radius;
  if (frame.hasFootprints())
    roughness = filler_depth * frame.cloud.getTypicalFootprint();
  for (int direction = 0; direction < directions; ++direction) {
    const double angle = 2.0 * pi * (direction + 0.5) / directions;
    for (int step = 1; step <= steps; ++step) {
      // Closer together where a wall covers more of the sky.
      const double part = static_cast<double>(step * step) / (steps * steps);
      const double cells = std::max(1.0, part * pixels / cell);
      offsets.push_back({static_cast<int>(std::lround(cells * std::cos(angle))),
                         static_cast<int>(std::lround(cells * std::sin(angle)))});
    }
  }
}

int
OcclusionGrid::reach() const
{
  int reach = 0;
  for (const Offset& offset : offsets)
    reach = std::max({reach, std::abs(offset.column), std::abs(offset.row)});
  return reach;
}

} // namespace pcl_uvol
