// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: which pixels discs reach, and whether these may see them, before
// one of the discs is taken out of its register.
#pragma once

#include "render/image_space/disc_kernel.h"
#include "render/image_space/disc_lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

/** Pixels, half-open ranges. */
struct PixelRange {
  int first_row, last_row, first_column, last_column;
};

/** How far up to a register of discs reach in the image. */
class DiscReach {
public:
  DiscReach(const Projection& projection, const DiscLanes& discs)
      : touching_(laneBits(discs.center.z - discs.radius < projection.near))
  {
    const Floats per_z = 1.0f / discs.center.z;
    const Floats x = discs.extent(projection, discs.center.x * per_z),
                 y = discs.extent(projection, discs.center.y * per_z);
    store(left_, discs.px - x);
    store(right_, discs.px + x);
    store(top_, discs.py - y);
    store(bottom_, discs.py + y);
  }

  /** The pixels of a band that one of them may cover: any, if it nearly touches the
   * eye. */
  PixelRange
  rangeOf(int lane, const PixelBand& band) const
  {
    PixelRange range{band.first_row, band.last_row, 0, band.width};
    if ((touching_ >> lane & 1) != 0)
      return range;
    shrink(left_[lane], right_[lane], range.first_column, range.last_column);
    shrink(top_[lane], bottom_[lane], range.first_row, range.last_row);
    return range;
  }

private:
  /** To whole pixels. */
  static void
  shrink(float low, float high, int& first, int& last)
  {
    first = low > static_cast<float>(first) ? static_cast<int>(low) : first;
    last = high < static_cast<float>(last) ? static_cast<int>(high) + 1 : last;
  }

  alignas(64) float left_[lanes], right_[lanes], top_[lanes], bottom_[lanes];
  std::uint32_t touching_; ///< lanes
};

/** Tells which of up to a register of discs pixels may see, within their radius: not
 * those that lie farther behind all that is seen in the cells that they reach. */
class SightTest {
public:
  SightTest(const Projection& projection, const DiscLanes& discs)
  {
    const Floats distance = discs.distance(), radius = discs.radius;
    const Floats nearest =
        ((1.0f - depth_error) * distance - 2.0f * radius) * projection.per_far -
        radius * projection.per_far;
    edge_on_ = laneBits(absolute(discs.facing) < least_cosine * distance);
    store(nearest_, nearest);
  }

  bool
  maySee(int lane,
         const PixelRange& range,
         const PixelBand& band,
         const float* deepest) const
  {
    if ((edge_on_ >> lane & 1) != 0)
      return true;
    const float nearest = nearest_[lane];
    const int cells = cellsInRow(band.width);
    for (int row = (range.first_row - band.first_row) / cell_rows;
         row * cell_rows < range.last_row - band.first_row;
         ++row)
      for (int column = range.first_column / cell_columns;
           column * cell_columns < range.last_column;
           ++column)
        if (deepest[row * cells + column] >= nearest)
          return true;
    return false;
  }

private:
  /** Depths of a disc that is seen under a smaller cosine, nearly edge-on, may be off
   * by more than its radius: rounding is multiplied by the square of its inverse.
   * Others, at 1e-7 of the distance for each operation, by far less than the second. @{
   */
  static constexpr float least_cosine = 0.05f, depth_error = 1e-4f;
  /** @} */

  alignas(64) float nearest_[lanes];
  std::uint32_t edge_on_; ///< lanes
};

} // namespace pcl_uvol::PCL_UVOL_SIMD
