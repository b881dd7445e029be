// SPDX-License-Identifier: BSD-3-Clause
// A rendered picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Pixels row by row, the first row on top. Planes that were not asked for are
 * empty. */
struct Image {
  /** In id: no point is seen there. */
  static constexpr std::uint32_t background = 0xffffffff;

  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> color; ///< red, green, blue, opacity (not premultiplied)
  std::vector<float> depth;        ///< distance to the eye / far distance; background 1
  std::vector<float> normal;       ///< x, y, z; background 0
  std::vector<std::uint32_t> id;   ///< index of the point in the input cloud

  /** \return The number of pixels. */
  std::size_t
  pixels() const
  {
    return static_cast<std::size_t>(width) * height;
  }
};

} // namespace pcl_uvol
