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
  float circle; ///< middles of pixels that are farther from the centre are not meant
};

/** How far up to a register of discs reach in the image to both sides of their centres,
 * and in any direction, in pixels. */
struct Extents {
  Floats x, y, any;
};

/** Shrink a range to the pixels whose middles lie between two places. */
inline void
shrinkToMiddles(float low, float high, int& first, int& last)
{
  const float from = low + 0.5f, to = high + 0.5f;
  first = from > static_cast<float>(first) ? static_cast<int>(from) : first;
  last = to < static_cast<float>(last) ? static_cast<int>(to) : last;
}

/** Room for rounding, in pixels. */
constexpr float pixel_room = 0.02f;

/** Of balls. */
struct BallExtents : Extents {
  BallExtents(const Projection& projection, const Vector& center, const Floats& radius)
  {
    const Floats per_z = 1.0f / center.z;
    const Floats slope_x = center.x * per_z, slope_y = center.y * per_z;
    x = extentOf(projection, center.z, radius, slope_x);
    y = extentOf(projection, center.z, radius, slope_y);
    any = extentOf(projection,
                   center.z,
                   radius,
                   squareRoot(slope_x * slope_x + slope_y * slope_y));
  }
};

/** Of discs, bent ones too: less than those of the balls around them where they are
 * tilted.
 *
 * With v = (z, 0, -x) of the centre c, a point c + d is seen focal v.d / (z (z + d.z))
 * beside the centre. In the plane of the normal n, d is at most the radius r long: v.d
 * is at most r |v| times the sine of the angle between n and v; and a surface of
 * curvature k leaves the plane by at most k r^2 / 2. */
struct DiscExtents : BallExtents {
  DiscExtents(const Projection& projection, const DiscLanes& discs)
      : BallExtents(projection, discs.center, discs.radius)
  {
    const Vector &a = discs.a, &b = discs.b, &c = discs.center;
    const Vector normal = {
        a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    const Floats sag =
        0.5f * discs.radius *
        (maximum(absolute(discs.saa), absolute(discs.sbb)) + absolute(discs.sab));
    const Ints is_edge_on = absolute(dot(normal, c)) < least_cosine * distanceOf(c);
    x = shrink(
        x, c.z * normal.x - c.x * normal.z, c.z * c.z + c.x * c.x, sag, is_edge_on);
    y = shrink(
        y, c.z * normal.y - c.y * normal.z, c.z * c.z + c.y * c.y, sag, is_edge_on);
    any = is_edge_on ? fill(__builtin_inff()) : any + pixel_room;
  }

  /** Discs that are seen under a smaller cosine, nearly edge-on, may be off by much
   * more than their extent: rounding is multiplied by the square of its inverse. */
  static constexpr float least_cosine = 0.05f;

private:
  static Floats
  shrink(const Floats& extent,
         const Floats& along,
         const Floats& sq_length,
         const Floats& sag,
         const Ints& is_edge_on)
  {
    const Floats sq_cosine = along * along / sq_length;
    const Floats part =
        squareRoot(maximum(1.0f - sq_cosine, Floats{})) + sag * squareRoot(sq_cosine);
    return is_edge_on ? extent + 0.5f // of a pixel
                      : extent * minimum(part, fill(1.0f)) + pixel_room;
  }
};

/** Pixels of the image that up to a register of discs reach. */
class DiscReach {
public:
  /** Of balls around centres.
   * \param px and py: where these are in the image */
  DiscReach(const Projection& projection,
            const Vector& center,
            const Floats& radius,
            const Floats& px,
            const Floats& py)
      : DiscReach(
            projection, center, radius, px, py, BallExtents(projection, center, radius))
  {
  }

  DiscReach(const Projection& projection, const DiscLanes& discs)
      : DiscReach(projection,
                  discs.center,
                  discs.radius,
                  discs.px,
                  discs.py,
                  DiscExtents(projection, discs))
  {
  }

  /** The pixels of a band that one of them may cover: any, if it nearly touches the
   * eye. */
  PixelRange
  rangeOf(int lane, const PixelBand& band) const
  {
    PixelRange range{band.first_row, band.last_row, 0, band.width, __builtin_inff()};
    if ((touching_ >> lane & 1) != 0)
      return range;
    shrinkToMiddles(left_[lane], right_[lane], range.first_column, range.last_column);
    shrinkToMiddles(top_[lane], bottom_[lane], range.first_row, range.last_row);
    range.circle = circle_[lane];
    return range;
  }

private:
  DiscReach(const Projection& projection,
            const Vector& center,
            const Floats& radius,
            const Floats& px,
            const Floats& py,
            const Extents& extents)
      : touching_(laneBits(center.z - radius < projection.near))
  {
    store(left_, px - extents.x);
    store(right_, px + extents.x);
    store(top_, py - extents.y);
    store(bottom_, py + extents.y);
    store(circle_, extents.any);
  }

  alignas(64) float left_[lanes], right_[lanes], top_[lanes], bottom_[lanes],
      circle_[lanes];
  std::uint32_t touching_; ///< lanes
};

/** Tells which of up to a register of discs pixels may see, within their radius: not
 * those that lie farther behind all that is seen in the cells that they reach. */
class SightTest {
public:
  /** \param distance of the centres to the eye
   * \param facing see DiscLanes; the sign does not matter */
  SightTest(const Projection& projection,
            const Floats& distance,
            const Floats& radius,
            const Floats& facing)
  {
    const Floats nearest =
        ((1.0f - depth_error) * distance - 2.0f * radius) * projection.per_far -
        radius * projection.per_far;
    edge_on_ = laneBits(absolute(facing) < DiscExtents::least_cosine * distance);
    store(nearest_, nearest);
  }

  SightTest(const Projection& projection, const DiscLanes& discs)
      : SightTest(projection, discs.distance(), discs.radius, discs.facing)
  {
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
  /** What depths of discs that are not nearly edge-on may be off, in parts of the
   * distance: at 1e-7 for each operation it is far less. */
  static constexpr float depth_error = 1e-4f;

  alignas(64) float nearest_[lanes];
  std::uint32_t edge_on_; ///< lanes
};

} // namespace pcl_uvol::PCL_UVOL_SIMD
