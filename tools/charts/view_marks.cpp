// SPDX-License-Identifier: BSD-3-Clause
#include "charts/view_marks.h"

#include <Eigen/Geometry>

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

/** The tip of an axis of a triad, and its letter, which stands beyond the tip, also of
 * an axis along the line of sight: from the centre. */
struct TriadAxis {
  double depth;
  Pixel tip, letter;

  TriadAxis(const Perspective& perspective, int axis, double length, int font)
  {
    const Eigen::Vector3d direction = perspective.turned(Eigen::Vector3d::Unit(axis));
    const double across = std::max(std::hypot(direction.x(), direction.y()), 1e-9);
    const double beyond = 0.8 * font / across;
    depth = direction.z();
    for (std::size_t k = 0; k < 2; ++k) {
      tip[k] = length * direction[static_cast<Eigen::Index>(k)];
      letter[k] = tip[k] + beyond * direction[static_cast<Eigen::Index>(k)];
    }
  }
};

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

/** Of the lines across the ends of a bar, to one side, and up to the middle of the text
 * above it: in sizes of letters. */
constexpr double cap = 0.35, above = 1.2;

} // namespace

MarkBox
findTriadBox(const Perspective& perspective, double length, int font)
{
  constexpr double half_letter = 0.6; // of the font's size
  Eigen::AlignedBox2d box(Eigen::Vector2d::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const TriadAxis seen(perspective, axis, length, font);
    const Eigen::Vector2d letter(seen.letter.data());
    for (const double side : {-half_letter * font, half_letter * font})
      box.extend(letter + Eigen::Vector2d::Constant(side));
  }
  return {rounded(box.min().x()),
          rounded(box.max().x()),
          rounded(box.min().y()),
          rounded(box.max().y())};
}

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
    return TriadAxis(perspective, axis, length, style.font);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return seen(a).depth > seen(b).depth;
  });
  for (const int axis : order) {
    const TriadAxis drawn = seen(axis);
    const Ink& ink = inks[static_cast<std::size_t>(axis)];
    drawArrow(image,
              center,
              {center[0] + drawn.tip[0], center[1] + drawn.tip[1]},
              style.font / 7.0,
              ink);
    writeText(image,
              std::string(1, static_cast<char>('x' + axis)),
              style.font,
              rounded(center[0] + drawn.letter[0]),
              rounded(center[1] + drawn.letter[1]),
              TextAnchor::Center,
              ink);
  }
}

ScaleBar::ScaleBar(double pixels_per_unit, double longest, const std::string& unit)
{
  const double length = roundedDown(longest / pixels_per_unit);
  if (!(length > 0.0) || !std::isfinite(length))
    return;
  width = length * pixels_per_unit;
  text = labelValues({length}).texts[0] + (unit.empty() ? "" : " " + unit);
}

MarkBox
findScaleBarBox(const ScaleBar& bar, int font)
{
  constexpr double half_letter = 0.3, half_height = 0.6; // of the font's size
  const double beyond = std::max(
      half_letter * font * static_cast<double>(bar.text.size()) - 0.5 * bar.width, 0.0);
  return {-rounded(bar.width + beyond),
          rounded(beyond),
          -rounded((above + half_height) * font),
          rounded(cap * font)};
}

void
drawScaleBar(Image& image,
             const Pixel& right_end,
             const ScaleBar& bar,
             const MarkStyle& style)
{
  if (bar.width == 0.0)
    return;
  const double left = right_end[0] - bar.width, row = right_end[1],
               half = cap * style.font, thickness = style.font / 7.0;
  drawLine(image, left, row, right_end[0], row, thickness, style.ink);
  for (const double column : {left, right_end[0]})
    drawLine(image, column, row - half, column, row + half, thickness, style.ink);
  writeText(image,
            bar.text,
            style.font,
            rounded(0.5 * (left + right_end[0])),
            rounded(row - above * style.font),
            TextAnchor::Center,
            style.ink);
}

} // namespace uvol_tools
