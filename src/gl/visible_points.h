// SPDX-License-Identifier: BSD-3-Clause
// Which points of a cloud may be seen: vertices are what software OpenGL is slowest at.
#pragma once

#include "render/image_space/frame.h"
#include "render/image_space/pixel_box.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Consecutive points. */
struct PointRange {
  std::uint32_t begin, end;
};

/** \brief Points of blocks whose discs are treated alike. Ranges ascend. */
struct VisibleRanges {
  std::vector<PointRange> points;
  std::vector<PointRange> large_discs; ///< those that may have a large disc as well
};

/** \brief What is left of a cloud when its blocks out of view, and those that look away
 * from the eye, are gone. */
struct VisiblePoints {
  VisibleRanges dense;      ///< discs only fill holes
  VisibleRanges sparse;     ///< discs are blended
  PixelBox box{0, 0, 0, 0}; ///< pixels of the buffers that all of them can reach
};

/** \param largest_reach discs with a greater radius in the image, in pixels, are large
 */
VisiblePoints
findVisiblePoints(const Frame& frame, float largest_reach);

} // namespace pcl_uvol
