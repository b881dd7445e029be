// SPDX-License-Identifier: BSD-3-Clause
#include "drawing.h"
#include <pcl_uvol/io/color_bar.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

constexpr std::uint32_t smallest_image = 128;

/** Letters are dark on light ground and light on dark ground. */
constexpr int middle_gray = 128;

/** Black or white: what can be read on the image's upper right corner. */
io::Ink
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
  const io::Ink ink = inkOn(image);
  for (int row = 0; row < length; ++row) {
    const Rgba packed = toRgba(map.at((length - 0.5 - row) / length));
    const io::Ink color{static_cast<std::uint8_t>(packed),
                        static_cast<std::uint8_t>(packed >> 8),
                        static_cast<std::uint8_t>(packed >> 16)};
    for (int column = left; column < right; ++column)
      io::blend(image, column, top + row, color, 1.0);
  }
  for (const double value : io::roundValues(low, high)) {
    const double place = high > low ? (value - low) / (high - low) : 0.5;
    io::writeText(image,
                  io::shortNumber(value),
                  size,
                  left - size / 2,
                  top + static_cast<int>(std::lround((1.0 - place) * length)),
                  io::TextAnchor::Right,
                  ink);
  }
  io::writeText(
      image, title, size, right, top - size * 3 / 2, io::TextAnchor::Right, ink);
}

} // namespace pcl_uvol
