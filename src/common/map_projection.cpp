// SPDX-License-Identifier: BSD-3-Clause
#include "common/degree_names.h"
#include "common/numbers.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/map_projection.h>

#include <cmath>
#include <sstream>

namespace pcl_uvol {
namespace {

/** Mean radius of the Earth in kilometres (IUGG 1980). */
constexpr double earth_radius = 6371.0088;
constexpr double radians = 3.14159265358979323846 / 180.0;
constexpr double degree = earth_radius * radians;

void
appendPart(std::string& text, const char* name, double value)
{
  text += name;
  appendNumber(
      text, pcl::PCLPointField::FLOAT64, reinterpret_cast<const std::uint8_t*>(&value));
}

} // namespace

bool
MapProjection::isComplete() const
{
  return std::isfinite(longitude) && std::isfinite(latitude) && per_kilometre > 0.0;
}

std::array<double, 2>
MapProjection::findFactors() const
{
  return {per_kilometre * degree * std::cos(latitude * radians),
          per_kilometre * degree};
}

std::array<double, 2>
MapProjection::toMap(double east, double north) const
{
  const auto factors = findFactors();
  return {factors[0] * std::remainder(east - longitude, 360.0),
          factors[1] * (north - latitude)};
}

std::array<double, 2>
MapProjection::toGlobe(double x, double y) const
{
  const auto factors = findFactors();
  return {std::remainder(longitude + x / factors[0], 360.0), latitude + y / factors[1]};
}

std::string
MapProjection::toText() const
{
  std::string text = "+proj=eqc";
  appendPart(text, " +lon_0=", longitude);
  appendPart(text, " +lat_0=", latitude);
  appendPart(text, " +lat_ts=", latitude);
  appendPart(text, " +R=", 1000.0 * earth_radius);
  return text + " +units=" + (per_kilometre > 1.0 ? "m" : "km");
}

std::optional<MapProjection>
MapProjection::fromText(const std::string& text)
{
  MapProjection map;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word.rfind("+lon_0=", 0) == 0)
      parseNumber(word.substr(7), map.longitude);
    else if (word.rfind("+lat_0=", 0) == 0)
      parseNumber(word.substr(7), map.latitude);
    else if (word == "+units=km" || word == "+units=m")
      map.per_kilometre = word == "+units=m" ? 1000.0 : 1.0;
  }
  // Any other projection, radius or order of words is not what toText() writes.
  return map.isComplete() && map.toText() == text ? std::optional(map) : std::nullopt;
}

std::optional<MapProjection>
findMap(const Dataset& points)
{
  return MapProjection::fromText(points.cloud.header.frame_id);
}

void
setMap(Dataset& points, const MapProjection& map)
{
  points.cloud.header.frame_id = map.toText();
}

void
changeMap(Dataset& points, const MapProjection& map)
{
  const std::optional<MapProjection> own = findMap(points);
  if (!own || own->toText() == map.toText())
    return;
  const CloudView view = viewOf(points.cloud);
  std::vector<double> xyz;
  for (std::size_t i = 0; i < view.count; ++i) {
    const auto place = own->toGlobe(view.xyz(i)[0] + points.origin[0],
                                    view.xyz(i)[1] + points.origin[1]);
    const auto at = map.toMap(place[0], place[1]);
    xyz.insert(xyz.end(), {at[0], at[1], view.xyz(i)[2] + points.origin[2]});
  }
  setCoordinates(points, xyz);
  setMap(points, map);
}

std::optional<std::array<std::string, 2>>
findGlobeFields(const std::vector<pcl::PCLPointField>& fields)
{
  std::array<std::string, 2> names;
  for (const pcl::PCLPointField& field : fields)
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (names[axis].empty() && field.count <= 1 && isInDegrees(field.name, axis))
        names[axis] = field.name;
  return names[0].empty() || names[1].empty() ? std::nullopt : std::optional(names);
}

void
setGlobeFields(Dataset& points)
{
  const std::optional<MapProjection> map = findMap(points);
  if (!map)
    return;
  const auto names = findGlobeFields(points.cloud.fields)
                         .value_or(std::array<std::string, 2>{"longitude", "latitude"});
  const CloudView view = viewOf(points.cloud);
  std::array<std::vector<double>, 2> degrees;
  for (std::size_t i = 0; i < view.count; ++i) {
    const auto place = map->toGlobe(view.xyz(i)[0] + points.origin[0],
                                    view.xyz(i)[1] + points.origin[1]);
    for (std::size_t axis = 0; axis < 2; ++axis)
      degrees[axis].push_back(place[axis]);
  }
  for (std::size_t axis = 0; axis < 2; ++axis)
    setField(points, names[axis], degrees[axis]);
}

} // namespace pcl_uvol
