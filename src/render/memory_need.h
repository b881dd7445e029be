// SPDX-License-Identifier: BSD-3-Clause
// Bytes of pictures in image space, at their peak.
#pragma once

#include "surface/memory_need.h"

#include <cstddef>

namespace pcl_uvol {

/** \brief What a picture in image space takes besides the surface. */
struct PictureNeed {
  double points = 0.0;               ///< of the surface, unless it is there already
  double pixels = 0.0;               ///< supersampling included
  std::size_t layers = 0;            ///< that are blended; 0: none are
  bool has_fine_silhouettes = false; ///< drawn from supersampled pixels
};

/** \brief Of ImageSpaceRenderer. Blended discs take memory where they are: measured on
 * 9 million pixels that an object fills. */
inline double
pictureBytes(const PictureNeed& need)
{
  constexpr double pixel_bytes = 50.0;
  constexpr double layer_bytes = 8.0; // colour and depth
  constexpr double depth_bytes = 4.0; // of pixels that silhouettes are drawn from
  return (pixel_bytes + (need.has_fine_silhouettes ? depth_bytes : 0.0) +
          layer_bytes * static_cast<double>(need.layers)) *
             need.pixels +
         footprintsBytes(need.points);
}

} // namespace pcl_uvol
