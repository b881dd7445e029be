// SPDX-License-Identifier: BSD-3-Clause
#include "common/degree_names.h"

#include "common/numbers.h"

#include <algorithm>
#include <set>

namespace pcl_uvol {
namespace {

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

} // namespace

NameParts
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
saysDegrees(const std::string& word, std::size_t axis)
{
  return axis == 0
             ? word == "lon" || word == "long" || word == "lng" || word == "longitude"
             : word == "lat" || word == "latitude";
}

bool
isInDegrees(const std::string& name, std::size_t axis)
{
  const auto [word, unit] = splitName(name);
  return saysDegrees(word, axis) && (unit.empty() || unit.rfind("deg", 0) == 0);
}

} // namespace pcl_uvol
