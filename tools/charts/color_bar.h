// SPDX-License-Identifier: BSD-3-Clause
// The legend of a picture that is coloured by a scalar field.
#pragma once

#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/image.h>

#include <string>

namespace uvol_tools {

/** \brief Draw a bar of colours with its values and a title at the right border of an
 * image; nothing in images too small for it (below 128 pixels). */
void
drawColorBar(pcl_uvol::Image& image,
             const pcl_uvol::ColorMap& map,
             double low,
             double high,
             const std::string& title);

} // namespace uvol_tools
