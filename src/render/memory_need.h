// SPDX-License-Identifier: BSD-3-Clause
// Bytes of pictures in image space, at their peak.
#pragma once

#include "surface/memory_need.h"

#include <cstddef>

namespace pcl_uvol {

/** \brief What a picture in image space takes besides the surface. */
struct PictureNeed {
  double points = 0.0;               ///< of the surface
  double pixels = 0.0;               ///< supersampling included
  std::size_t layers = 0;            ///< that are blended; 0: none are
  bool has_fine_silhouettes = false; ///< drawn from supersampled pixels
  bool is_fitted = false; ///< the object as a whole is in the picture, with a margin
};

/** \brief Of ImageSpaceRenderer. Blended discs take memory where they are: measured on
 * 9 million pixels that an object fills, and as the mean of what tori, spheres, an
 * engine and scans take that the camera is fitted to, 24 to 37 bytes. */
inline double
pictureBytes(const PictureNeed& need)
{
  constexpr double full_pixel_bytes = 50.0, fitted_pixel_bytes = 31.0;
  constexpr double layer_bytes = 8.0; // colour and depth
  constexpr double depth_bytes = 4.0; // of pixels that silhouettes are drawn from
  return ((need.is_fitted ? fitted_pixel_bytes : full_pixel_bytes) +
          (need.has_fine_silhouettes ? depth_bytes : 0.0) +
          layer_bytes * static_cast<double>(need.layers)) *
             need.pixels +
         footprintsBytes(need.points);
}

} // namespace pcl_uvol
