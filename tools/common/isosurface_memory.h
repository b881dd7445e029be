// SPDX-License-Identifier: BSD-3-Clause
// The memory of uvol_isosurface, from the samples to the picture.
#pragma once

#include "common/memory_guard.h"
#include <pcl_uvol/isosurface/memory_need.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <optional>
#include <vector>

namespace uvol_tools {

/** \brief What tells how much it is. */
struct IsosurfaceTask {
  std::vector<pcl_uvol::SurfaceSize> surfaces; ///< one per isovalue
  double normal_neighbors = 0.0;
  std::optional<pcl_uvol::LevelSetParameters> level_set; ///< that comes first
  double pixels = 0.0; ///< of a picture in image space, before it is made smaller
  bool is_ray_traced = false;
};

MemoryGuard::Work
memoryOf(const IsosurfaceTask& task);

} // namespace uvol_tools
