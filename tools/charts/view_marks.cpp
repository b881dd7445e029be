// SPDX-License-Identifier: BSD-3-Clause
#include "charts/view_marks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace uvol_tools {

using pcl_uvol::Image;

namespace {

/** A line with an open head at its end. */
void
drawArrow(
    Image& image, const Pixel& from, const Pixel& to, double width, const Ink& ink)
{
  drawLine(image, from[0], from[1], to[0], to[1], width, ink);
  constexpr double head = 0.25, spread = 0.45;
  const double dx = head * (to[0] - from[0]), dy = head * (to[1] - from[1]);
  for (const double side : {-spread, spread})
    drawLine(image,
             to[0],
             to[1],
             to[0] - dx + side * dy,
             to[1] - dy - side * dx,
             width,
             ink);
}

/** The largest of 1, 2 or 5 times a power of ten that is not larger. */
double
roundedDown(double length)
{
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= length)
      return digit * power;
  return power;
}

} // namespace

void
drawTriad(Image& image,
          const Perspective& perspective,
          const Pixel& center,
          double length,
          const MarkStyle& style)
{
  // Red, green and blue, as everywhere, but dark enough for letters.
  constexpr std::array<Ink, 3> inks = {{{204, 51, 51}, {38, 140, 51}, {51, 89, 217}}};
  std::array<int, 3> order = {0, 1, 2};
  const auto seen = [&](int axis) {
    return perspective.turned(Eigen::Vector3d::Unit(axis));
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return seen(a).z() > seen(b).z();
  });
  for (const int axis : order) {
    const Eigen::Vector3d direction = seen(axis);
    const Pixel tip{center[0] + length * direction.x(),
                    center[1] + length * direction.y()};
    const Ink& ink = inks[static_cast<std::size_t>(axis)];
    drawArrow(image, center, tip, style.font / 7.0, ink);
    // The letter stands beyond the tip, also of an axis along the line of sight.
    const double across = std::max(std::hypot(direction.x(), direction.y()), 1e-9);
    const double beyond = 0.8 * style.font / across;
    writeText(image,
              std::string(1, static_cast<char>('x' + axis)),
              style.font,
              rounded(tip[0] + beyond * direction.x()),
              rounded(tip[1] + beyond * direction.y()),
              TextAnchor::Center,
              ink);
  }
}

void
drawScaleBar(Image& image,
             const Pixel& right_end,
             double pixels_per_unit,
             double longest,
             const std::string& unit,
             const MarkStyle& style)
{
  const double length = roundedDown(longest / pixels_per_unit);
  if (!(length > 0.0) || !std::isfinite(length))
    return;
  const double width = length * pixels_per_unit, left = right_end[0] - width,
               row = right_end[1], cap = 0.35 * style.font,
               thickness = style.font / 7.0;
  drawLine(image, left, row, right_end[0], row, thickness, style.ink);
  for (const double column : {left, right_end[0]})
    drawLine(image, column, row - cap, column, row + cap, thickness, style.ink);
  writeText(image,
            shortNumber(length) + (unit.empty() ? "" : " " + unit),
            style.font,
            rounded(0.5 * (left + right_end[0])),
            rounded(row - 1.2 * style.font),
            TextAnchor::Center,
            style.ink);
}

} // namespace uvol_tools
