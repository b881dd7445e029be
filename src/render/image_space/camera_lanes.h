// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: points in camera space, and their keys in the pixels of a band.
#pragma once

#include "render/image_space/octahedral_lanes.h"
#include "render/image_space/projection_kernel.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

/** Beyond any pixel: what conversions to integers can take. */
constexpr float pixel_limit = 1.0e6f;

struct Vector {
  Floats x, y, z;
};

inline Vector
toCamera(const Projection& p, const Vector& v)
{
  const float* const r = p.rotation;
  return {r[0] * v.x + r[1] * v.y + r[2] * v.z + p.translation[0],
          r[3] * v.x + r[4] * v.y + r[5] * v.z + p.translation[1],
          r[6] * v.x + r[7] * v.y + r[8] * v.z + p.translation[2]};
}

inline Floats
dot(const Vector& a, const Vector& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vector
rotate(const Projection& p, const Vector& v)
{
  const float* const r = p.rotation;
  return {r[0] * v.x + r[1] * v.y + r[2] * v.z,
          r[3] * v.x + r[4] * v.y + r[5] * v.z,
          r[6] * v.x + r[7] * v.y + r[8] * v.z};
}

/** Pixels that a unit of length has at a depth. Divided and multiplied as shaders do,
 * which know reciprocals only: all backends agree to the last bit. */
inline Floats
pixelsPerLength(const Projection& p, const Vector& c)
{
  return p.focal * (1.0f / c.z);
}

/** Radius of a disc, which is its point's footprint if that is too large for a filler.
 */
inline Floats
discRadius(const Projection& p,
           const Floats& radius,
           const Floats& footprint,
           const Floats& pixels_per_length)
{
  return footprint * pixels_per_length > p.largest_filler ? footprint : radius;
}

inline PixelKey
keyOf(float depth, std::uint32_t point)
{
  return static_cast<PixelKey>(
      static_cast<std::uint64_t>(bitCast<std::uint32_t>(depth)) << 32 | point);
}

inline float
depthOf(PixelKey key)
{
  return bitCast<float>(
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(key) >> 32));
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
