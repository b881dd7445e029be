// SPDX-License-Identifier: BSD-3-Clause
#include "vtk_messages.h"
#include <pcl_uvol/io/color_bar.h>

#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr std::uint32_t smallest_image = 128;

/** Letters are dark on light ground and light on dark ground. */
constexpr int middle_gray = 128;

/** Lay a color over a pixel. */
void
blend(Image& image, int column, int row, const std::uint8_t* color, double opacity)
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
    pixel[k] = static_cast<std::uint8_t>(
        std::lround((color[k] * opacity + pixel[k] * below) / sum));
  pixel[3] = static_cast<std::uint8_t>(std::lround(255.0 * sum));
}

/** Black or white: what can be read on the image's upper right corner. */
std::uint8_t
inkOn(const Image& image)
{
  const std::uint8_t* const corner = &image.color[4 * (image.width - 1)];
  const int gray = (corner[0] + corner[1] + corner[2]) / 3;
  return corner[3] < middle_gray || gray >= middle_gray ? 0 : 255;
}

/** Write a line of text that ends before a column, around a row. */
void
writeText(Image& image, const std::string& text, int size, int right, int row)
{
  vtkNew<vtkTextProperty> font;
  font->SetFontSize(size);
  font->SetFontFamilyToArial();
  font->SetColor(1.0, 1.0, 1.0);
  vtkNew<vtkImageData> letters;
  int extent[2];
  constexpr int dpi = 72;
  const io::VtkMessages messages;
  if (!vtkFreeTypeTools::GetInstance()->RenderString(
          font, vtkStdString(text), dpi, letters, extent))
    return;
  const std::uint8_t ink = inkOn(image);
  const std::uint8_t color[3] = {ink, ink, ink};
  for (int y = 0; y < extent[1]; ++y)
    for (int x = 0; x < extent[0]; ++x) {
      const auto* const letter =
          static_cast<const std::uint8_t*>(letters->GetScalarPointer(x, y, 0));
      blend(image,
            right - extent[0] + x,
            row + extent[1] / 2 - y,
            color,
            letter[3] / 255.0);
    }
}

std::string
shortNumber(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/** Round values within a range, some five of them. */
std::vector<double>
ticks(double low, double high)
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
    values.push_back(i * step);
  return values;
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
  for (int row = 0; row < length; ++row) {
    const Rgba packed = toRgba(map.at((length - 0.5 - row) / length));
    const std::uint8_t color[3] = {static_cast<std::uint8_t>(packed),
                                   static_cast<std::uint8_t>(packed >> 8),
                                   static_cast<std::uint8_t>(packed >> 16)};
    for (int column = left; column < right; ++column)
      blend(image, column, top + row, color, 1.0);
  }
  for (const double value : ticks(low, high)) {
    const double place = high > low ? (value - low) / (high - low) : 0.5;
    writeText(image,
              shortNumber(value),
              size,
              left - size / 2,
              top + static_cast<int>(std::lround((1.0 - place) * length)));
  }
  writeText(image, title, size, right, top - size * 3 / 2);
}

} // namespace pcl_uvol
