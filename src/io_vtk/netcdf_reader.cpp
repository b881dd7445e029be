// SPDX-License-Identifier: BSD-3-Clause
// Samples in files of NetCDF that follow the CF conventions: profiles, trajectories and
// rectilinear grids. All of these are variables over some of the dimensions of the
// samples; each number counts for all samples that have its indices.
#include "io/column_source.h"
#include "io/formats.h"
#include "io_vtk/netcdf_file.h"
#include "io_vtk/netcdf_places.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

template <typename T>
void
putAll(const std::vector<double>& numbers, std::uint8_t* tuples)
{
  for (const double number : numbers) {
    const auto value = static_cast<T>(number);
    std::memcpy(tuples, &value, sizeof(T));
    tuples += sizeof(T);
  }
}

void
putNumbers(std::uint8_t datatype,
           const std::vector<double>& numbers,
           std::uint8_t* tuples)
{
  switch (datatype) {
  case Type::INT8:
    return putAll<std::int8_t>(numbers, tuples);
  case Type::UINT8:
    return putAll<std::uint8_t>(numbers, tuples);
  case Type::INT16:
    return putAll<std::int16_t>(numbers, tuples);
  case Type::UINT16:
    return putAll<std::uint16_t>(numbers, tuples);
  case Type::INT32:
    return putAll<std::int32_t>(numbers, tuples);
  case Type::UINT32:
    return putAll<std::uint32_t>(numbers, tuples);
  case Type::FLOAT32:
    return putAll<float>(numbers, tuples);
  default:
    return putAll<double>(numbers, tuples);
  }
}

/** A variable, for all samples. */
class VariableColumn : public FileColumn {
public:
  explicit VariableColumn(SampleVariable variable)
      : variable_(std::move(variable))
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    numbers_.resize(count);
    variable_.read(first, count, numbers_.data());
    putNumbers(variable_.getDatatype(), numbers_, tuples);
  }

  std::uint64_t
  heldBytes() const override
  {
    return variable_.heldBytes();
  }

private:
  SampleVariable variable_;
  std::vector<double> numbers_;
};

/** A coordinate: a variable less an origin, times a factor. */
class CoordinateColumn : public FileColumn {
public:
  CoordinateColumn(SampleVariable variable, const AxisMap& map)
      : variable_(std::move(variable))
      , map_(map)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    numbers_.resize(count);
    variable_.read(first, count, numbers_.data());
    for (double& number : numbers_)
      number = map_.apply(number);
    putNumbers(Type::FLOAT64, numbers_, tuples);
  }

  std::uint64_t
  heldBytes() const override
  {
    return variable_.heldBytes();
  }

private:
  SampleVariable variable_;
  AxisMap map_;
  std::vector<double> numbers_;
};

/** Takes of texts only those whose letters are digits, as flags of quality are. */
bool
isOfUse(const SampleSpace& space, const NetcdfVariable& variable)
{
  if (!space.spans(variable))
    return false;
  if (!variable.is_text)
    return true;
  std::vector<double> letters(
      std::min<std::uint64_t>(space.getFile().countNumbers(variable), 4096));
  space.getFile().read(variable, 0, letters.size(), letters.data());
  return std::any_of(letters.begin(), letters.end(), [](double letter) {
    return letter >= '0' && letter <= '9';
  });
}

} // namespace

std::unique_ptr<RecordSource>
openNetcdf(const std::string& path, const LoadOptions& options)
{
  const auto file = std::make_shared<const NetcdfFile>(path);
  const PlaceVariables places = findPlaces(*file);
  const SampleSpace space(file, places.list());
  std::vector<Message> notes;
  const PlaceMaps maps =
      mapPlaces(space, places, options.map.value_or(MapProjection()), notes);
  std::vector<NamedColumn> columns;
  constexpr const char* axes[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::unique_ptr<FileColumn> column = makeConstant(0.0);
    if (const NetcdfVariable* const variable = places.axes[axis])
      column =
          std::make_unique<CoordinateColumn>(space.open(*variable), maps.axes[axis]);
    columns.push_back({{axes[axis]}, Type::FLOAT64, 1, std::move(column)});
  }
  for (const NetcdfVariable& variable : file->getVariables()) {
    const bool is_axis = std::any_of(std::begin(axes), std::end(axes), [&](auto name) {
      return variable.name == name;
    });
    if (is_axis || !isOfUse(space, variable))
      continue;
    SampleVariable numbers = space.open(variable);
    const std::uint8_t datatype = numbers.getDatatype();
    columns.push_back({{variable.name},
                       datatype,
                       1,
                       std::make_unique<VariableColumn>(std::move(numbers))});
  }
  auto source = std::make_unique<ColumnSource>(
      space.size(), std::move(columns), std::move(notes));
  source->setMap(maps.projection);
  return source;
}

} // namespace io
} // namespace pcl_uvol
