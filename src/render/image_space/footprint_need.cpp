// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/footprint_need.h"

#include <algorithm>

namespace pcl_uvol {

namespace {

/** Blocks whose points lie closer, in pixels, need no footprints: the masks close what
 * is left open. Random points then have 4 in a pixel. */
constexpr float dense_spacing = 0.5f;

} // namespace

bool
needsFootprints(const SurfaceCloud& cloud, const View& view)
{
  const auto& blocks = cloud.getBlocks();
  return std::any_of(blocks.begin(), blocks.end(), [&](const SurfaceBlock& block) {
    float z = view.translation[2];
    for (int axis = 0; axis < 3; ++axis)
      z += view.rotation[6 + axis] * block.center[axis];
    const float nearest = std::max(z - block.radius, view.near);
    return z + block.radius > view.near &&
           block.mean_spacing * view.focal > dense_spacing * nearest;
  });
}

} // namespace pcl_uvol
