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
      alignas(64) std::int32_t ids[lanes];
      bool is_empty = true;
      for (int lane = 0; lane < lanes; ++lane) {
        const PixelKey key = keys[column + lane];
        ids[lane] = key == background_key ? 0 : static_cast<std::int32_t>(key);
        is_empty = is_empty && key == background_key;
      }
      if (is_empty)
        continue;
      const Ints id = load<Ints>(ids);
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
      const std::uint32_t away = projection.has_sides
                                     ? laneBits(along * projection.outward > 0.0f)
                                     : 0,
                          edge_on =
                              away & laneBits(along * along < sq_lengths * sq_cosine);
      for (int lane = 0; lane < lanes; ++lane)
        sides[row * band.stride + column + lane] = static_cast<std::uint8_t>(
            sideOf(looks[2 * static_cast<std::uint32_t>(ids[lane]) + 1],
                   (away >> lane & 1u) != 0) |
            ((edge_on >> lane & 1u) != 0 ? edge_on_bit : 0u));
    }
  }
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
