// SPDX-License-Identifier: BSD-3-Clause
// Transparent surfaces over each other.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <vector>

namespace pcl_uvol::detail {

/** \brief What a camera sees of one of several surfaces. */
struct SurfaceLayer {
  Image image;           ///< colours on a transparent ground, and depths
  double depth_unit = 1; ///< distance from the eye with depth 1
  double opacity = 1;    ///< of the surface, in [0, 1]
};

/** \brief Lay the surfaces over each other, pixel by pixel from the farthest one to the
 * nearest one; of equal distances the later one is nearer.
 * \param layers at least one; all of the same size
 * \param with_depth give the image depths as well: that of the nearest surface that is
 * not clear, in the unit of the first layer */
PCL_UVOL_EXPORTS void
blendLayers(const std::vector<SurfaceLayer>& layers,
            const Background& background,
            bool with_depth,
            unsigned threads,
            Image& image);

} // namespace pcl_uvol::detail
