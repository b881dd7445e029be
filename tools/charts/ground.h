// SPDX-License-Identifier: BSD-3-Clause
// What pictures show where nothing is drawn.
#pragma once

#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

namespace uvol_tools {

/** \brief A picture of nothing. */
pcl_uvol::Image
makeGround(const pcl_uvol::Background& background, int width, int height);

} // namespace uvol_tools
