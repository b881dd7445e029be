// SPDX-License-Identifier: BSD-3-Clause
#include "surface/packed_normal.h"

#include <cmath>

namespace pcl_uvol {

PackedNormal
packNormal(const float* normal)
{
  const float sum = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  float u = normal[0] / sum, v = normal[1] / sum;
  if (normal[2] < 0.0f) {
    const float folded = std::copysign(1.0f - std::abs(v), u);
    v = std::copysign(1.0f - std::abs(u), v);
    u = folded;
  }
  const auto pack = [](float value) {
    return static_cast<std::uint32_t>(static_cast<std::uint16_t>(
        static_cast<std::int16_t>(std::lround(packed_normal_scale * value))));
  };
  return pack(u) | pack(v) << 16;
}

} // namespace pcl_uvol
