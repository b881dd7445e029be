// SPDX-License-Identifier: BSD-3-Clause
// Coordinates and fields put into datasets.
#include "common/printable.h"
#include "common/records.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>

#include <cstring>

namespace pcl_uvol {
namespace {

template <typename T>
void
replaceField(Dataset& dataset,
             const std::string& name,
             std::uint8_t datatype,
             const std::vector<T>& values)
{
  pcl::PCLPointCloud2& cloud = dataset.cloud;
  const std::size_t count = values.size();
  if (count != std::size_t{cloud.width} * cloud.height)
    throw InvalidArgument(
        "field_of_wrong_length",
        {{"field", shortenText(name)}, {"values", count}, {"points", cloud.width}});
  if (axisOf(name) >= 0)
    throw InvalidArgument("field_is_coordinate", {{"field", shortenText(name)}});
  dataset.labels.erase(name);
  // The old one becomes padding, which goes when the new one is packed.
  for (auto& field : cloud.fields)
    if (field.name == name)
      field.name = "_";
  pcl::PCLPointCloud2 packed = repack(cloud, true);
  const std::size_t old_step = packed.point_step, new_step = old_step + sizeof(T);
  appendField(packed.fields, name, datatype);
  packed.fields.back().offset = static_cast<pcl::uindex_t>(old_step);
  std::vector<std::uint8_t> data(new_step * count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&data[i * new_step], &packed.data[i * old_step], old_step);
    std::memcpy(&data[i * new_step + old_step], &values[i], sizeof(T));
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
  if (xyz.size() % 3 != 0 || count > most_points)
    throw InvalidArgument("coordinates_not_in_threes", {{"coordinates", xyz.size()}});
  if (cloud.fields.empty()) {
    cloud.height = 1;
    cloud.width = static_cast<pcl::uindex_t>(count);
  }
  else if (static_cast<std::size_t>(cloud.width) * cloud.height != count)
    throw InvalidArgument("coordinates_of_other_points",
                          {{"given", count}, {"points", cloud.width * cloud.height}});
  CoordinateRange range;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    range.add({xyz[i], xyz[i + 1], xyz[i + 2]});
  dataset.origin = findOrigin(range, dataset.notes);
  cloud = repack(cloud, false);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      putCoordinate(placeOrNaN(xyz[3 * i + axis]) - dataset.origin[axis],
                    axis,
                    cloud.data.data() + i * cloud.point_step);
}

void
setField(Dataset& dataset, const std::string& name, const std::vector<float>& values)
{
  replaceField(dataset, name, pcl::PCLPointField::FLOAT32, values);
}

void
setField(Dataset& dataset, const std::string& name, const std::vector<double>& values)
{
  replaceField(dataset, name, pcl::PCLPointField::FLOAT64, values);
}

void
setField(Dataset& dataset,
         const std::string& name,
         const std::vector<std::int32_t>& values)
{
  replaceField(dataset, name, pcl::PCLPointField::INT32, values);
}

} // namespace pcl_uvol
