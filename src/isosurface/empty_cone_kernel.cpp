// SPDX-License-Identifier: BSD-3-Clause
#include "empty_cone_kernel.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

#if defined(__AVX512F__)
constexpr std::size_t register_lanes = 16;
#elif defined(__AVX2__)
constexpr std::size_t register_lanes = 8;
#else
constexpr std::size_t register_lanes = 4;
#endif

using Lanes = float __attribute__((vector_size(register_lanes * sizeof(float))));

constexpr std::size_t group = cone_directions / register_lanes;

inline Lanes
load(const float* values)
{
  return *reinterpret_cast<const Lanes*>(values);
}

} // namespace

float
emptiestCone(const float (*directions)[cone_directions], const UnitVectors& neighbors)
{
  Lanes nearest[group];
  for (Lanes& cosine : nearest)
    cosine = Lanes{} - 1.0f;
  for (std::size_t j = 0; j < neighbors.count; ++j) {
    const float x = neighbors.x[j], y = neighbors.y[j], z = neighbors.z[j];
    for (std::size_t i = 0; i < group; ++i) {
      const Lanes cosine = load(directions[0] + i * register_lanes) * x +
                           load(directions[1] + i * register_lanes) * y +
                           load(directions[2] + i * register_lanes) * z;
      nearest[i] = cosine > nearest[i] ? cosine : nearest[i];
    }
  }
  float emptiest = 1.0f;
  for (const Lanes& cosine : nearest)
    for (std::size_t lane = 0; lane < register_lanes; ++lane)
      emptiest = cosine[lane] < emptiest ? cosine[lane] : emptiest;
  return emptiest;
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
