// SPDX-License-Identifier: BSD-3-Clause
#include "render/point_colors.h"

#include "common/printable.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace pcl_uvol {

namespace {

/** Offsets of red, green and blue, one byte each, in a point. */
using ColorBytes = std::array<std::size_t, 3>;

constexpr const char* isovalues = "isovalue";

/** Packed by PCL as blue, green, red and opacity, else as PLY files have them; none:
 * the cloud has no colours. */
std::optional<ColorBytes>
findColors(const CloudView& cloud)
{
  for (const char* name : {"rgb", "rgba"}) {
    const pcl::PCLPointField* const field = findField(cloud.fields, name);
    if (field != nullptr && datatypeSize(field->datatype) == sizeof(Rgba))
      return ColorBytes{field->offset + 2u, field->offset + 1u, field->offset};
  }
  ColorBytes bytes{};
  std::size_t found = 0;
  for (const char* name : {"red", "green", "blue"}) {
    const pcl::PCLPointField* const field = findField(cloud.fields, name);
    if (field == nullptr || field->datatype != pcl::PCLPointField::UINT8)
      return std::nullopt;
    bytes[found++] = field->offset;
  }
  return bytes;
}

std::vector<Rgba>
readColors(const CloudView& cloud)
{
  const auto bytes = findColors(cloud);
  if (!bytes)
    throw InvalidArgument("cloud_without_colors",
                          {{"fields", describeFields(cloud.fields)}});
  std::vector<Rgba> colors(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const std::uint8_t* const point = cloud.point(i);
    const Rgba red = point[(*bytes)[0]], green = point[(*bytes)[1]],
               blue = point[(*bytes)[2]];
    colors[i] = 0xff000000u | blue << 16 | green << 8 | red;
  }
  return colors;
}

bool
holdsWholeNumbers(const CloudView& cloud, const ScalarField& field)
{
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = field.read(cloud.point(i));
    if (std::isfinite(value) && value != std::floor(value))
      return false;
  }
  return true;
}

/** Whole numbers of which there are too many for a legend repeat the colours.
 * \return false for values that are no categories */
bool
colorByCategory(const CloudView& cloud,
                const std::string& field,
                const ColorMap& map,
                PointColors& colored)
{
  const ScalarField scalar(cloud.fields, field);
  const auto categories = colorCategories(cloud, field, map, map.size());
  if (categories.empty() && !holdsWholeNumbers(cloud, scalar))
    return false;
  std::map<double, Rgba> known;
  for (const CategoryColor& category : categories)
    known[category.value] = toRgba(category.color);
  colored.colors.resize(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = scalar.read(cloud.point(i));
    const auto found = std::isfinite(value) ? known.find(value) : known.end();
    colored.colors[i] =
        found != known.end() ? found->second : toRgba(map.ofCategory(value));
  }
  return true;
}

} // namespace

Rgba
makePaler(Rgba color, const Color& background)
{
  constexpr Rgba channel = 0xff, opaque = 0xff000000;
  const Rgba behind = toRgba(background);
  Rgba paler = color & opaque;
  for (const unsigned shift : {0u, 8u, 16u})
    paler |= ((color >> shift & channel) + (behind >> shift & channel)) / 2 << shift;
  return paler;
}

bool
hasColors(const CloudView& cloud)
{
  return findColors(cloud).has_value();
}

bool
hasIsovalues(const CloudView& cloud)
{
  if (cloud.count == 0 || findField(cloud.fields, isovalues) == nullptr)
    return false;
  const ScalarField field(cloud.fields, isovalues);
  const double first = field.read(cloud.point(0));
  for (std::size_t i = 1; i < cloud.count; ++i)
    if (field.read(cloud.point(i)) != first)
      return true;
  return false;
}

std::vector<double>
listIsovalues(const CloudView& cloud)
{
  constexpr std::size_t most = 20;
  return findField(cloud.fields, isovalues) == nullptr
             ? std::vector<double>()
             : listCategories(cloud, isovalues, most);
}

std::string
usualColorField(const CloudView& cloud)
{
  if (hasColors(cloud))
    return "rgb";
  return hasIsovalues(cloud) ? isovalues : "";
}

std::string
resolveColor(const CloudView& cloud, const std::string& choice)
{
  if (choice == "auto")
    return usualColorField(cloud);
  return choice == "none" ? "" : choice;
}

std::vector<double>
listCategories(const CloudView& cloud, const std::string& field, std::size_t most)
{
  const ScalarField scalar(cloud.fields, field);
  std::set<double> values;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = scalar.read(cloud.point(i));
    if (!std::isfinite(value))
      continue;
    if (value != std::floor(value) && field != isovalues)
      return {};
    values.insert(value);
    if (values.size() > most)
      return {};
  }
  return {values.begin(), values.end()};
}

std::vector<CategoryColor>
colorCategories(const CloudView& cloud,
                const std::string& field,
                const ColorMap& map,
                std::size_t most)
{
  const bool are_isovalues = field == isovalues;
  const auto is_class = [&](double value) { return are_isovalues || value >= 0.0; };
  const std::vector<double> values = listCategories(cloud, field, most);
  std::set<double> shades;
  std::size_t classes = 0;
  for (const double value : values)
    if (is_class(value)) {
      shades.insert(std::fmod(value, static_cast<double>(map.size())));
      ++classes;
    }
  const bool are_ranked =
      are_isovalues || (shades.size() < classes && classes <= map.size());
  std::vector<CategoryColor> categories;
  double rank = 0.0;
  for (const double value : values)
    categories.push_back(
        {value, map.ofCategory(are_ranked && is_class(value) ? rank++ : value)});
  return categories;
}

ColorMap
usualCategoryMap(const CloudView& cloud, const std::string& field)
{
  const ColorMap few("OkabeIto");
  return listCategories(cloud, field, few.size()).empty() ? ColorMap("tab10") : few;
}

ColorMapping
usualColorMapping(const CloudView& cloud, const std::string& field)
{
  const ColorMap map = field == "rgb" || field == "rgba" || field.empty()
                           ? ColorMap()
                           : usualCategoryMap(cloud, field);
  if (map.isCategorical() && listCategories(cloud, field, map.size()).size() > 1)
    return {map, std::nullopt, false};
  return {ColorMap(), std::nullopt, false};
}

ColorScale
findColorScale(const CloudView& cloud,
               const std::string& field,
               const ColorMapping& mapping)
{
  const ScalarField scalar(cloud.fields, field);
  ColorScaleFinder finder(mapping.is_logarithmic);
  bool has_numbers = false;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = scalar.read(cloud.point(i));
    has_numbers = has_numbers || std::isfinite(value);
    finder.add(value);
  }
  if (!has_numbers)
    throw InvalidArgument("color_field_without_numbers", {{"field", field}});
  const std::optional<ColorScale> found = finder.find();
  if (!found)
    throw InvalidArgument("color_field_without_logarithms", {{"field", field}});
  if (!mapping.range)
    return *found;
  const auto [low, high] = *mapping.range;
  if (!std::isfinite(low) || !std::isfinite(high) || low > high ||
      (mapping.is_logarithmic && !(low > 0.0)))
    throw InvalidArgument("bad_mapped_color_range", {});
  return {low, high, mapping.is_logarithmic};
}

void
warnOfLogarithms(const CloudView& cloud,
                 const std::string& field,
                 const ColorMapping& mapping,
                 Report& report)
{
  if (!mapping.is_logarithmic || field.empty() || field == "rgb" || field == "rgba")
    return;
  const ScalarField scalar(cloud.fields, field);
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.count; ++i)
    count += scalar.read(cloud.point(i)) <= 0.0 ? 1 : 0;
  if (count > 0)
    report.warn(
        "no_logarithms",
        {{"field", shortenText(field)}, {"grey", count}, {"points", cloud.count}});
}

PointColors
colorPoints(const CloudView& cloud,
            const std::string& field,
            const ColorMapping& mapping)
{
  if (field == "rgb" || field == "rgba")
    return {readColors(cloud), {}};
  const ScalarField scalar(cloud.fields, field);
  PointColors colored;
  colored.scale = findColorScale(cloud, field, mapping);
  if (mapping.map.isCategorical() &&
      colorByCategory(cloud, field, mapping.map, colored))
    return colored;
  // In parts of the range: floats do not hold the digits of time stamps.
  std::vector<float> parts(cloud.count, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = scalar.read(cloud.point(i));
    if (colored.scale.hasPlace(value))
      parts[i] = static_cast<float>(colored.scale.placeOf(value));
  }
  colored.colors = mapping.map.apply(parts, 0.0, 1.0);
  return colored;
}

} // namespace pcl_uvol
