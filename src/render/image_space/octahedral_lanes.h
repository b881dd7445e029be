// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: packed normals (surface_cloud.h) of a register of points.
#pragma once

#include "common/lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

/** In the direction of the normal; its length is between 0.57 and 1. */
inline void
unpackDirection(const Ints& packed, Floats* direction)
{
  constexpr float scale = 1.0f / 32767.0f;
  Floats u = toFloats((packed << 16) >> 16) * scale;
  Floats v = toFloats(packed >> 16) * scale;
  const Floats z = 1.0f - absolute(u) - absolute(v);
  const Floats fold = maximum(-z, Floats{});
  direction[0] = u - copySign(fold, u);
  direction[1] = v - copySign(fold, v);
  direction[2] = z;
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
