// SPDX-License-Identifier: BSD-3-Clause
#include "charts/color_bar.h"

#include "charts/drawing.h"

#include <algorithm>
#include <cmath>

namespace uvol_tools {

using pcl_uvol::ColorMap;
using pcl_uvol::Image;

namespace {

constexpr std::uint32_t smallest_image = 128;

/** Letters are dark on light ground and light on dark ground. */
constexpr int middle_gray = 128;

/** Black or white: what can be read on the image's upper right corner. */
Ink
inkOn(const Image& image)
{
  const std::uint8_t* const corner = &image.color[4 * (image.width - 1)];
  const int gray = (corner[0] + corner[1] + corner[2]) / 3;
  const std::uint8_t ink = corner[3] < middle_gray || gray >= middle_gray ? 0 : 255;
  return {ink, ink, ink};
}

} // namespace

void
drawColorBar(Image& image,
             const ColorMap& map,
             double low,
             double high,
             const std::string& title)
{
  if (std::min(image.width, image.height) < smallest_image)
    return;
  const int height = static_cast<int>(image.height);
  const int length = height * 6 / 10, top = (height - length) / 2;
  const int size = std::clamp(height / 40, 11, 48);
  const int right = static_cast<int>(image.width) - size, left = right - size;
  const Ink ink = inkOn(image);
  for (int row = 0; row < length; ++row) {
    const pcl_uvol::Rgba packed = toRgba(map.at((length - 0.5 - row) / length));
    const Ink color{static_cast<std::uint8_t>(packed),
                    static_cast<std::uint8_t>(packed >> 8),
                    static_cast<std::uint8_t>(packed >> 16)};
    for (int column = left; column < right; ++column)
      blend(image, column, top + row, color, 1.0);
  }
  for (const double value : roundValues(low, high)) {
    const double place = high > low ? (value - low) / (high - low) : 0.5;
    writeText(image,
              shortNumber(value),
              size,
              left - size / 2,
              top + static_cast<int>(std::lround((1.0 - place) * length)),
              TextAnchor::Right,
              ink);
  }
  writeText(image, title, size, right, top - size * 3 / 2, TextAnchor::Right, ink);
}

} // namespace uvol_tools
