// SPDX-License-Identifier: BSD-3-Clause
#include "render/point_colors.h"

#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace pcl_uvol {

namespace {

/** Offsets of red, green and blue, one byte each, in a point. */
using ColorBytes = std::array<std::size_t, 3>;

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
    throw InvalidArgument("The cloud has no colours (rgb, rgba, or red, green and blue "
                          "of a byte each); its fields are " +
                          describeFields(cloud.fields) + ".");
  std::vector<Rgba> colors(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const std::uint8_t* const point = cloud.point(i);
    const Rgba red = point[(*bytes)[0]], green = point[(*bytes)[1]],
               blue = point[(*bytes)[2]];
    colors[i] = 0xff000000u | blue << 16 | green << 8 | red;
  }
  return colors;
}

} // namespace

bool
hasColors(const CloudView& cloud)
{
  return findColors(cloud).has_value();
}

bool
hasIsovalues(const CloudView& cloud)
{
  if (cloud.count == 0 || findField(cloud.fields, "isovalue") == nullptr)
    return false;
  const ScalarField field(cloud.fields, "isovalue");
  const double first = field.read(cloud.point(0));
  for (std::size_t i = 1; i < cloud.count; ++i)
    if (field.read(cloud.point(i)) != first)
      return true;
  return false;
}

std::string
usualColorField(const CloudView& cloud)
{
  if (hasColors(cloud))
    return "rgb";
  return hasIsovalues(cloud) ? "isovalue" : "";
}

PointColors
colorPoints(const CloudView& cloud,
            const std::string& field,
            const ColorMap& map,
            const std::optional<std::array<double, 2>>& range)
{
  if (field == "rgb" || field == "rgba")
    return {readColors(cloud)};
  const ScalarField scalar(cloud.fields, field);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = scalar.read(cloud.point(i));
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high)
    throw InvalidArgument("All values of " + field + " are without a number.");
  PointColors colored;
  colored.range = range.value_or(std::array<double, 2>{low, high});
  std::tie(low, high) = std::tie(colored.range[0], colored.range[1]);
  // In parts of the range: floats do not hold the digits of time stamps.
  const double reference = std::isfinite(low) ? low : 0.0;
  const double extent = high > low && std::isfinite(high - low) ? high - low : 1.0;
  std::vector<float> parts(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i)
    parts[i] = static_cast<float>((scalar.read(cloud.point(i)) - reference) / extent);
  const auto part = [&](double value) { return (value - reference) / extent; };
  colored.colors = map.apply(parts, part(low), part(high));
  return colored;
}

} // namespace pcl_uvol
