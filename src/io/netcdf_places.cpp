// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_places.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io/files.h"

#include <pcl/PCLPointField.h>

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
        rate(file, variable, names, is_axis_enough), file.sizeOf(variable)};
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
      if (!std::isfinite(number))
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

void
SampleVariable::findPacking()
{
  const auto first = [&](const char* attribute, double otherwise) {
    const auto numbers = file_->readNumbers(variable_, attribute);
    return numbers.empty() ? otherwise : numbers[0];
  };
  using Type = pcl::PCLPointField;
  const bool is_floating =
      variable_.datatype == Type::FLOAT32 || variable_.datatype == Type::FLOAT64;
  datatype_ =
      variable_.is_text ? static_cast<std::uint8_t>(Type::FLOAT32) : variable_.datatype;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  lowest_ = -infinity;
  highest_ = infinity;
  if (variable_.is_text ||
      (!is_floating && !file_->readText(variable_, "flag_meanings").empty()))
    return;
  factor_ = first("scale_factor", 1.0);
  offset_ = first("add_offset", 0.0);
  for (const char* const attribute : {"_FillValue", "missing_value"})
    for (const double number : file_->readNumbers(variable_, attribute))
      missing_.push_back(number);
  const auto range = file_->readNumbers(variable_, "valid_range");
  lowest_ = range.size() == 2 ? range[0] : first("valid_min", -infinity);
  highest_ = range.size() == 2 ? range[1] : first("valid_max", infinity);
  const bool is_packed = factor_ != 1.0 || offset_ != 0.0;
  const bool has_gaps =
      !missing_.empty() || std::isfinite(lowest_) || std::isfinite(highest_);
  if (is_packed || (has_gaps && !is_floating))
    datatype_ = Type::FLOAT64;
}

void
SampleVariable::unpack(std::size_t count, double* numbers) const
{
  for (std::size_t i = 0; i < count; ++i) {
    double& number = numbers[i];
    if (variable_.is_text)
      number = number >= '0' && number <= '9'
                   ? number - '0'
                   : std::numeric_limits<double>::quiet_NaN();
    else if (std::find(missing_.begin(), missing_.end(), number) != missing_.end() ||
             !(number >= lowest_ && number <= highest_))
      number = std::numeric_limits<double>::quiet_NaN();
    else
      number = number * factor_ + offset_;
  }
}

void
SampleVariable::read(std::uint64_t first, std::size_t count, double* numbers) const
{
  if (!is_held_) {
    file_->read(variable_, first, count, numbers);
    return unpack(count, numbers);
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t place = 0;
    for (const Axis& axis : axes_)
      place += axis.stride * (axis.instances ? (*axis.instances)[first + i]
                                             : (first + i) / axis.below % axis.size);
    numbers[i] = held_[place];
  }
}

SampleSpace::SampleSpace(const std::shared_ptr<const NetcdfFile>& file,
                         const PlaceVariables& places)
    : file_(file)
    , instances_(std::make_shared<std::map<int, std::vector<std::uint64_t>>>())
{
  findInstances();
  findDimensions(places);
}

void
SampleSpace::findInstances()
{
  const auto dimension_of = [&](const NetcdfVariable& variable, const char* attribute) {
    const std::string name = file_->readText(variable, attribute);
    for (const NetcdfVariable& other : file_->getVariables())
      for (const int dimension : other.dimensions)
        if (!name.empty() && file_->nameOf(dimension) == name)
          return dimension;
    return -1;
  };
  for (const NetcdfVariable& variable : file_->getVariables()) {
    if (variable.dimensions.size() != 1 || variable.is_text)
      continue;
    const int own = variable.dimensions[0];
    std::vector<double> numbers(file_->sizeOf(variable));
    const int samples = dimension_of(variable, "sample_dimension"),
              profiles = dimension_of(variable, "instance_dimension");
    if (samples < 0 && profiles < 0)
      continue;
    file_->read(variable, 0, numbers.size(), numbers.data());
    std::vector<std::uint64_t> list;
    const std::uint64_t size = file_->sizeOf(samples >= 0 ? samples : own);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (samples < 0)
        list.push_back(static_cast<std::uint64_t>(std::max(numbers[i], 0.0)));
      else if (numbers[i] >= 0.0 &&
               numbers[i] <= static_cast<double>(size - list.size()))
        list.insert(list.end(), static_cast<std::size_t>(numbers[i]), i);
    }
    const int instance = samples >= 0 ? own : profiles;
    const std::uint64_t count = file_->sizeOf(instance);
    if (list.size() != size || std::any_of(list.begin(), list.end(), [&](auto index) {
          return index >= count;
        }))
      throwUnreadable(file_->getPath(),
                      "it is damaged: " + quoteText(variable.name) +
                          " does not tell which samples belong together");
    samples_of_[instance] = samples >= 0 ? samples : own;
    (*instances_)[instance] = std::move(list);
  }
}

void
SampleSpace::findDimensions(const PlaceVariables& places)
{
  const auto add = [&](const NetcdfVariable& variable) {
    for (const int dimension : variable.dimensions) {
      const auto found = samples_of_.find(dimension);
      const int own = found == samples_of_.end() ? dimension : found->second;
      if (std::find(dimensions_.begin(), dimensions_.end(), own) == dimensions_.end())
        dimensions_.push_back(own);
    }
  };
  // Those of the largest variable that has all the dimensions of places come first, in
  // its order, so that it is read from front to back.
  for (const NetcdfVariable* place : places.axes)
    if (place)
      add(*place);
  const std::vector<int> of_places = dimensions_;
  const NetcdfVariable* largest = nullptr;
  for (const NetcdfVariable& variable : file_->getVariables()) {
    const auto has = [&](int dimension) {
      return std::find(variable.dimensions.begin(),
                       variable.dimensions.end(),
                       dimension) != variable.dimensions.end();
    };
    if (!variable.is_text && std::all_of(of_places.begin(), of_places.end(), has) &&
        (!largest || file_->sizeOf(variable) > file_->sizeOf(*largest)))
      largest = &variable;
  }
  if (largest)
    dimensions_ = largest->dimensions;
  NetcdfVariable all;
  all.name = "the samples";
  all.dimensions = dimensions_;
  size_ = file_->sizeOf(all);
  const bool is_ragged = dimensions_.size() == 1;
  for (auto instance = instances_->begin(); instance != instances_->end();)
    instance = is_ragged && samples_of_[instance->first] == dimensions_[0]
                   ? std::next(instance)
                   : instances_->erase(instance);
}

bool
SampleSpace::spans(const NetcdfVariable& variable) const
{
  return !variable.dimensions.empty() &&
         std::all_of(variable.dimensions.begin(),
                     variable.dimensions.end(),
                     [&](int dimension) {
                       return instances_->count(dimension) > 0 ||
                              std::find(dimensions_.begin(),
                                        dimensions_.end(),
                                        dimension) != dimensions_.end();
                     });
}

SampleVariable
SampleSpace::open(const NetcdfVariable& variable) const
{
  SampleVariable result;
  result.file_ = file_;
  result.variable_ = variable;
  result.keep_ = instances_;
  result.findPacking();
  if (variable.dimensions == dimensions_)
    return result;
  std::uint64_t stride = 1;
  for (std::size_t i = variable.dimensions.size(); i-- > 0;) {
    const int dimension = variable.dimensions[i];
    SampleVariable::Axis axis;
    axis.stride = stride;
    stride *= file_->sizeOf(dimension);
    const auto instance = instances_->find(dimension);
    if (instance != instances_->end())
      axis.instances = &instance->second;
    else
      for (std::size_t j = dimensions_.size(); dimensions_[--j] != dimension;)
        axis.below *= file_->sizeOf(dimensions_[j]);
    axis.size = file_->sizeOf(dimension);
    result.axes_.push_back(axis);
  }
  result.is_held_ = true;
  result.held_.resize(file_->sizeOf(variable));
  file_->read(variable, 0, result.held_.size(), result.held_.data());
  result.unpack(result.held_.size(), result.held_.data());
  return result;
}

double
AxisMap::apply(double number) const
{
  const double difference = number - origin;
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
