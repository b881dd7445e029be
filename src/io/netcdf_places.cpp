// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_places.h"

#include "common/number_range.h"
#include "common/numbers.h"
#include "common/printable.h"
#include "io/files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace pcl_uvol {
namespace io {
namespace {

/** Mean radius of the Earth in kilometres (IUGG 1980). */
constexpr double earth_radius = 6371.0088;
constexpr double radians = 3.14159265358979323846 / 180.0;
/** Kilometres; a region that is smaller is told in metres. */
constexpr double small_region = 100.0;
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

/** The surest one; of equally sure ones that with more numbers. */
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

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/** \param near longitudes count by the shorter way from there */
Extent
measure(const SampleVariable& variable, std::uint64_t size, AxisMap near)
{
  Extent extent;
  std::vector<double> numbers;
  bool is_first = true;
  for (std::uint64_t first = 0; first < size; first += numbers.size()) {
    numbers.resize(std::min<std::uint64_t>(block_numbers, size - first));
    variable.read(first, numbers.size(), numbers.data());
    for (const double number : numbers) {
      if (!std::isfinite(placeOrNaN(number)))
        continue;
      if (is_first)
        near.origin = number;
      is_first = false;
      const double place = near.origin + near.apply(number);
      extent.low = std::min(extent.low, place);
      extent.high = std::max(extent.high, place);
    }
  }
  return extent;
}

std::string
describeDegrees(double degrees, const char* letters)
{
  std::ostringstream text;
  text.precision(8);
  text << std::abs(degrees) << ' ' << letters[degrees < 0.0 ? 1 : 0];
  return text.str();
}

/** Around which place degrees are mapped, to the digit that is told. */
double
roundDegrees(double degrees)
{
  return std::round(degrees * 1e4) / 1e4;
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
                  "no variables of it are longitude and latitude, or x and y, by their "
                  "standard names, units or names; there are " +
                      (list.empty() ? "none" : shortenText(list)));
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

std::array<AxisMap, 3>
mapPlaces(const SampleSpace& space,
          const PlaceVariables& places,
          std::vector<std::string>& notes)
{
  std::array<AxisMap, 3> maps;
  std::ostringstream text;
  if (places.is_global) {
    std::array<Extent, 2> extents;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      maps[axis].is_longitude = axis == 0;
      extents[axis] = measure(space.open(*places.axes[axis]), space.size(), maps[axis]);
      maps[axis].origin =
          extents[axis].low <= extents[axis].high
              ? roundDegrees((extents[axis].low + extents[axis].high) / 2.0)
              : 0.0;
    }
    maps[0].origin = std::remainder(maps[0].origin, 360.0);
    const double degree = earth_radius * radians,
                 shrunk = std::cos(maps[1].origin * radians);
    const double largest =
        degree * std::max((extents[0].high - extents[0].low) * shrunk,
                          extents[1].high - extents[1].low);
    const double unit = largest < small_region ? 1000.0 : 1.0;
    maps[0].factor = unit * degree * shrunk;
    maps[1].factor = unit * degree;
    text << "Places are mapped around " << describeDegrees(maps[0].origin, "EW") << ", "
         << describeDegrees(maps[1].origin, "NS") << ": x and y are "
         << (unit > 1.0 ? "metres" : "kilometres") << " to the east and north, ";
  }
  const NetcdfVariable* const height = places.axes[2];
  if (height && isDownwards(space.getFile(), *height))
    maps[2].factor = -1.0;
  if (!places.is_global && maps[2].factor > 0.0)
    return maps;
  const std::string unit =
      height ? printable(space.getFile().readText(*height, "units")) : "";
  text << (height
               ? std::string("z is ") + (maps[2].factor < 0.0 ? "minus " : "") +
                     printable(height->name) + (unit.empty() ? "" : " in " + unit) + "."
               : "z is 0.");
  notes.push_back(text.str());
  return maps;
}

} // namespace io
} // namespace pcl_uvol
