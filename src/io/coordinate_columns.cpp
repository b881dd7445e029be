// SPDX-License-Identifier: BSD-3-Clause
#include "io/coordinate_columns.h"

#include "common/numbers.h"
#include "common/printable.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace pcl_uvol::io {

namespace {

/** Ways to name coordinates, the plainest first. */
enum System { Plain, WithUnit, Projected, Geographic, systems };

struct Axis {
  System system;
  std::size_t axis;
};

/** A name in lower case and what stands behind its first word: "x (km)" -> "x", "km".
 */
struct Parts {
  std::string word, unit;
};

constexpr const char* separators = "_-. ([/";

/** What is left of a unit behind words that are none: "minus_dbar" -> "dbar",
 * "coord" -> "". */
std::string
withoutFillers(const std::string& unit)
{
  static const std::set<std::string> fillers{
      "coord", "coords", "coordinate", "coordinates", "minus"};
  const std::size_t end = std::min(unit.find_first_of(separators), unit.size());
  return fillers.count(unit.substr(0, end)) > 0
             ? unit.substr(std::min(end + 1, unit.size()))
             : unit;
}

Parts
splitName(const std::string& name)
{
  const std::string lower = lowerCase(trimmed(name));
  const std::size_t end = lower.find_first_of(separators);
  if (end == std::string::npos)
    return {lower, ""};
  std::string unit = lower.substr(end);
  const std::size_t first = unit.find_first_not_of(separators);
  unit = first == std::string::npos ? "" : unit.substr(first);
  return {lower.substr(0, end),
          withoutFillers(unit.substr(0, unit.find_first_of(")] ")))};
}

bool
isLength(const std::string& unit)
{
  static const std::set<std::string> units{
      "m",  "km",   "cm",     "mm",  "um",     "nm",     "a",    "angstrom",
      "ft", "feet", "in",     "mi",  "au",     "pc",     "kpc",  "mpc",
      "ly", "rsun", "rearth", "utm", "meters", "metres", "code", "px"};
  return units.count(unit) > 0;
}

bool
isVertical(const std::string& word)
{
  static const std::set<std::string> words{
      "z", "elevation", "elev", "rl", "altitude", "alt", "height", "depth"};
  return words.count(word) > 0;
}

/** What a column is an axis of; verticals are those of every system but the plainest.
 */
std::vector<Axis>
listAxes(const std::string& name)
{
  const auto [word, unit] = splitName(name);
  std::vector<Axis> axes;
  if (word.size() == 1 && word[0] >= 'x' && word[0] <= 'z') {
    const auto axis = static_cast<std::size_t>(word[0] - 'x');
    if (unit.empty() && trimmed(name).size() == 1)
      axes.push_back({Plain, axis});
    if (isLength(unit) || unit.empty() || axis == 2)
      axes.push_back({WithUnit, axis});
  }
  else if (word == "easting" || word == "east" || word == "eastings")
    axes.push_back({Projected, 0});
  else if (word == "northing" || word == "north" || word == "northings")
    axes.push_back({Projected, 1});
  else if (word == "lon" || word == "long" || word == "longitude")
    axes.push_back({Geographic, 0});
  else if (word == "lat" || word == "latitude")
    axes.push_back({Geographic, 1});
  if (isVertical(word)) {
    if (word != "z" && (isLength(unit) || unit.empty()))
      axes.push_back({WithUnit, 2});
    axes.push_back({Projected, 2});
    axes.push_back({Geographic, 2});
  }
  return axes;
}

/** The column of the lowest rank is taken where several may be an axis: beside x and y
 * a height stands behind z in a unit of length, and before any other z, which may be a
 * speed. */
int
rankName(const std::string& name, System system)
{
  if (system != WithUnit)
    return 0;
  const auto [word, unit] = splitName(name);
  return word.size() > 1 ? 1 : isLength(unit) || unit.empty() ? 0 : 2;
}

/** One word for a unit of length, "" for what is none. A decibar of sea water is a
 * metre deep. */
std::string
lengthUnit(const std::string& name)
{
  static const std::map<std::string, std::string> same{{"meters", "m"},
                                                       {"metres", "m"},
                                                       {"utm", "m"},
                                                       {"dbar", "m"},
                                                       {"feet", "ft"},
                                                       {"angstrom", "a"}};
  const std::string unit = splitName(name).unit;
  const auto found = same.find(unit);
  return found != same.end() ? found->second : isLength(unit) ? unit : "";
}

bool
mixLengths(const std::array<std::string, 3>& names)
{
  std::set<std::string> units;
  for (const std::string& name : names)
    units.insert(lengthUnit(name));
  units.erase("");
  return units.size() > 1;
}

/** What distances mix, "" where it is not known that they do. */
std::string
findMixture(System system, const std::array<std::string, 3>& names)
{
  if (system == Geographic)
    return "degrees with another unit";
  return mixLengths(names) ? "different units of length" : "";
}

} // namespace

std::optional<CoordinateColumns>
recognizeCoordinates(const std::vector<std::string>& names)
{
  std::array<std::array<std::optional<std::size_t>, 3>, systems> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (const auto& [system, axis] : listAxes(names[i])) {
      auto& taken = found[system][axis];
      if (!taken || rankName(names[i], system) < rankName(names[*taken], system))
        taken = i;
    }
  for (std::size_t system = 0; system < systems; ++system) {
    const auto& [x, y, z] = found[system];
    if (!x || !y || !z)
      continue;
    CoordinateColumns columns{{{*x, *y, *z}}, ""};
    const std::string mixture =
        findMixture(static_cast<System>(system), {names[*x], names[*y], names[*z]});
    if (!mixture.empty())
      columns.note = "Coordinates are " + names[*x] + ", " + names[*y] + " and " +
                     names[*z] + ", so distances mix " + mixture +
                     ": columns in one unit of length, or factors for the axes "
                     "(-scale), mend that.";
    return columns;
  }
  return std::nullopt;
}

bool
mayBeCoordinate(const std::string& name)
{
  return !listAxes(name).empty();
}

bool
saysTime(const std::string& name)
{
  static const std::set<std::string> words{"t",
                                           "date",
                                           "datetime",
                                           "day",
                                           "days",
                                           "year",
                                           "month",
                                           "hour",
                                           "hours",
                                           "minute",
                                           "minutes",
                                           "second",
                                           "seconds",
                                           "utc",
                                           "epoch",
                                           "unix"};
  const std::string time = "time", lower = lowerCase(name);
  std::string word;
  for (const char c : lower + " ") {
    if (std::string_view("_-. ([/)]").find(c) == std::string_view::npos) {
      word += c;
      continue;
    }
    const bool ends = word.size() >= time.size() &&
                      word.compare(word.size() - time.size(), time.size(), time) == 0;
    if (ends || word.compare(0, time.size(), time) == 0 || words.count(word) > 0)
      return true;
    word.clear();
  }
  return false;
}

std::array<std::size_t, 3>
findChosenColumns(const std::array<std::string, 3>& chosen,
                  const std::vector<std::string>& names)
{
  std::array<std::size_t, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto named = std::find(names.begin(), names.end(), chosen[axis]);
    std::uint64_t number = 0;
    if (named != names.end())
      columns[axis] = static_cast<std::size_t>(named - names.begin());
    else if (parseCount(chosen[axis], number) && number < names.size())
      columns[axis] = static_cast<std::size_t>(number);
    else
      throw InvalidArgument(
          "there is no column " + quoteText(chosen[axis]) +
          " for a coordinate; columns are " + quoteText(names.front()) + " to " +
          quoteText(names.back()) + ", or 0 to " + std::to_string(names.size() - 1));
  }
  if (std::set<std::size_t>(columns.begin(), columns.end()).size() < 3)
    throw InvalidArgument("the coordinates need three different columns");
  return columns;
}

} // namespace pcl_uvol::io
