// SPDX-License-Identifier: BSD-3-Clause
// Unit vectors in four bytes.
#pragma once

#include <pcl_uvol/common/export.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pcl_uvol {

/** \brief A unit vector in two signed 16-bit numbers: the octahedral map (Meyer et al.
 * 2010), at most 0.004 degrees off. */
using PackedNormal = std::uint32_t;

/** \brief Largest number in 16 bits with sign. */
constexpr float packed_normal_scale = 32767.0f;

/** \brief
 * \param normal of any length but zero */
PCL_UVOL_EXPORTS PackedNormal
packNormal(const float* normal);

inline void
unpackNormal(PackedNormal packed, float* normal)
{
  const auto unpack = [](std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int16_t>(bits)) / packed_normal_scale;
  };
  float u = unpack(packed & 0xffff), v = unpack(packed >> 16);
  const float z = 1.0f - std::abs(u) - std::abs(v);
  const float fold = std::max(-z, 0.0f);
  u -= std::copysign(fold, u);
  v -= std::copysign(fold, v);
  const float scale = 1.0f / std::sqrt(u * u + v * v + z * z);
  normal[0] = u * scale;
  normal[1] = v * scale;
  normal[2] = z * scale;
}

} // namespace pcl_uvol
