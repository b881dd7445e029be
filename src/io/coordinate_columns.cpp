// SPDX-License-Identifier: BSD-3-Clause
#include "io/coordinate_columns.h"

#include "common/degree_names.h"
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
enum System {
  Plain,
  WithUnit,
  Projected,
  Geographic,
  CommonEnding,
  Prefixed,
  Numbered,
  systems
};

struct Axis {
  System system;
  std::size_t axis;
};

/** A name in lower case, around the word that may be an axis: "Position X (km)" is "x"
 * with the unit "km", "NAV_LATITUDE" is "latitude" with "nav" before it. */
struct Parts {
  std::string before, word, unit;
  bool is_quantity = false; ///< as "x_vel": it has an axis, but is not a coordinate
};

using Words = std::set<std::string>;

/** Words that say no more than that a number is a coordinate. */
bool
isFiller(const std::string& word)
{
  static const Words words{"coord",
                           "coords",
                           "coordinate",
                           "coordinates",
                           "pos",
                           "position",
                           "positions",
                           "point",
                           "points",
                           "loc",
                           "location",
                           "center",
                           "centre",
                           "centroid",
                           "mid",
                           "midpoint",
                           "minus"};
  return words.count(word) > 0;
}

/** Words of vectors, of statistics and of flags, whose numbers are not coordinates; a
 * unit that ends with seconds is that of a speed. */
bool
isQuantity(const std::string& word)
{
  static const Words words{
      "v",     "vel",      "velocity",  "speed", "acc",          "accel",
      "force", "momentum", "normal",    "grad",  "gradient",     "flux",
      "field", "mag",      "vorticity", "disp",  "displacement", "err",
      "error", "std",      "sigma",     "var",   "min",          "max",
      "index", "dir",      "direction", "wind",  "orient",       "size",
      "s",     "sec",      "qc",        "flag",  "quality"};
  return words.count(word) > 0;
}

bool
isLength(const std::string& unit)
{
  static const Words units{
      "m",   "km",    "cm",       "mm",    "um",     "\xc2\xb5m", "\xce\xbcm",
      "nm",  "a",     "angstrom", "ft",    "feet",   "in",        "mi",
      "au",  "pc",    "kpc",      "mpc",   "ly",     "rsun",      "rearth",
      "utm", "meter", "meters",   "metre", "metres", "code",      "px"};
  return units.count(unit) > 0;
}

/** Depths in the languages of Europe's surveys. */
bool
saysDepth(const std::string& word)
{
  static const Words words{
      "depth", "tiefe", "teufe", "profondeur", "profundidad", "profondit\xc3\xa0"};
  return words.count(word) > 0;
}

bool
saysHeight(const std::string& word)
{
  static const Words words{"h\xc3\xb6he",
                           "hoehe",
                           "hauteur",
                           "elevaci\xc3\xb3n",
                           "elevacion",
                           "cota",
                           "quota"};
  return words.count(word) > 0;
}

bool
isVertical(const std::string& word)
{
  static const Words words{"z", "elevation", "elev", "rl", "altitude", "alt", "height"};
  return words.count(word) > 0 || saysDepth(word) || saysHeight(word);
}

/** As in NetCDF files of floats: a decibar of sea water is a metre deep. */
bool
isPressure(const std::string& word)
{
  return word == "pres" || word == "pressure";
}

bool
isLetter(std::string_view word)
{
  return word.size() == 1 && word[0] >= 'x' && word[0] <= 'z';
}

/** The axes of maps, wherever these words are in a name. */
const std::map<std::string, Axis>&
listMapAxes()
{
  static const std::map<std::string, Axis> axes{{"e", {Projected, 0}},
                                                {"n", {Projected, 1}},
                                                {"easting", {Projected, 0}},
                                                {"eastings", {Projected, 0}},
                                                {"east", {Projected, 0}},
                                                {"northing", {Projected, 1}},
                                                {"northings", {Projected, 1}},
                                                {"north", {Projected, 1}},
                                                {"rechtswert", {Projected, 0}},
                                                {"ostwert", {Projected, 0}},
                                                {"hochwert", {Projected, 1}},
                                                {"nordwert", {Projected, 1}},
                                                {"longitude", {Geographic, 0}},
                                                {"lon", {Geographic, 0}},
                                                {"long", {Geographic, 0}},
                                                {"lng", {Geographic, 0}},
                                                {"latitude", {Geographic, 1}},
                                                {"lat", {Geographic, 1}}};
  return axes;
}

/** Append a word, or what it is glued of: "xcoord" and "coordx" are "x",
 * "decimallongitude" is "decimal" and "longitude". Models of blocks name the centres
 * XC, YC and ZC. */
void
appendWord(const std::string& word, std::vector<std::string>& words)
{
  if (word.empty())
    return;
  const std::string first = word.substr(0, 1), behind = word.substr(1),
                    last = word.substr(word.size() - 1),
                    front = word.substr(0, word.size() - 1);
  if (isLetter(first) && (isFiller(behind) || behind == "c"))
    words.push_back(first);
  else if (isLetter(last) && isFiller(front))
    words.push_back(last);
  else {
    std::size_t axis = 0;
    for (const char* const known : {"longitude", "latitude"})
      if (const std::size_t at = word.rfind(known);
          at != std::string::npos && at + std::string_view(known).size() == word.size())
        axis = at;
    if (axis > 0)
      words.push_back(word.substr(0, axis));
    words.push_back(word.substr(axis));
  }
}

std::vector<std::string>
splitIntoWords(const std::string& name)
{
  std::vector<std::string> words;
  std::string word;
  for (const char c : lowerCase(name) + ' ')
    if (std::string_view(" \t_-.,:;/()[]{}").find(c) == std::string_view::npos)
      word += c;
    else {
      appendWord(word, words);
      word.clear();
    }
  // "Cell Centroid: X", but not the index of a cell
  if (std::find_if(words.begin(), words.end(), [](const std::string& word) {
        return word.compare(0, 4, "cent") == 0;
      }) != words.end())
    words.erase(std::remove(words.begin(), words.end(), "cell"), words.end());
  // ParaView numbers components: "Points:0"
  if (words.size() == 2 && isFiller(words[0]) && words[1].size() == 1 &&
      words[1][0] >= '0' && words[1][0] <= '2')
    words[1][0] = static_cast<char>(words[1][0] - '0' + 'x');
  return words;
}

Parts
splitName(const std::string& name)
{
  Parts parts;
  for (const std::string& word : splitIntoWords(name)) {
    parts.is_quantity = parts.is_quantity || isQuantity(word);
    if (parts.word.empty() && (isLetter(word) || isVertical(word) || isPressure(word) ||
                               listMapAxes().count(word) > 0))
      parts.word = word;
    else if (!isFiller(word)) {
      std::string& text = parts.word.empty() ? parts.before : parts.unit;
      text += (text.empty() ? "" : "_") + word;
    }
  }
  if (parts.before == "utm" && parts.unit.empty())
    parts.before.swap(parts.unit);
  return parts;
}

/** As px, of a place and no vector: a letter before x, y or z, or a number behind x. */
std::optional<Axis>
findPrefixed(std::string_view name)
{
  if (name.size() != 2)
    return std::nullopt;
  const std::string word = lowerCase(name);
  if (word[0] == 'p' && isLetter(word.substr(1)))
    return Axis{Prefixed, static_cast<std::size_t>(word[1] - 'x')};
  if (word[0] == 'x' && word[1] >= '1' && word[1] <= '3')
    return Axis{Numbered, static_cast<std::size_t>(word[1] - '1')};
  return std::nullopt;
}

/** What a column is an axis of; verticals are those of every system but the plainest.
 */
std::vector<Axis>
listAxes(const std::string& name, const Parts& parts)
{
  const auto& [before, word, unit, is_quantity] = parts;
  std::vector<Axis> axes;
  if (is_quantity)
    return axes;
  const bool has_known_unit = isLength(unit) || unit.empty();
  if (isLetter(word) && before.empty()) {
    const auto axis = static_cast<std::size_t>(word[0] - 'x');
    if (trimmed(name).size() == 1)
      axes.push_back({Plain, axis});
    if (has_known_unit || axis == 2)
      axes.push_back({WithUnit, axis});
    if (!has_known_unit)
      axes.push_back({CommonEnding, axis});
  }
  if (const auto axis = listMapAxes().find(word);
      axis != listMapAxes().end() && (word.size() > 1 || has_known_unit))
    axes.push_back(axis->second);
  if (isPressure(word))
    axes.push_back({Geographic, 2});
  if (const auto axis = findPrefixed(trimmed(name)))
    axes.push_back(*axis);
  if (!isVertical(word) || (isLetter(word) && !before.empty()))
    return axes;
  axes.push_back({Projected, 2});
  axes.push_back({Geographic, 2});
  if (before.empty() && has_known_unit) {
    axes.push_back({CommonEnding, 2});
    if (!isLetter(word))
      axes.push_back({WithUnit, 2});
  }
  return axes;
}

/** A column that may be an axis. */
struct Candidate {
  std::size_t column;
  std::string key; ///< the same of all three columns; "" of a z that needs no other
  int rank;        ///< of several columns, the first of the lowest rank is taken
};

/** In a unit of length, a height stands behind z, and before any other z. On maps a
 * name with a unit, or none, stands before one with other words: "elevation" is a
 * coordinate rather than "depth_from", and "depth" rather than "depth_qc". */
Candidate
makeCandidate(std::size_t column, System system, const Parts& parts)
{
  const bool has_known_unit = isLength(parts.unit) || parts.unit.empty();
  if (system == CommonEnding)
    return {column, has_known_unit ? "" : parts.unit, 0};
  if (system == WithUnit)
    return {column, "", parts.word.size() > 1 ? 1 : has_known_unit ? 0 : 2};
  const bool has_degrees = parts.unit.rfind("deg", 0) == 0;
  return {column,
          system == Plain || system == Numbered ? ""
          : system == Prefixed                  ? parts.before.substr(0, 1)
                                                : parts.before,
          isPressure(parts.word)          ? 2
          : has_known_unit || has_degrees ? 0
                                          : 1};
}

/** The three columns of a system. Where several unknown endings have three columns
 * each, as corners of boxes do, none is taken. */
std::optional<std::array<std::size_t, 3>>
findAxes(System system, const std::array<std::vector<Candidate>, 3>& candidates)
{
  std::array<std::map<std::string, const Candidate*>, 3> first;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Candidate& candidate : candidates[axis]) {
      const Candidate*& taken = first[axis][candidate.key];
      if (!taken || candidate.rank < taken->rank)
        taken = &candidate;
    }
  std::optional<std::array<std::size_t, 3>> found;
  for (const Candidate& x : candidates[0]) {
    const auto y = first[1].find(x.key);
    auto z = first[2].find(x.key);
    if (z == first[2].end())
      z = first[2].find("");
    if (first[0][x.key] != &x || y == first[1].end() || z == first[2].end())
      continue;
    if (found)
      return system == CommonEnding ? std::nullopt : found;
    found = {{x.column, y->second->column, z->second->column}};
  }
  return found;
}

/** One word for a unit of length, "" for what is none. A decibar of sea water is a
 * metre deep. */
std::string
lengthUnit(const std::string& name)
{
  static const std::map<std::string, std::string> same{{"meter", "m"},
                                                       {"meters", "m"},
                                                       {"metre", "m"},
                                                       {"metres", "m"},
                                                       {"utm", "m"},
                                                       {"dbar", "m"},
                                                       {"feet", "ft"},
                                                       {"\xc2\xb5m", "um"},
                                                       {"\xce\xbcm", "um"},
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

bool
saysDegreesOrNoUnit(const std::string& name, std::size_t axis)
{
  const Parts parts = splitName(name);
  return saysDegrees(parts.word, axis) &&
         (parts.unit.empty() || parts.unit.rfind("deg", 0) == 0);
}

CoordinateColumns
describeColumns(System system,
                const std::array<std::size_t, 3>& found,
                const std::vector<std::string>& names)
{
  CoordinateColumns columns{found, {}, {}, false};
  const std::string &x = names[found[0]], &y = names[found[1]], &z = names[found[2]];
  const bool are_degrees = system == Geographic;
  if (are_degrees || mixLengths({x, y, z}))
    columns.mixture = {"mixed_units",
                       {{"x", x},
                        {"y", y},
                        {"z", z},
                        {"are_degrees", are_degrees},
                        {"can_be_mapped", areGlobal(found, names)}}};
  if (system >= CommonEnding)
    columns.note = {
        "common_ending",
        {{"x", shortenText(x)}, {"y", shortenText(y)}, {"z", shortenText(z)}}};
  return columns;
}

/** Whether there are y1 and the like beside x1, as of corners, or triples of another
 * letter that is not usual for vectors, as tx, ty, tz beside px. */
bool
hasOtherPlaces(const std::vector<std::string>& names)
{
  std::map<char, std::set<char>> axes; // by the letter before them
  for (const std::string& name : names) {
    const std::string word = lowerCase(trimmed(name));
    if (word.size() != 2)
      continue;
    if ((word[0] == 'y' || word[0] == 'z') && word[1] >= '1' && word[1] <= '9')
      return true;
    if (isLetter(word.substr(1)))
      axes[word[0]].insert(word[1]);
  }
  return std::any_of(axes.begin(), axes.end(), [](const auto& triple) {
    return triple.second.size() == 3 &&
           std::string_view("pvnafbuwmjeg").find(triple.first) ==
               std::string_view::npos;
  });
}

} // namespace

std::optional<CoordinateColumns>
recognizeCoordinates(const std::vector<std::string>& names, bool on_map)
{
  std::array<std::array<std::vector<Candidate>, 3>, systems> candidates;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Parts parts = splitName(names[i]);
    for (const auto& [system, axis] : listAxes(names[i], parts))
      candidates[system][axis].push_back(makeCandidate(i, system, parts));
  }
  if (on_map)
    if (const auto found = findAxes(Geographic, candidates[Geographic]);
        found && areGlobal(*found, names))
      return CoordinateColumns{*found, {}, {}, true};
  for (std::size_t i = 0; i < systems; ++i) {
    const auto system = static_cast<System>(i);
    if (system >= Prefixed && hasOtherPlaces(names))
      continue;
    if (const auto found = findAxes(system, candidates[i]))
      return describeColumns(system, *found, names);
  }
  return std::nullopt;
}

bool
areGlobal(const std::array<std::size_t, 3>& columns,
          const std::vector<std::string>& names)
{
  return saysDegreesOrNoUnit(names[columns[0]], 0) &&
         saysDegreesOrNoUnit(names[columns[1]], 1);
}

bool
isDownwards(const std::string& name)
{
  const std::string word = pcl_uvol::splitName(name).word;
  return saysDepth(word) || isPressure(word);
}

std::optional<std::string>
findPossibleCoordinate(const std::vector<std::string>& names)
{
  std::array<bool, 2> has_letter{};
  for (const std::string& name : names) {
    const Parts parts = splitName(name);
    if (!parts.before.empty())
      continue;
    if (parts.word == "e" || parts.word == "n")
      has_letter[parts.word == "e" ? 0 : 1] = true;
    else if (!isPressure(parts.word) && !findPrefixed(trimmed(name)) &&
             (parts.is_quantity ? isLetter(parts.word)
                                : !listAxes(name, parts).empty()))
      return name;
    if (has_letter[0] && has_letter[1])
      return name;
  }
  return std::nullopt;
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
  const auto is_number = [&](const std::string& column) {
    std::uint64_t number = 0;
    return parseCount(column, number) && number < names.size();
  };
  const auto is_name = [&](const std::string& column) {
    return std::find(names.begin(), names.end(), column) != names.end();
  };
  // A column called "0" does not take the place of the first one in 0,1,2.
  const bool are_numbers = std::all_of(chosen.begin(), chosen.end(), is_number) &&
                           !std::all_of(chosen.begin(), chosen.end(), is_name);
  std::array<std::size_t, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto named =
        are_numbers ? names.end() : std::find(names.begin(), names.end(), chosen[axis]);
    std::uint64_t number = 0;
    if (named != names.end())
      columns[axis] = static_cast<std::size_t>(named - names.begin());
    else if (parseCount(chosen[axis], number) && number < names.size())
      columns[axis] = static_cast<std::size_t>(number);
    else
      throw InvalidArgument("no_coordinate_column",
                            {{"column", shortenText(chosen[axis])},
                             {"first", shortenText(names.front())},
                             {"last", shortenText(names.back())},
                             {"most", names.size() - 1}});
  }
  if (std::set<std::size_t>(columns.begin(), columns.end()).size() < 3)
    throw InvalidArgument("repeated_coordinate_column", {});
  return columns;
}

} // namespace pcl_uvol::io
