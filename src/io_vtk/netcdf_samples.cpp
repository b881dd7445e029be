// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/netcdf_samples.h"

#include "common/printable.h"
#include "io/files.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace pcl_uvol {
namespace io {

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
      !missing_.empty() || lowest_ != -infinity || highest_ != infinity;
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
                         const std::vector<NetcdfVariable>& places)
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
        if (!name.empty() && file_->readName(dimension) == name)
          return dimension;
    return -1;
  };
  const auto size_of = [&](int dimension) { // held against the bytes of the file
    NetcdfVariable along;
    along.name = file_->readName(dimension);
    along.dimensions = {dimension};
    return file_->countNumbers(along);
  };
  for (const NetcdfVariable& variable : file_->getVariables()) {
    if (variable.dimensions.size() != 1 || variable.is_text)
      continue;
    const int own = variable.dimensions[0];
    std::vector<double> numbers(file_->countNumbers(variable));
    const int samples = dimension_of(variable, "sample_dimension"),
              profiles = dimension_of(variable, "instance_dimension");
    if (samples < 0 && profiles < 0)
      continue;
    file_->read(variable, 0, numbers.size(), numbers.data());
    std::vector<std::uint64_t> list;
    const int instance = samples >= 0 ? own : profiles;
    const std::uint64_t size = size_of(samples >= 0 ? samples : own),
                        count = size_of(instance);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (samples < 0)
        list.push_back(numbers[i] < static_cast<double>(count)
                           ? static_cast<std::uint64_t>(std::max(numbers[i], 0.0))
                           : count);
      else if (numbers[i] >= 0.0 &&
               numbers[i] <= static_cast<double>(size - list.size()))
        list.insert(list.end(), static_cast<std::size_t>(numbers[i]), i);
    }
    if (list.size() != size || std::any_of(list.begin(), list.end(), [&](auto index) {
          return index >= count;
        }))
      throwUnreadable(file_->getPath(),
                      {"invalid_part",
                       "the list " + quoteText(variable.name) +
                           " of samples that belong together"});
    samples_of_[instance] = samples >= 0 ? samples : own;
    (*instances_)[instance] = std::move(list);
  }
}

void
SampleSpace::findDimensions(const std::vector<NetcdfVariable>& places)
{
  bool has_instances = false;
  const auto add = [&](const NetcdfVariable& variable, bool by_instances) {
    for (const int dimension : variable.dimensions) {
      const auto found = samples_of_.find(dimension);
      const bool is_mapped = by_instances && found != samples_of_.end();
      has_instances = has_instances || is_mapped;
      const int own = is_mapped ? found->second : dimension;
      if (std::find(dimensions_.begin(), dimensions_.end(), own) == dimensions_.end())
        dimensions_.push_back(own);
    }
  };
  // Those of the largest variable that has all the dimensions of places come first, in
  // its order, so that it is read from front to back; but rows of many lengths lie
  // along one dimension.
  for (const NetcdfVariable& place : places)
    add(place, true);
  const bool is_by_rows = has_instances && dimensions_.size() == 1;
  if (has_instances && !is_by_rows) {
    dimensions_.clear();
    instances_->clear();
    for (const NetcdfVariable& place : places)
      add(place, false);
  }
  const std::vector<int> of_places = dimensions_;
  const NetcdfVariable* largest = nullptr;
  for (const NetcdfVariable& variable : file_->getVariables()) {
    const auto has = [&](int dimension) {
      return std::find(variable.dimensions.begin(),
                       variable.dimensions.end(),
                       dimension) != variable.dimensions.end();
    };
    if (!variable.is_text && std::all_of(of_places.begin(), of_places.end(), has) &&
        (!largest || file_->countNumbers(variable) > file_->countNumbers(*largest)))
      largest = &variable;
  }
  if (largest && !is_by_rows)
    dimensions_ = largest->dimensions;
  NetcdfVariable all;
  all.name = "the samples";
  all.dimensions = dimensions_;
  size_ = file_->countNumbers(all);
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
  result.instances_ = instances_;
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
  result.held_.resize(file_->countNumbers(variable));
  file_->read(variable, 0, result.held_.size(), result.held_.data());
  result.unpack(result.held_.size(), result.held_.data());
  return result;
}

} // namespace io
} // namespace pcl_uvol
