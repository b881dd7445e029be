// SPDX-License-Identifier: BSD-3-Clause
#include "common/large_array.h"
#include "common/records.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <array>
#include <cstring>
#include <limits>
#include <string>

namespace pcl_uvol {

namespace {

using Fields = std::vector<pcl::PCLPointField>;
using Axes = std::array<const pcl::PCLPointField*, 3>;
using detail::CloudBytes;

Axes
findAxes(const Fields& fields)
{
  const Axes axes = {
      findField(fields, "x"), findField(fields, "y"), findField(fields, "z")};
  for (const auto* const axis : axes)
    if (axis == nullptr || axis->count > 1)
      throw InvalidArgument("cloud_without_xyz", {{"fields", describeFields(fields)}});
  return axes;
}

void
checkLayout(const CloudBytes& bytes, const Fields& fields)
{
  const std::size_t count = bytes.width * bytes.height;
  if (count > static_cast<std::size_t>(std::numeric_limits<pcl::index_t>::max()))
    throw InvalidArgument("cloud_beyond_numbers", {{"points", count}});
  if (bytes.is_big_endian)
    throw InvalidArgument("cloud_big_endian", {});
  const std::size_t padded = bytes.height > 1 ? bytes.row_step * (bytes.height - 1) : 0;
  if (count > 0 && bytes.size < padded + bytes.width * bytes.point_step)
    throw InvalidArgument("cloud_too_short",
                          {{"bytes", bytes.size}, {"points", count}});
  for (const pcl::PCLPointField& field : fields) {
    if (isPadding(field))
      continue;
    const std::size_t size = datatypeSize(field.datatype); // throws for none
    if (field.offset + size * std::max<std::size_t>(field.count, 1) > bytes.point_step)
      throw InvalidArgument("field_beyond_point",
                            {{"field", field.name}, {"bytes", bytes.point_step}});
  }
}

bool
hasAlignedFloats(const Axes& axes, const CloudBytes& bytes)
{
  for (std::size_t i = 0; i < 3; ++i)
    if (axes[i]->datatype != pcl::PCLPointField::FLOAT32 ||
        axes[i]->offset != axes[0]->offset + i * sizeof(float))
      return false;
  return axes[0]->offset % alignof(float) == 0 &&
         bytes.point_step % alignof(float) == 0;
}

/** x, y, z as floats in front of all bytes of a point. */
CloudView
copyPoints(const CloudBytes& bytes, const Fields& fields, const Axes& axes)
{
  constexpr std::size_t xyz_bytes = 3 * sizeof(float);
  CloudView view;
  view.count = bytes.width * bytes.height;
  view.point_step = (xyz_bytes + bytes.point_step + alignof(float) - 1) /
                    alignof(float) * alignof(float);
  auto copy = std::make_shared<std::vector<std::uint8_t>>(view.count * view.point_step);
  for (std::size_t i = 0; i < view.count; ++i) {
    const std::uint8_t* const from = bytes.data + i / bytes.width * bytes.row_step +
                                     i % bytes.width * bytes.point_step;
    std::uint8_t* const to = copy->data() + i * view.point_step;
    float xyz[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
      xyz[axis] = static_cast<float>(
          FieldComponent{axes[axis]->offset, axes[axis]->datatype}.read(from));
    std::memcpy(to, xyz, xyz_bytes);
    std::memcpy(to + xyz_bytes, from, bytes.point_step);
  }
  view.data = copy->data();
  view.copy = std::move(copy);
  view.fields = fields;
  for (pcl::PCLPointField& field : view.fields) {
    field.offset += static_cast<pcl::uindex_t>(xyz_bytes);
    if (const int axis = axisOf(field.name); axis >= 0) {
      field.offset = static_cast<pcl::uindex_t>(axis) * sizeof(float);
      field.datatype = pcl::PCLPointField::FLOAT32;
    }
  }
  return view;
}

} // namespace

CloudView
detail::makeView(const CloudBytes& bytes, const Fields& fields)
{
  const Axes axes = findAxes(fields);
  checkLayout(bytes, fields);
  const bool is_padded =
      bytes.height > 1 && bytes.row_step != bytes.width * bytes.point_step;
  if (is_padded || !hasAlignedFloats(axes, bytes))
    return copyPoints(bytes, fields, axes);
  CloudView view;
  view.data = bytes.data;
  view.count = bytes.width * bytes.height;
  view.point_step = bytes.point_step;
  view.xyz_offset = axes[0]->offset;
  view.fields = fields;
  return view;
}

void
detail::checkIndices(const pcl::Indices& indices, std::size_t count, const char* stage)
{
  if (count == 0)
    throw InvalidArgument("empty_cloud", {{"stage", stage}});
  if (indices.empty())
    throw InvalidArgument("no_indices", {{"stage", stage}});
  for (const pcl::index_t index : indices)
    if (index < 0 || static_cast<std::size_t>(index) >= count)
      throw InvalidArgument("index_beyond_cloud",
                            {{"stage", stage}, {"index", index}, {"points", count}});
}

pcl::IndicesPtr
detail::makeIndices(std::size_t count)
{
  auto indices = std::make_shared<pcl::Indices>();
  reserveLarge(*indices, count);
  return indices;
}

CloudView
viewOf(const pcl::PCLPointCloud2& cloud)
{
  // Clouds that are made by hand often have no row_step.
  const std::size_t packed_row = std::size_t(cloud.width) * cloud.point_step;
  return detail::makeView({cloud.data.data(),
                           cloud.data.size(),
                           cloud.width,
                           cloud.height,
                           cloud.point_step,
                           cloud.row_step == 0 ? packed_row : cloud.row_step,
                           cloud.is_bigendian != 0},
                          cloud.fields);
}

} // namespace pcl_uvol
