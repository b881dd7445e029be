// SPDX-License-Identifier: BSD-3-Clause
#include "charts/color_bar.h"

#include "charts/text_wrap.h"
#include "common/printable.h"
#include "common/records.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace uvol_tools {

using pcl_uvol::ColorMap;
using pcl_uvol::ColorScale;
using pcl_uvol::Image;

namespace {

constexpr std::uint32_t smallest_image = 128;

/** Least distance of values along the bar, in letters' sizes. */
constexpr double label_distance = 1.3;

/** Ends, and round values that do not come too near to them.
 * \param nearest in parts of the range */
std::vector<double>
barValues(const ColorScale& scale, double nearest)
{
  if (!(scale.high > scale.low))
    return {scale.low};
  std::vector<double> values = {scale.low};
  for (const double value : listTicks(scale))
    if (scale.placeOf(value) - scale.placeOf(values.back()) > nearest &&
        1.0 - scale.placeOf(value) > nearest)
      values.push_back(value);
  values.push_back(scale.high);
  return values;
}

bool
isTooSmall(const Image& image)
{
  return std::min(image.width, image.height) < smallest_image;
}

/** Where the legend of an image stands, and how it is written. */
struct Legend {
  int size, length, top, left, right;
  Ink ink;
  std::vector<std::string> title; ///< lines

  Legend(const Image& image, const std::string& text, int least_letters)
      : size(letterSize(static_cast<int>(image.height), least_letters))
      , length(static_cast<int>(image.height) * 6 / 10)
      , top((static_cast<int>(image.height) - length) / 2)
      , left(static_cast<int>(image.width) - 2 * size)
      , right(left + size)
      , ink(inkOn(image))
      , title(wrapTitle(image, text, least_letters))
  {
    // A title of many lines takes the place of the bar's upper part.
    const int lower = std::max(above(title.size()) + size - top, 0);
    top += lower;
    length -= lower;
  }

  /** Pixels from the middle of the first of so many lines to what they are above. */
  int
  above(std::size_t lines) const
  {
    return size * 3 / 2 +
           rounded(line_distance * size * static_cast<double>(lines - 1));
  }

  PlotArea
  area() const
  {
    return {left, right - 1, top, top + length - 1};
  }

  void
  write(Image& image, const std::string& text, int row) const
  {
    writeText(image, text, size, right, row, TextAnchor::Right, ink);
  }

  /** \param row what the title is above */
  void
  writeTitle(Image& image, int row) const
  {
    for (std::size_t i = 0; i < title.size(); ++i)
      write(image, title[i], row - above(title.size() - i));
  }

private:
  /** As wide as the legend, and no more lines than half of the image has room for. */
  std::vector<std::string>
  wrapTitle(const Image& image, const std::string& text, int least_letters) const
  {
    const int width = static_cast<int>(image.width),
              height = static_cast<int>(image.height);
    std::vector<std::string> lines = wrapText(
        text, size, right - (width - colorBarWidth(width, height, least_letters)));
    const auto most = static_cast<std::size_t>(std::max(height / 2 / above(2) * 2, 1));
    if (lines.size() > most) {
      lines.resize(most);
      lines.back() = "..";
    }
    return lines;
  }
};

/** Short numbers beside a logarithmic scale, unless some of them read the same. */
AxisLabels
labelDecades(const std::vector<double>& values)
{
  AxisLabels labels;
  for (const double value : values)
    labels.texts.push_back(shortNumber(value));
  const auto& texts = labels.texts;
  return std::adjacent_find(texts.begin(), texts.end()) == texts.end()
             ? labels
             : labelValues(values);
}

} // namespace

int
colorBarWidth(int image_width, int image_height, int least_letters)
{
  constexpr int letters = 8; // of the bar, its margin and the values
  if (std::min(image_width, image_height) < static_cast<int>(smallest_image))
    return 0;
  // In small prints letters need more of the width, as they are no smaller.
  const int most =
      least_letters > letterSize(image_height) ? image_width / 2 : image_width / 3;
  return std::min(letters * letterSize(image_height, least_letters), most);
}

int
drawBar(Image& image,
        const ColorMap& map,
        const ColorScale& scale,
        const PlotArea& area,
        const std::vector<BarLabel>& labels,
        TextAnchor anchor,
        int font,
        const Ink& ink)
{
  const int length = area.bottom - area.top + 1;
  for (int row = 0; row < length; ++row) {
    const Ink color = inkOf(colorOnBar(map, scale, (length - 0.5 - row) / length));
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

std::vector<double>
listTicks(const ColorScale& scale)
{
  if (!scale.is_logarithmic)
    return roundValues(scale.low, scale.high);
  constexpr double few_decades = 2.0, slack = 1e-9;
  const double low = std::log10(scale.low), high = std::log10(scale.high);
  std::vector<double> values;
  const int first = static_cast<int>(std::floor(low));
  for (int power = first; power <= high + slack; ++power)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double place = power + std::log10(digit);
      if ((digit == 1.0 || high - low < few_decades) && place >= low - slack &&
          place <= high + slack)
        values.push_back(digit * std::pow(10.0, power));
    }
  // In narrow scales there are round values between these.
  return values.size() < 2 ? roundValues(scale.low, scale.high) : values;
}

pcl_uvol::Color
colorOnBar(const ColorMap& map, const ColorScale& scale, double place)
{
  return map.at(scale.high > scale.low ? place : scale.placeOf(scale.low));
}

BarLabels
labelBar(const ColorScale& scale, double nearest)
{
  const std::vector<double> values = barValues(scale, nearest);
  const AxisLabels texts =
      scale.is_logarithmic ? labelDecades(values) : labelValues(values);
  BarLabels labels{{}, texts.offset};
  for (std::size_t i = 0; i < values.size(); ++i)
    labels.values.push_back({scale.placeOf(values[i]), texts.texts[i]});
  return labels;
}

void
drawColorBar(Image& image,
             const ColorMap& map,
             const ColorScale& scale,
             const std::string& title,
             int least_letters)
{
  if (isTooSmall(image))
    return;
  const Legend legend(image, title, least_letters);
  const BarLabels labels =
      labelBar(scale, label_distance * legend.size / legend.length);
  drawBar(image,
          map,
          scale,
          legend.area(),
          labels.values,
          TextAnchor::Right,
          legend.size,
          legend.ink);
  legend.writeTitle(image, legend.top);
  legend.write(image, labels.offset, legend.top + legend.length + legend.size * 3 / 2);
}

std::vector<pcl_uvol::CategoryColor>
listNamedCategories(const pcl_uvol::CloudView& cloud,
                    const pcl_uvol::LabelNames& labels,
                    const std::string& field,
                    const pcl_uvol::ColorMap& map)
{
  if (!map.isCategorical())
    return {};
  auto categories = pcl_uvol::colorCategories(cloud, field, map, most_categories);
  if (const auto* const names = pcl_uvol::findLabels(cloud.fields, labels, field))
    for (pcl_uvol::CategoryColor& category : categories)
      category.name = pcl_uvol::nameOfLabel(*names, category.value);
  return categories;
}

pcl_uvol::ColorMapping
mapUsually(const pcl_uvol::CloudView& cloud,
           const pcl_uvol::LabelNames& labels,
           const std::string& field)
{
  pcl_uvol::ColorMapping mapping = pcl_uvol::usualColorMapping(cloud, field);
  if (pcl_uvol::findLabels(cloud.fields, labels, field))
    mapping.map = pcl_uvol::usualCategoryMap(cloud, field);
  return mapping;
}

bool
hasLegend(const pcl_uvol::CloudView& cloud,
          const pcl_uvol::LabelNames& labels,
          const std::string& field)
{
  if (field.empty() || field == "rgb" || field == "rgba")
    return false;
  return !pcl_uvol::findLabels(cloud.fields, labels, field) ||
         !pcl_uvol::listCategories(cloud, field, most_categories).empty();
}

void
warnOfNames(const pcl_uvol::CloudView& cloud,
            const pcl_uvol::LabelNames& labels,
            const std::string& field,
            pcl_uvol::Report& report)
{
  if (pcl_uvol::findLabels(cloud.fields, labels, field) &&
      !hasLegend(cloud, labels, field))
    report.warn("repeated_colors",
                {{"most", most_categories}, {"field", pcl_uvol::shortenText(field)}});
}

std::string
describeCategory(const pcl_uvol::CategoryColor& category)
{
  constexpr std::size_t most_letters = 10;
  if (category.name.empty())
    return shortNumber(category.value);
  std::string name = pcl_uvol::printable(category.name);
  if (name.size() <= most_letters)
    return name;
  std::size_t end = most_letters - 2;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80)
    --end; // within a letter of several bytes
  return name.substr(0, end) + "..";
}

void
drawCategories(Image& image,
               const std::vector<pcl_uvol::CategoryColor>& categories,
               const std::string& title,
               int least_letters)
{
  if (isTooSmall(image))
    return;
  const Legend legend(image, title, least_letters);
  const int count = static_cast<int>(categories.size());
  const int step = std::min(legend.size * 3 / 2, legend.length / std::max(count, 1));
  const int top = legend.top + (legend.length - step * count) / 2;
  for (int i = 0; i < count; ++i) {
    const pcl_uvol::CategoryColor& category = categories[static_cast<std::size_t>(i)];
    const Ink color = inkOf(category.color);
    // The lowest one is below, as on a bar.
    const int row = top + step * (count - 1 - i);
    for (int y = 0; y < std::max(step * 4 / 5, 1); ++y)
      for (int x = legend.left; x < legend.right; ++x)
        blend(image, x, row + y, color, 1.0);
    writeText(image,
              describeCategory(category),
              std::min(legend.size, std::max(step, 1)),
              legend.left - legend.size / 2,
              row + step * 2 / 5,
              TextAnchor::Right,
              legend.ink);
  }
  legend.writeTitle(image, top);
}

void
drawLegend(Image& image,
           const pcl_uvol::CloudView& cloud,
           const pcl_uvol::LabelNames& labels,
           const std::string& field,
           const pcl_uvol::ColorMapping& mapping,
           const std::array<double, 2>& range,
           const std::string& title,
           int least_letters)
{
  const auto categories = listNamedCategories(cloud, labels, field, mapping.map);
  if (categories.empty())
    drawColorBar(image,
                 mapping.map,
                 {range[0], range[1], mapping.is_logarithmic},
                 title,
                 least_letters);
  else
    drawCategories(image, categories, title, least_letters);
}

} // namespace uvol_tools
