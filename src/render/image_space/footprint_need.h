// SPDX-License-Identifier: BSD-3-Clause
// Whether points are discs in a view: where they lie too far apart for single pixels.
#pragma once

#include "render/image_space/frame.h"
#include "render/surface_cloud.h"

namespace pcl_uvol {

/** \brief True if points of some block in front of the eye lie too far apart on the
 * screen to be single pixels. */
bool
needsFootprints(const SurfaceCloud& cloud, const View& view);

} // namespace pcl_uvol
