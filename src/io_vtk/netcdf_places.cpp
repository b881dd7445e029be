// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/netcdf_places.h"

#include "common/number_range.h"
#include "common/numbers.h"
#include "common/printable.h"
#include "io/files.h"
#include "io/globe_places.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol {
namespace io {
namespace {

constexpr std::size_t block_numbers = 1u << 16;

struct AxisNames {
  const char* axis; ///< the attribute
  std::vector<std::string> standard_names, units, names;
};

const AxisNames longitude{"X",
                          {"longitude"},
                          {"degrees_east", "degree_east", "degrees_E", "degreesE"},
                          {"lon", "longitude", "long", "nav_lon"}},
    latitude{"Y",
             {"latitude"},
             {"degrees_north", "degree_north", "degrees_N", "degreesN"},
             {"lat", "latitude", "nav_lat"}},
    vertical{"Z",
             {"depth", "height", "altitude", "sea_water_pressure", "air_pressure"},
             {"dbar", "decibar", "decibars"},
             {"depth", "z", "altitude", "height", "pres", "pressure", "lev", "level"}},
    plain_x{"X", {"projection_x_coordinate"}, {}, {"x", "easting"}},
    plain_y{"Y", {"projection_y_coordinate"}, {}, {"y", "northing"}};

bool
isAmong(const std::vector<std::string>& list, const std::string& word)
{
  return std::find(list.begin(), list.end(), word) != list.end();
}

/** How sure it is that a variable is of an axis; 0: it is not. */
int
rate(const NetcdfFile& file,
     const NetcdfVariable& variable,
     const AxisNames& names,
     bool is_axis_enough)
{
  if (variable.is_text)
    return 0;
  const std::string name = lowerCase(variable.name);
  const auto named = std::find(names.names.begin(), names.names.end(), name);
  if (named != names.names.end())
    return 100 - static_cast<int>(named - names.names.begin());
  if (isAmong(names.standard_names, file.readText(variable, "standard_name")))
    return 50;
  if (isAmong(names.units, file.readText(variable, "units")))
    return 20;
  return is_axis_enough && file.readText(variable, "axis") == names.axis ? 10 : 0;
}

/** The most likely one; of equally likely ones the one with more numbers. */
const NetcdfVariable*
findVariable(const NetcdfFile& file, const AxisNames& names, bool is_axis_enough)
{
  const NetcdfVariable* best = nullptr;
  std::pair<int, std::uint64_t> best_rating{0, 0};
  for (const NetcdfVariable& variable : file.getVariables()) {
    const std::pair<int, std::uint64_t> rating{
        rate(file, variable, names, is_axis_enough), file.countNumbers(variable)};
    if (rating.first > 0 && (!best || rating > best_rating)) {
      best = &variable;
      best_rating = rating;
    }
  }
  return best;
}

bool
isDownwards(const NetcdfFile& file, const NetcdfVariable& variable)
{
  const std::string positive = lowerCase(file.readText(variable, "positive"));
  if (!positive.empty())
    return positive == "down";
  const std::string name = lowerCase(variable.name),
                    standard = file.readText(variable, "standard_name");
  return name.rfind("dep", 0) == 0 || name.rfind("pres", 0) == 0 ||
         standard == "depth" || standard.find("pressure") != std::string::npos ||
         isAmong(vertical.units, file.readText(variable, "units"));
}

/** Longitude and latitude of all samples, block by block. */
VisitGlobe
visitPlaces(const SampleSpace& space, const PlaceVariables& places)
{
  return [&](const std::function<void(double, double)>& take) {
    const SampleVariable east = space.open(*places.axes[0]),
                         north = space.open(*places.axes[1]);
    std::array<std::vector<double>, 2> numbers;
    std::uint64_t count = 0;
    for (std::uint64_t first = 0; first < space.size(); first += count) {
      count = std::min<std::uint64_t>(block_numbers, space.size() - first);
      for (auto& block : numbers)
        block.resize(count);
      east.read(first, count, numbers[0].data());
      north.read(first, count, numbers[1].data());
      for (std::size_t i = 0; i < count; ++i)
        take(placeOrNaN(numbers[0][i]), placeOrNaN(numbers[1][i]));
    }
  };
}

} // namespace

PlaceVariables
findPlaces(const NetcdfFile& file)
{
  PlaceVariables places;
  places.axes = {findVariable(file, longitude, false),
                 findVariable(file, latitude, false),
                 findVariable(file, vertical, true)};
  places.is_global = places.axes[0] && places.axes[1];
  if (!places.is_global) {
    places.axes[0] = findVariable(file, plain_x, true);
    places.axes[1] = findVariable(file, plain_y, true);
  }
  if (places.axes[0] && places.axes[1])
    return places;
  std::string list;
  for (const NetcdfVariable& variable : file.getVariables())
    list += (list.empty() ? "" : ", ") + printable(variable.name);
  throwUnreadable(file.getPath(),
                  {"no_netcdf_coordinates", list.empty() ? "none" : shortenText(list)});
}

std::vector<NetcdfVariable>
PlaceVariables::list() const
{
  std::vector<NetcdfVariable> variables;
  for (const NetcdfVariable* variable : axes)
    if (variable)
      variables.push_back(*variable);
  return variables;
}

double
AxisMap::apply(double number) const
{
  const double difference = placeOrNaN(number) - origin;
  return factor * (is_longitude ? std::remainder(difference, 360.0) : difference);
}

PlaceMaps
mapPlaces(const SampleSpace& space,
          const PlaceVariables& places,
          const MapProjection& wanted,
          std::vector<Message>& notes)
{
  PlaceMaps maps;
  if (places.is_global) {
    const MapProjection map = chooseMap(
        visitPlaces(space, places), wanted, printable(places.axes[1]->name), notes);
    const std::array<double, 2> origin{{map.longitude, map.latitude}};
    for (std::size_t axis = 0; axis < 2; ++axis)
      maps.axes[axis] = {origin[axis], map.findFactors()[axis], axis == 0};
    maps.projection = map;
  }
  const NetcdfVariable* const height = places.axes[2];
  double& sign = maps.axes[2].factor;
  if (height && isDownwards(space.getFile(), *height))
    sign = -1.0;
  if (!places.is_global && sign > 0.0)
    return maps;
  const std::string unit =
      height ? printable(space.getFile().readText(*height, "units")) : "";
  const std::string z = height
                            ? (sign < 0.0 ? "minus " : "") + printable(height->name) +
                                  (unit.empty() ? "" : " in " + unit)
                            : "0";
  notes.insert(notes.begin(),
               maps.projection ? describeMap(*maps.projection, z)
                               : Message("vertical_axis", {{"z", z}}));
  return maps;
}

} // namespace io
} // namespace pcl_uvol
