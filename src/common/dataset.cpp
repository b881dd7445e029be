// SPDX-License-Identifier: BSD-3-Clause
// The origin of large coordinates, and fields put into datasets.
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/records.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_uvol {
namespace {

/** Relative to the extent: what float may lose of a coordinate. */
constexpr double coordinate_tolerance = 1e-7;
/** An axis thinner than this part of the cloud is flat, and noise across it no extent.
 */
constexpr double flat_extent = 0x1p-13;
/** The extent of a single place, as part of its largest coordinate. */
constexpr double place_extent = 0x1p-20;

/** What the coordinates of one axis are like. */
struct AxisRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double float_error = 0.0; ///< largest distance from a coordinate to its float

  double
  extent() const
  {
    return high > low ? high - low : 0.0;
  }

  double
  largest() const
  {
    return high >= low ? std::max(std::abs(low), std::abs(high)) : 0.0;
  }
};

AxisRange
rangeOf(const std::vector<double>& xyz, std::size_t axis)
{
  AxisRange range;
  for (std::size_t i = axis; i < xyz.size(); i += 3) {
    if (!std::isfinite(xyz[i]))
      continue;
    range.low = std::min(range.low, xyz[i]);
    range.high = std::max(range.high, xyz[i]);
    const double error =
        std::abs(static_cast<double>(static_cast<float>(xyz[i])) - xyz[i]);
    range.float_error = std::max(range.float_error, error);
  }
  if (range.largest() > std::numeric_limits<float>::max())
    throw InvalidArgument("A coordinate is larger than float can hold (3.4e38): scale "
                          "the coordinates down.");
  return range;
}

std::array<double, 3>
originOf(const std::vector<double>& xyz)
{
  std::array<AxisRange, 3> ranges;
  double extent = 0.0, largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ranges[axis] = rangeOf(xyz, axis);
    extent = std::max(extent, ranges[axis].extent());
    largest = std::max(largest, ranges[axis].largest());
  }
  if (extent == 0.0)
    extent = place_extent * largest;
  std::array<double, 3> origin{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisRange& range = ranges[axis];
    const double scale =
        range.extent() > flat_extent * extent ? range.extent() : extent;
    if (range.float_error <= coordinate_tolerance * scale)
      continue;
    const double step = std::exp2(std::floor(std::log2(scale)));
    origin[axis] = std::round(0.5 * (range.low + range.high) / step) * step;
  }
  return origin;
}

/** \param values four bytes each */
void
replaceField(Dataset& dataset,
             const std::string& name,
             std::uint8_t datatype,
             const void* values,
             std::size_t count)
{
  pcl::PCLPointCloud2& cloud = dataset.cloud;
  if (count != std::size_t{cloud.width} * cloud.height)
    throw InvalidArgument("The field '" + name + "' has " + std::to_string(count) +
                          " values for " + std::to_string(cloud.width) + " points.");
  if (axisOf(name) >= 0)
    throw InvalidArgument("The field '" + name + "' is a coordinate.");
  // The old one becomes padding, which goes when the new one is packed.
  for (auto& field : cloud.fields)
    if (field.name == name)
      field.name = "_";
  pcl::PCLPointCloud2 packed = repack(cloud, true);
  const std::size_t old_step = packed.point_step, new_step = old_step + 4;
  appendField(packed.fields, name, datatype);
  packed.fields.back().offset = static_cast<pcl::uindex_t>(old_step);
  std::vector<std::uint8_t> data(new_step * count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&data[i * new_step], &packed.data[i * old_step], old_step);
    std::memcpy(&data[i * new_step + old_step],
                static_cast<const std::uint8_t*>(values) + 4 * i,
                4);
  }
  packed.data = std::move(data);
  packed.point_step = static_cast<pcl::uindex_t>(new_step);
  packed.row_step = static_cast<pcl::uindex_t>(new_step * count);
  cloud = std::move(packed);
}

} // namespace

void
setCoordinates(Dataset& dataset, const std::vector<double>& xyz)
{
  auto& cloud = dataset.cloud;
  const std::size_t count = xyz.size() / 3;
  if (xyz.size() % 3 != 0 || count > std::numeric_limits<pcl::uindex_t>::max())
    throw InvalidArgument("There are " + std::to_string(xyz.size()) +
                          " coordinates, which are not three for each point.");
  if (cloud.fields.empty()) {
    cloud.height = 1;
    cloud.width = static_cast<pcl::uindex_t>(count);
  }
  else if (static_cast<std::size_t>(cloud.width) * cloud.height != count)
    throw InvalidArgument("There are coordinates of " + std::to_string(count) +
                          " points for a cloud of " +
                          std::to_string(cloud.width * cloud.height) + ".");
  dataset.origin = originOf(xyz);
  cloud = repack(cloud, false);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto relative =
          static_cast<float>(xyz[3 * i + axis] - dataset.origin[axis]);
      std::memcpy(cloud.data.data() + i * cloud.point_step + axis * sizeof(float),
                  &relative,
                  sizeof(relative));
    }
}

void
setField(Dataset& dataset, const std::string& name, const std::vector<float>& values)
{
  replaceField(
      dataset, name, pcl::PCLPointField::FLOAT32, values.data(), values.size());
}

void
setField(Dataset& dataset,
         const std::string& name,
         const std::vector<std::int32_t>& values)
{
  replaceField(dataset, name, pcl::PCLPointField::INT32, values.data(), values.size());
}

} // namespace pcl_uvol
