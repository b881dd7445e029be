// SPDX-License-Identifier: BSD-3-Clause
#include "charts/ground.h"

#include "render/lighting.h"

#include <cstddef>
#include <cstdint>

namespace uvol_tools {

pcl_uvol::Image
makeGround(const pcl_uvol::Background& background, int width, int height)
{
  pcl_uvol::Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.color.resize(4 * image.pixels());
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const float below =
        (static_cast<float>(row) + 0.5f) / static_cast<float>(image.height);
    const pcl_uvol::Rgba color =
        background.kind == pcl_uvol::Background::Kind::Transparent
            ? 0
            : pcl_uvol::toRgba(pcl_uvol::backgroundAt(background, below));
    for (std::uint32_t k = 0; k < 4 * image.width; ++k)
      image.color[4 * std::size_t{image.width} * row + k] =
          static_cast<std::uint8_t>(color >> (8 * (k % 4)));
  }
  return image;
}

} // namespace uvol_tools
