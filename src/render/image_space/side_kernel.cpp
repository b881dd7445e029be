// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/side_kernel.h"

#include "render/image_space/octahedral_lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

void
findSides(const Projection& projection,
          const std::uint32_t* looks,
          const PixelBand& band,
          std::uint8_t* sides)
{
  const float* const r = projection.rotation;
  const float per_focal = 1.0f / projection.focal;
  for (int row = band.first_row; row < band.last_row; ++row) {
    const PixelKey* const keys = band.keys + row * band.stride;
    const float qy = (static_cast<float>(row) + 0.5f - projection.center_y) * per_focal;
    for (int column = 0; column < band.width; column += lanes) {
      const Longs left = load<Longs>(keys + column),
                  right = load<Longs>(keys + column + lanes / 2);
      const Ints point = lowerHalves(left, right);
      const Ints is_seen = point != -1; // as that of background
      if (laneBits(is_seen) == 0)
        continue;
      const Ints id = is_seen ? point : Ints{};
      Floats n[3];
      unpackDirection(gatherEven(looks, id), n);
      const Floats qx =
          (toFloats(laneNumbers() + column) + 0.5f - projection.center_x) * per_focal;
      const Floats along = n[0] * (qx * r[0] + (qy * r[3] + r[6])) +
                           n[1] * (qx * r[1] + (qy * r[4] + r[7])) +
                           n[2] * (qx * r[2] + (qy * r[5] + r[8]));
      const Floats sq_lengths =
          (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) * (qx * qx + (qy * qy + 1.0f));
      const float sq_cosine = projection.edge_on_cosine * projection.edge_on_cosine;
      const Ints away =
          projection.has_sides ? Ints(along * projection.outward > 0.0f) : Ints{};
      const Ints edge_on = away & (along * along < sq_lengths * sq_cosine);
      const Ints surface = gatherEven(looks + 1, id) >> 24 << 2;
      storeBytes(sides + row * band.stride + column,
                 surface | (away & looks_away_bit) | (edge_on & edge_on_bit));
    }
  }
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
