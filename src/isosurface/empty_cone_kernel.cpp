// SPDX-License-Identifier: BSD-3-Clause
#include "empty_cone_kernel.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

using Lanes = float __attribute__((vector_size(cone_lanes * sizeof(float))));

} // namespace

float
emptiestCone(const UnitVectors& directions, const UnitVectors& neighbors)
{
  float emptiest = 1.0f;
  for (std::size_t i = 0; i < directions.count; i += cone_lanes) {
    const Lanes x = *reinterpret_cast<const Lanes*>(directions.x + i);
    const Lanes y = *reinterpret_cast<const Lanes*>(directions.y + i);
    const Lanes z = *reinterpret_cast<const Lanes*>(directions.z + i);
    Lanes nearest = Lanes{} - 1.0f;
    for (std::size_t j = 0; j < neighbors.count; ++j) {
      const Lanes cosine = x * neighbors.x[j] + y * neighbors.y[j] + z * neighbors.z[j];
      nearest = cosine > nearest ? cosine : nearest;
    }
    for (std::size_t lane = 0; lane < cone_lanes; ++lane)
      emptiest = nearest[lane] < emptiest ? nearest[lane] : emptiest;
  }
  return emptiest;
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
