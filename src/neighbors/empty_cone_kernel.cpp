// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/empty_cone_kernel.h"

#include "common/register_bytes.h"

#include <cmath>

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

constexpr std::size_t register_lanes = register_bytes / sizeof(float);

using Lanes = float __attribute__((vector_size(register_bytes)));

constexpr std::size_t group = cone_directions / register_lanes;

inline Lanes
load(const float* values)
{
  return *reinterpret_cast<const Lanes*>(values);
}

} // namespace

float
emptiestCone(const float (*directions)[cone_directions],
             float* x,
             float* y,
             float* z,
             std::size_t count)
{
  for (std::size_t j = 0; j < count; ++j) {
    const float scale = 1.0f / std::sqrt(x[j] * x[j] + y[j] * y[j] + z[j] * z[j]);
    x[j] *= scale;
    y[j] *= scale;
    z[j] *= scale;
  }
  Lanes nearest[group];
  for (Lanes& cosine : nearest)
    cosine = Lanes{} - 1.0f;
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < group; ++i) {
      const Lanes cosine = load(directions[0] + i * register_lanes) * x[j] +
                           load(directions[1] + i * register_lanes) * y[j] +
                           load(directions[2] + i * register_lanes) * z[j];
      nearest[i] = cosine > nearest[i] ? cosine : nearest[i];
    }
  float emptiest = 1.0f;
  for (const Lanes& cosine : nearest)
    for (std::size_t lane = 0; lane < register_lanes; ++lane)
      emptiest = cosine[lane] < emptiest ? cosine[lane] : emptiest;
  return emptiest;
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
