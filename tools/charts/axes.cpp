// SPDX-License-Identifier: BSD-3-Clause
#include "charts/axes.h"

#include "common/number_range.h"

#include <cmath>

namespace uvol_tools {

namespace {

double
thickness(int font)
{
  return font / 14.0;
}

} // namespace

void
drawAxisBelow(pcl_uvol::Image& image,
              const PlotArea& area,
              int distance,
              const AxisScale& scale,
              const std::string& label,
              int font)
{
  const int row = area.bottom + distance;
  const auto values = roundValues(scale.low, scale.high);
  const auto texts = pcl_uvol::describeNumbers(values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double column =
        area.left + scale.placeOf(values[i]) * (area.right - area.left);
    drawLine(image, column, row, column, row + font / 2, thickness(font), black);
    writeText(image,
              texts[i],
              font,
              rounded(column),
              row + font * 5 / 4,
              TextAnchor::Center,
              black);
  }
  drawLine(image,
           area.left - distance,
           row,
           area.right + distance,
           row,
           thickness(font),
           black);
  writeText(image,
            label,
            font,
            (area.left + area.right) / 2,
            row + font * 11 / 4,
            TextAnchor::Center,
            black);
}

void
drawAxisLeft(pcl_uvol::Image& image,
             const PlotArea& area,
             int distance,
             const AxisScale& scale,
             const std::string& label,
             int font)
{
  const int column = area.left - distance;
  const auto values = roundValues(scale.low, scale.high);
  const auto texts = pcl_uvol::describeNumbers(values);
  int widest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double row =
        area.bottom - scale.placeOf(values[i]) * (area.bottom - area.top);
    drawLine(image, column, row, column - font / 2, row, thickness(font), black);
    widest = std::max(widest,
                      writeText(image,
                                texts[i],
                                font,
                                column - font * 3 / 4,
                                rounded(row),
                                TextAnchor::Right,
                                black));
  }
  drawLine(image,
           column,
           area.top - distance,
           column,
           area.bottom + distance,
           thickness(font),
           black);
  writeUpwards(image,
               label,
               font,
               column - font * 7 / 4 - widest,
               (area.top + area.bottom) / 2,
               black);
}

} // namespace uvol_tools
