// SPDX-License-Identifier: BSD-3-Clause
// The legend of a picture that is coloured by a scalar field.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/image.h>

#include <string>

namespace pcl_uvol {

/** \brief Draw a bar of colours with its values and a title at the right border of an
 * image; nothing in images too small for it (below 128 pixels). */
PCL_UVOL_EXPORTS void
drawColorBar(Image& image,
             const ColorMap& map,
             double low,
             double high,
             const std::string& title);

} // namespace pcl_uvol
