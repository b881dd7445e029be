// SPDX-License-Identifier: BSD-3-Clause
#include "charts/drawing.h"

#include "io/vtk_library.h"
#include <pcl_uvol/render/color_map.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace uvol_tools {

using pcl_uvol::Image;

Ink
inkOf(const pcl_uvol::Color& color)
{
  return {
      pcl_uvol::toByte(color.r), pcl_uvol::toByte(color.g), pcl_uvol::toByte(color.b)};
}

std::string
describeColor(const Ink& ink)
{
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", ink[0], ink[1], ink[2]);
  return text;
}

void
blend(Image& image, int column, int row, const Ink& ink, double opacity)
{
  if (column < 0 || row < 0 || column >= static_cast<int>(image.width) ||
      row >= static_cast<int>(image.height))
    return;
  std::uint8_t* const pixel =
      &image.color[4 * (static_cast<std::size_t>(row) * image.width +
                        static_cast<std::size_t>(column))];
  const double below = pixel[3] / 255.0 * (1.0 - opacity), sum = opacity + below;
  if (sum <= 0.0)
    return;
  for (int k = 0; k < 3; ++k)
    pixel[k] = static_cast<std::uint8_t>(std::lround(
        (ink[static_cast<std::size_t>(k)] * opacity + pixel[k] * below) / sum));
  pixel[3] = static_cast<std::uint8_t>(std::lround(255.0 * sum));
}

int
letterSize(int height, int least)
{
  return std::max(std::clamp(height / 40, 11, 48), least);
}

Ink
inkOn(const Image& image)
{
  constexpr int middle_gray = 128;
  const std::uint8_t* const corner = &image.color[4 * (image.width - 1)];
  const int gray = (corner[0] + corner[1] + corner[2]) / 3;
  const std::uint8_t ink = corner[3] < middle_gray || gray >= middle_gray ? 0 : 255;
  return {ink, ink, ink};
}

namespace {

/** Call set(along, above, opacity) with pixels from the text's left end, and from the
 * middle of its height. */
template <typename Set>
void
forEachPixel(const pcl_uvol::io::Letters& letters, const Set& set)
{
  std::size_t pixel = 0;
  for (int y = 0; y < letters.height; ++y)
    for (int x = 0; x < letters.width; ++x)
      set(x, y - letters.height / 2, letters.opacities[pixel++] / 255.0);
}

thread_local TextKeeper* current_keeper = nullptr;

} // namespace

TextKeeper::TextKeeper()
    : outer_(current_keeper)
{
  current_keeper = this;
}

TextKeeper::~TextKeeper()
{
  current_keeper = outer_;
}

bool
TextKeeper::keep(const TextLine& line)
{
  if (current_keeper == nullptr)
    return false;
  current_keeper->lines_.push_back(line);
  return true;
}

int
measureText(const std::string& text, int size)
{
  return pcl_uvol::io::vtkLibrary().drawLetters(text, size).width;
}

Eigen::AlignedBox2d
boxAround(const TextLine& line)
{
  constexpr double half_height = 0.6; // of the font's size
  const double width = measureText(line.text, line.size);
  const double before = line.anchor == TextAnchor::Left     ? 0.0
                        : line.anchor == TextAnchor::Center ? 0.5 * width
                                                            : width;
  const double half = half_height * line.size;
  const Eigen::Vector2d anchor(line.column, line.row);
  return line.is_upright
             ? Eigen::AlignedBox2d(anchor - Eigen::Vector2d(half, width - before),
                                   anchor + Eigen::Vector2d(half, before))
             : Eigen::AlignedBox2d(anchor - Eigen::Vector2d(before, half),
                                   anchor + Eigen::Vector2d(width - before, half));
}

int
writeText(Image& image,
          const std::string& text,
          int size,
          int column,
          int row,
          TextAnchor anchor,
          const Ink& ink)
{
  const auto letters = pcl_uvol::io::vtkLibrary().drawLetters(text, size);
  if (TextKeeper::keep({text, size, column, row, anchor, false, ink}))
    return letters.width;
  const int left = column - (anchor == TextAnchor::Left     ? 0
                             : anchor == TextAnchor::Center ? letters.width / 2
                                                            : letters.width);
  forEachPixel(letters, [&](int along, int above, double opacity) {
    blend(image, left + along, row - above, ink, opacity);
  });
  return letters.width;
}

void
writeUpwards(Image& image,
             const std::string& text,
             int size,
             int column,
             int row,
             const Ink& ink)
{
  if (TextKeeper::keep({text, size, column, row, TextAnchor::Center, true, ink}))
    return;
  const auto letters = pcl_uvol::io::vtkLibrary().drawLetters(text, size);
  const int start = row + letters.width / 2;
  forEachPixel(letters, [&](int along, int above, double opacity) {
    blend(image, column - above, start - along, ink, opacity);
  });
}

void
writeLine(Image& image, const TextLine& line)
{
  if (line.is_upright)
    writeUpwards(image, line.text, line.size, line.column, line.row, line.ink);
  else
    writeText(
        image, line.text, line.size, line.column, line.row, line.anchor, line.ink);
}

void
forLinePixels(double x0,
              double y0,
              double x1,
              double y1,
              double width,
              const std::function<void(int column, int row, double opacity)>& visit)
{
  const double dx = x1 - x0, dy = y1 - y0, sq_length = dx * dx + dy * dy;
  const double border = 0.5 * width + 1.0;
  const int left = static_cast<int>(std::floor(std::min(x0, x1) - border)),
            right = static_cast<int>(std::ceil(std::max(x0, x1) + border)),
            top = static_cast<int>(std::floor(std::min(y0, y1) - border)),
            bottom = static_cast<int>(std::ceil(std::max(y0, y1) + border));
  // A row leaves the line's border within so many columns of the line; one that is
  // nearly a row itself has all of its columns.
  const bool is_row = std::abs(dy) <= 1e-3 * std::abs(dx);
  const double slant = is_row ? 0.0 : dx / dy;
  const double reach = is_row ? right - left : border * std::hypot(1.0, slant);
  for (int row = top; row <= bottom; ++row) {
    const double middle = x0 + (row - y0) * slant;
    const int first =
        static_cast<int>(std::max<double>(left, std::floor(middle - reach)));
    const int last =
        static_cast<int>(std::min<double>(right, std::ceil(middle + reach)));
    for (int column = first; column <= last; ++column) {
      const double along =
          sq_length > 0.0
              ? std::clamp(((column - x0) * dx + (row - y0) * dy) / sq_length, 0.0, 1.0)
              : 0.0;
      const double distance =
          std::hypot(column - x0 - along * dx, row - y0 - along * dy);
      const double opacity = std::clamp(0.5 * width + 0.5 - distance, 0.0, 1.0);
      if (opacity > 0.0)
        visit(column, row, opacity);
    }
  }
}

void
drawLine(Image& image,
         double x0,
         double y0,
         double x1,
         double y1,
         double width,
         const Ink& ink)
{
  forLinePixels(x0, y0, x1, y1, width, [&](int column, int row, double opacity) {
    blend(image, column, row, ink, opacity);
  });
}

std::string
shortNumber(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

int
countDigits(double low, double high)
{
  const double range = high - low;
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(range > 0.0) || !std::isfinite(largest / range))
    return 4;
  return 3 + static_cast<int>(std::floor(std::log10(largest / range) + 1e-9));
}

namespace {

std::string
formatNumber(double value, int digits)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/** A power of ten and at most as many digits before it, of which the last ones are not
 * 0: 1.5e-05. */
std::string
formatScientific(double value, int digits)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  const std::string number = text;
  const std::size_t exponent = number.find('e');
  std::size_t end = exponent;
  if (number.find('.') != std::string::npos)
    end = number.find_last_not_of("0.", exponent - 1) + 1;
  return number.substr(0, end) + number.substr(exponent);
}

/** True for a number with a power of ten. */
bool
hasExponent(const std::string& text)
{
  return text.find('e') != std::string::npos;
}

/** The roundest number near the lower end of a range: the multiple of the largest power
 * of ten that lies within the range or as far below it. */
double
findOffset(double low, double high)
{
  const double range = high - low;
  double power = std::ceil(std::log10(std::max(std::abs(low), std::abs(high))));
  for (;; power -= 1.0) {
    const double unit = std::pow(10.0, power);
    const double below = std::floor(low / unit) * unit, above = below + unit;
    if (below >= low - range)
      return below;
    if (above <= high)
      return above;
  }
}

} // namespace

AxisLabels
labelValues(const std::vector<double>& values)
{
  constexpr int most_digits = 6, offset_digits = 15;
  AxisLabels labels;
  const int digits = countDigits(values.front(), values.back());
  double offset = 0.0;
  if (digits > most_digits) {
    offset = findOffset(values.front(), values.back());
    labels.offset =
        (offset < 0.0 ? "- " : "+ ") + formatNumber(std::abs(offset), offset_digits);
  }
  const int wanted = digits > most_digits ? 4 : std::max(digits, 3);
  const double tiny = 1e-9 * (values.back() - values.front());
  std::vector<double> shown;
  for (double value : values) {
    value -= offset;
    if (std::abs(value) <= tiny)
      value = 0.0; // and not "-0" by rounding
    // Thousands are written out.
    const int whole = static_cast<int>(std::ceil(std::log10(std::abs(value) + 1.0)));
    labels.texts.push_back(
        formatNumber(value, whole > most_digits ? wanted : std::max(whole, wanted)));
    shown.push_back(value);
  }
  // Not 5e-05 beside 0.0001.
  if (std::any_of(labels.texts.begin(), labels.texts.end(), hasExponent))
    for (std::size_t i = 0; i < shown.size(); ++i)
      if (shown[i] != 0.0 && !hasExponent(labels.texts[i]))
        labels.texts[i] = formatScientific(shown[i], std::max(wanted, 4));
  return labels;
}

std::vector<double>
roundValues(double low, double high)
{
  if (!(high > low))
    return {low};
  constexpr double wanted = 5.0;
  const double rough = (high - low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double part = rough / power;
  const double step = power * (part > 5.0   ? 10.0
                               : part > 2.0 ? 5.0
                               : part > 1.0 ? 2.0
                                            : 1.0);
  std::vector<double> values;
  for (double i = std::ceil(low / step); i * step <= high + 1e-9 * step; ++i)
    values.push_back(i * step + 0.0); // which turns -0 into 0
  return values;
}

} // namespace uvol_tools
