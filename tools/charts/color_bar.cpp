// SPDX-License-Identifier: BSD-3-Clause
#include "charts/color_bar.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace uvol_tools {

using pcl_uvol::ColorMap;
using pcl_uvol::Image;

namespace {

constexpr std::uint32_t smallest_image = 128;

/** Least distance of values along the bar, in letters' sizes. */
constexpr double label_distance = 1.3;

/** Side of letters, and width of the bar. */
int
letterSize(int height)
{
  return std::clamp(height / 40, 11, 48);
}

/** Ends, and round values that do not come too near to them.
 * \param nearest in parts of the range */
std::vector<double>
barValues(double low, double high, double nearest)
{
  if (!(high > low))
    return {low};
  std::vector<double> values = {low};
  for (const double value : roundValues(low, high))
    if (value - low > nearest * (high - low) && high - value > nearest * (high - low))
      values.push_back(value);
  values.push_back(high);
  return values;
}

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
colorBarWidth(int image_width, int image_height)
{
  constexpr int letters = 8; // of the bar, its margin and the values
  if (std::min(image_width, image_height) < static_cast<int>(smallest_image))
    return 0;
  return std::min(letters * letterSize(image_height), image_width / 3);
}

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
  const int size = letterSize(height);
  const int right = static_cast<int>(image.width) - size, left = right - size;
  const Ink ink = inkOn(image);
  const std::vector<double> values =
      barValues(low, high, label_distance * size / length);
  const AxisLabels texts = labelValues(values);
  const AxisScale scale{low, high};
  std::vector<BarLabel> labels;
  for (std::size_t i = 0; i < values.size(); ++i)
    labels.push_back({high > low ? scale.placeOf(values[i]) : 0.5, texts.texts[i]});
  drawBar(image,
          map,
          {left, right - 1, top, top + length - 1},
          labels,
          TextAnchor::Right,
          size,
          ink);
  writeText(image, title, size, right, top - size * 3 / 2, TextAnchor::Right, ink);
  writeText(image,
            texts.offset,
            size,
            right,
            top + length + size * 3 / 2,
            TextAnchor::Right,
            ink);
}

} // namespace uvol_tools
