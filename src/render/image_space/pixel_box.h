// SPDX-License-Identifier: BSD-3-Clause
// Rectangles of pixels.
#pragma once

#include <algorithm>

namespace pcl_uvol {

/** \brief Columns left to right and rows top to bottom, the last ones not included. */
struct PixelBox {
  int left, top, right, bottom;

  int
  width() const
  {
    return right - left;
  }

  int
  height() const
  {
    return bottom - top;
  }

  bool
  isEmpty() const
  {
    return right <= left || bottom <= top;
  }

  bool
  contains(const PixelBox& other) const
  {
    return other.isEmpty() || (left <= other.left && top <= other.top &&
                               right >= other.right && bottom >= other.bottom);
  }

  PixelBox
  grownBy(int pixels) const
  {
    return {left - pixels, top - pixels, right + pixels, bottom + pixels};
  }

  PixelBox
  clippedTo(const PixelBox& other) const
  {
    return {std::max(left, other.left),
            std::max(top, other.top),
            std::min(right, other.right),
            std::min(bottom, other.bottom)};
  }

  PixelBox
  unitedWith(const PixelBox& other) const
  {
    if (isEmpty())
      return other;
    return {std::min(left, other.left),
            std::min(top, other.top),
            std::max(right, other.right),
            std::max(bottom, other.bottom)};
  }
};

} // namespace pcl_uvol
