// SPDX-License-Identifier: BSD-3-Clause
#include "charts/color_bar.h"

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

int
drawBar(Image& image,
        const ColorMap& map,
        const PlotArea& area,
        const std::vector<BarLabel>& labels,
        TextAnchor anchor,
        int font,
        const Ink& ink)
{
  const int length = area.bottom - area.top + 1;
  for (int row = 0; row < length; ++row) {
    const Ink color = inkOf(map.at((length - 0.5 - row) / length));
    for (int column = area.left; column <= area.right; ++column)
      blend(image, column, area.top + row, color, 1.0);
  }
  int widest = 0;
  for (const BarLabel& label : labels)
    widest = std::max(widest,
                      writeText(image,
                                label.text,
                                font,
                                anchor == TextAnchor::Right ? area.left - font / 2
                                                            : area.right + 1 + font / 2,
                                area.top + static_cast<int>(std::lround(
                                               (1.0 - label.place) * length)),
                                anchor,
                                ink));
  return widest;
}

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
  const AxisScale scale{low, high};
  std::vector<BarLabel> labels;
  for (const double value : roundValues(low, high))
    labels.push_back({scale.placeOf(value), shortNumber(value)});
  drawBar(image,
          map,
          {left, right - 1, top, top + length - 1},
          labels,
          TextAnchor::Right,
          size,
          ink);
  writeText(image, title, size, right, top - size * 3 / 2, TextAnchor::Right, ink);
}

} // namespace uvol_tools
