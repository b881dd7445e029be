// SPDX-License-Identifier: BSD-3-Clause
// The pixels of a frame: depth and point, with the guard band of View.
#pragma once

#include "render/image_space/disc_kernel.h"
#include "render/image_space/frame.h"
#include "render/image_space/pixel_box.h"

#include <memory>
#include <vector>

namespace pcl_uvol {

/** \brief Keys of all pixels, surrounded by background that nothing writes to, so that
 * kernels may look beyond the buffers. */
struct PixelBuffer {
  /** Background columns on the left, and at least on the right, of a row. */
  static constexpr int margin = 64;

  int width = 0, height = 0;
  std::ptrdiff_t stride = 0;
  std::vector<PixelKey> keys;
  PixelBox bounds{0, 0, 0, 0}; ///< outside of it is background
  /** Sums and marks of BlendSums for all keys; none without discs. Sums are not
   * cleared: the system gives them memory where discs are blended, and nowhere else. @{
   */
  std::unique_ptr<float[]> blended;
  std::size_t blended_keys = 0;
  std::vector<std::uint8_t> blend_marks;
  /** @} */
  std::vector<std::uint8_t> sides; ///< as sideOf() gives; empty if all are one

  /** \brief Make room for a view; rows are not cleared. */
  void
  resize(const View& view);

  /** \brief Sums of row 0, as bands count keys; null without discs. */
  BlendSums
  blendSums()
  {
    const std::ptrdiff_t first = row(0) - keys.data();
    return blended_keys == 0 ? BlendSums{}
                             : BlendSums{blended.get() + blended_values * first,
                                         blend_marks.data() + first / blend_segment,
                                         firstSide()};
  }

  /** \brief That of the first pixel; null if all are one. */
  std::uint8_t*
  firstSide()
  {
    return sides.empty() ? nullptr : sides.data() + (row(0) - keys.data());
  }

  PixelKey*
  row(int index)
  {
    return keys.data() + (index + 1) * stride + margin;
  }
  const PixelKey*
  row(int index) const
  {
    return keys.data() + (index + 1) * stride + margin;
  }
};

} // namespace pcl_uvol
