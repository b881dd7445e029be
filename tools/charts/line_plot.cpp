// SPDX-License-Identifier: BSD-3-Clause
#include "charts/line_plot.h"

#include "charts/axes.h"
#include "charts/drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace uvol_tools {

using pcl_uvol::Image;

namespace {

constexpr Ink line_gray{215, 215, 215};
constexpr Ink line_inks[] = {
    {31, 119, 180}, {255, 127, 14}, {44, 160, 44}, {148, 103, 189}};

/** Colours of kinds of dots: the first one is black. */
constexpr Ink dot_inks[] = {black, {255, 127, 14}, {44, 160, 44}, {214, 39, 40}};

/** What a plot is drawn on, in pixels: as much is left around it as letters need. */
struct Sheet {
  int width, height, font;
  int left, right, top, bottom;
  double thin_line, line_width, dot;

  explicit Sheet(const Paper& asked)
  {
    constexpr Paper usual{720, 440};
    const Paper paper = asked.orUsual(usual);
    width = paper.width;
    height = paper.height;
    font = paper.chartLetters(usual);
    left = 5 * font;
    right = width - 10 * font / 7;
    top = 10 * font / 7;
    bottom = height - 25 * font / 7;
    thin_line = font / 14.0;
    line_width = font / 7.0;
    dot = font / 2.0;
  }

  Image
  makeImage() const
  {
    Image image;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.color.assign(4 * image.pixels(), 255);
    return image;
  }
};

bool
isDrawn(double value)
{
  return value > 0.0 && std::isfinite(value);
}

/** Whole powers of ten around all values. */
struct Decades {
  int low, high;
};

Decades
findDecades(const std::vector<PlotLine>& lines)
{
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const PlotLine& line : lines)
    for (const double value : line.values)
      if (isDrawn(value)) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  if (high == 0.0)
    return {-1, 0};
  const auto from = static_cast<int>(std::floor(std::log10(low)));
  return {from, std::max(from + 1, static_cast<int>(std::ceil(std::log10(high))))};
}

} // namespace

namespace {

/** What the values range over, and some more. */
AxisScale
findOrdinate(const Profile& profile)
{
  constexpr double room = 0.05;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto include = [&](double value) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  };
  for (const double value : profile.values)
    include(value);
  for (const PlotDots& dots : profile.dots)
    for (const auto& place : dots.places)
      include(place[1]);
  if (!(low <= high))
    return {0.0, 1.0};
  const double more = high > low ? room * (high - low) : std::abs(low) + 1.0;
  return {low - more, high + more};
}

} // namespace

Image
drawProfile(const Profile& profile, const Paper& paper)
{
  constexpr Ink band{205, 225, 240};
  const Sheet sheet(paper);
  const int font = sheet.font, margin = font / 2;
  Image image = sheet.makeImage();
  const PlotArea area{55 * font / 7, sheet.right, sheet.top, sheet.bottom - font};
  const AxisScale x{profile.abscissas.front(), profile.abscissas.back()},
      y = findOrdinate(profile);
  const auto column = [&](std::size_t i) {
    return area.left + x.placeOf(profile.abscissas[i]) * (area.right - area.left);
  };
  const auto row = [&](double value) {
    const double place = std::clamp(y.placeOf(value), 0.0, 1.0);
    return area.bottom - place * (area.bottom - area.top);
  };
  const auto has_line = [&](std::size_t i) {
    return std::isfinite(profile.values[i - 1]) && std::isfinite(profile.values[i]);
  };
  // A column of the band after the other, between the points left and right of it.
  std::size_t i = 1;
  for (int at = area.left; !profile.errors.empty() && at <= area.right; ++at) {
    while (i + 1 < profile.values.size() && column(i) < at)
      ++i;
    if (!has_line(i) || !(profile.errors[i - 1] >= 0.0) || !(profile.errors[i] >= 0.0))
      continue;
    const double part = (at - column(i - 1)) / (column(i) - column(i - 1));
    const auto mean = [&](const std::vector<double>& numbers) {
      return numbers[i - 1] + part * (numbers[i] - numbers[i - 1]);
    };
    const double value = mean(profile.values), error = mean(profile.errors);
    for (int pixel = static_cast<int>(row(value + error)); pixel <= row(value - error);
         ++pixel)
      blend(image, at, pixel, band, 1.0);
  }
  for (std::size_t k = 1; k < profile.values.size(); ++k)
    if (has_line(k))
      drawLine(image,
               column(k - 1),
               row(profile.values[k - 1]),
               column(k),
               row(profile.values[k]),
               sheet.line_width,
               line_inks[0]);
  const auto drawDot = [&](double at, double height, const Ink& ink) {
    drawLine(image, at, height, at, height, sheet.dot, ink);
  };
  // In the lower right corner, from below, which curves that rise leave free.
  int legend = area.bottom - font;
  for (std::size_t k = profile.dots.size(); k-- > 0;) {
    const PlotDots& dots = profile.dots[k];
    const Ink& ink = dot_inks[k % std::size(dot_inks)];
    if (dots.places.empty())
      continue;
    for (const auto& [abscissa, value] : dots.places)
      drawDot(
          area.left + x.placeOf(abscissa) * (area.right - area.left), row(value), ink);
    drawDot(area.right - font, legend, ink);
    writeText(image,
              dots.name,
              font,
              area.right - 2 * font,
              legend,
              TextAnchor::Right,
              black);
    legend -= font * 3 / 2;
  }
  drawAxisBelow(image, area, margin, x, profile.abscissa, font);
  drawAxisLeft(image, area, margin, y, profile.ordinate, font);
  return image;
}

Image
drawLinePlot(const std::vector<PlotLine>& lines,
             const std::string& abscissa,
             const Paper& paper)
{
  const Sheet sheet(paper);
  const int font = sheet.font, left = sheet.left, right = sheet.right, top = sheet.top,
            bottom = sheet.bottom;
  Image image = sheet.makeImage();

  std::size_t count = 2;
  for (const PlotLine& line : lines)
    count = std::max(count, line.values.size());
  const auto x = [&](double i) {
    return left + (right - left) * (i - 1.0) / (static_cast<double>(count) - 1.0);
  };
  const Decades decades = findDecades(lines);
  const auto y = [&](double value) {
    return bottom + (top - bottom) * (std::log10(value) - decades.low) /
                        (decades.high - decades.low);
  };

  for (int power = decades.low; power <= decades.high; ++power) {
    const double row = y(std::pow(10.0, power));
    drawLine(image, left, row, right, row, sheet.thin_line, line_gray);
    writeText(image,
              shortNumber(std::pow(10.0, power)),
              font,
              left - font / 2,
              static_cast<int>(std::lround(row)),
              TextAnchor::Right,
              black);
  }
  const int end_of_ticks = bottom + font / 2;
  for (const double i : roundValues(1.0, static_cast<double>(count))) {
    drawLine(image, x(i), bottom, x(i), end_of_ticks, sheet.thin_line, black);
    writeText(image,
              shortNumber(i),
              font,
              static_cast<int>(std::lround(x(i))),
              bottom + font * 5 / 4,
              TextAnchor::Center,
              black);
  }
  drawLine(image, left, bottom, right, bottom, sheet.thin_line, black);
  drawLine(image, left, top, left, bottom, sheet.thin_line, black);
  writeText(image,
            abscissa,
            font,
            (left + right) / 2,
            bottom + font * 5 / 2,
            TextAnchor::Center,
            black);

  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Ink& ink = line_inks[k % std::size(line_inks)];
    const std::vector<double>& values = lines[k].values;
    for (std::size_t i = 1; i < values.size(); ++i)
      if (isDrawn(values[i - 1]) && isDrawn(values[i]))
        drawLine(image,
                 x(static_cast<double>(i)),
                 y(values[i - 1]),
                 x(static_cast<double>(i + 1)),
                 y(values[i]),
                 sheet.line_width,
                 ink);
    const int row = top + font + static_cast<int>(k) * font * 3 / 2;
    drawLine(image, right - 2 * font, row, right, row, sheet.line_width, ink);
    writeText(
        image, lines[k].name, font, right - 3 * font, row, TextAnchor::Right, black);
  }
  return image;
}

} // namespace uvol_tools
