// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/projection_kernel.h"

#include "render/image_space/camera_lanes.h"
#include "render/image_space/disc_sight.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

/** Up to a register of numbers of 32 bits; zero where there are no more. */
template <typename Register, typename Element>
Register
loadSome(const Element* values, std::uint32_t count)
{
  if (count >= static_cast<std::uint32_t>(lanes))
    return load<Register>(values);
  alignas(64) Element some[lanes] = {};
  for (std::uint32_t lane = 0; lane < count; ++lane)
    some[lane] = values[lane];
  return load<Register>(some);
}

/** Keep what is in front of each pixel of the band. */
void
drawPixels(const PixelBand& band,
           const Ints& seen,
           const Ints& rows,
           const Ints& columns,
           const Floats& depths,
           std::uint32_t begin)
{
  alignas(64) float depth[lanes];
  alignas(64) std::int32_t column[lanes], row[lanes];
  store(depth, depths);
  store(column, columns);
  store(row, rows);
  for (std::uint32_t bits = laneBits(seen); bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    PixelKey& pixel = band.keys[row[lane] * band.stride + column[lane]];
    const PixelKey key = keyOf(depth[lane], begin + static_cast<std::uint32_t>(lane));
    pixel = key < pixel ? key : pixel;
  }
}

/** False for discs that lie beside the band, about projected centres. Those that nearly
 * touch the eye may reach any pixel. */
Ints
mayReach(const Projection& projection,
         const PixelBand& band,
         const Vector& center,
         const Floats& radius,
         const Floats& px,
         const Floats& py)
{
  const Floats nearest = center.z - radius, per_z = 1.0f / center.z;
  const Floats extent = projection.focal * radius / nearest;
  const auto stretched = [&](const Floats& x) {
    const Floats slope = x * per_z;
    return extent * (1.0f + 0.5f * slope * slope); // at least the length of the ray
  };
  const Floats ex = stretched(center.x), ey = stretched(center.y);
  return (nearest < projection.near) |
         ((px + ex >= 0.0f) & (px - ex <= static_cast<float>(band.width)) &
          (py + ey >= static_cast<float>(band.first_row)) &
          (py - ey <= static_cast<float>(band.last_row)));
}

/** Bits of those discs that may be seen before what is seen so far, and be blended with
 * it. */
std::uint32_t
leaveSeen(const DiscReach& reach,
          const SightTest& sight,
          std::uint32_t bits,
          const PixelBand& band,
          const float* deepest)
{
  std::uint32_t seen = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    if (sight.maySee(lane, reach.rangeOf(lane, band), band, deepest))
      seen |= 1u << lane;
  }
  return seen;
}

} // namespace

std::size_t
projectPoints(const Projection& projection,
              const ProjectedPoints& points,
              std::uint32_t begin,
              std::uint32_t end,
              const PixelBand& band,
              const float* deepest,
              std::uint32_t* discs)
{
  std::size_t disc_count = 0;
  for (std::uint32_t i = begin; i < end; i += lanes) {
    const std::uint32_t here = end - i;
    const Vector x = {loadSome<Floats>(points.x[0] + i, here),
                      loadSome<Floats>(points.x[1] + i, here),
                      loadSome<Floats>(points.x[2] + i, here)};
    Floats n[3];
    unpackDirection(loadSome<Ints>(points.normals + i, here), n);
    const Floats facing = n[0] * (projection.eye[0] - x.x) +
                          n[1] * (projection.eye[1] - x.y) +
                          n[2] * (projection.eye[2] - x.z);
    const Vector c = toCamera(projection, x);
    Ints seen = (c.z >= projection.near) &
                (laneNumbers() < fill(static_cast<std::int32_t>(here)));
    if (projection.cull_back_faces)
      seen &= facing >= 0.0f;
    const Floats per_z = pixelsPerLength(projection, c);
    const Floats px = projection.center_x + c.x * per_z;
    const Floats py = projection.center_y + c.y * per_z;
    const Floats distance = distanceOf(c);
    Ints has_pixel = seen;
    if (points.radii != nullptr) {
      const Floats radius = discRadius(projection,
                                       loadSome<Floats>(points.radii + i, here),
                                       loadSome<Floats>(points.footprints + i, here),
                                       per_z);
      const Ints is_disc = seen & (radius * per_z > projection.smallest_footprint);
      has_pixel &= ~(is_disc & (radius * per_z > points.smallest_cover));
      std::uint32_t bits = laneBits(is_disc);
      if (bits != 0)
        bits = laneBits(is_disc &
                        mayReach(projection, band, c, radius * points.stretch, px, py));
      if (bits != 0 && deepest != nullptr) {
        const Floats stretched = radius * points.stretch;
        bits = leaveSeen(DiscReach(projection, c, stretched, px, py),
                         SightTest(projection, distance, stretched, facing),
                         bits,
                         band,
                         deepest);
      }
      for (; bits != 0; bits &= bits - 1)
        discs[disc_count++] = i + static_cast<std::uint32_t>(__builtin_ctz(bits));
    }
    const Floats depth = distance * projection.per_far;
    // Conversion goes towards zero: what is left of the first column stays out.
    seen = has_pixel & (px >= 0.0f) & (py >= 0.0f) & (px < pixel_limit) &
           (py < pixel_limit);
    const Ints column = toInts(seen ? px : Floats{});
    const Ints row = toInts(seen ? py : Floats{});
    seen &= (column < fill(band.width)) & (row >= fill(band.first_row)) &
            (row < fill(band.last_row));
    drawPixels(band, seen, row, column, depth, i);
  }
  return disc_count;
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
