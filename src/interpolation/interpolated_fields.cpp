// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <algorithm>
#include <cstring>

namespace pcl_uvol {

namespace {

/** A field to append: so many numbers per point. */
struct NewField {
  std::string name;
  std::uint8_t datatype;
  std::uint32_t count;
  const std::uint8_t* data;

  std::size_t
  bytes() const
  {
    return datatypeSize(datatype) * count;
  }
};

NewField
doubles(const std::string& name, std::uint32_t count, const double* data)
{
  return {name,
          pcl::PCLPointField::FLOAT64,
          count,
          reinterpret_cast<const std::uint8_t*>(data)};
}

/** A name, or the first of name_2, name_3, ... that goes with all endings without being
 * taken. */
std::string
findFreeName(const std::vector<pcl::PCLPointField>& fields,
             const std::string& name,
             const std::vector<std::string>& endings)
{
  const auto is_taken = [&](const std::string& candidate) {
    return std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
      return findField(fields, candidate + ending) != nullptr;
    });
  };
  std::string free = name;
  for (int i = 2; is_taken(free); ++i)
    free = name + '_' + std::to_string(i);
  return free;
}

} // namespace

std::vector<std::string>
appendFields(const InterpolatedFields& fields, pcl::PCLPointCloud2& points)
{
  const std::size_t count = static_cast<std::size_t>(points.width) * points.height;
  if (count != fields.size)
    throw InvalidArgument("values_of_other_points",
                          {{"values", fields.size}, {"points", count}});
  std::vector<NewField> added;
  for (std::size_t f = 0; f < fields.names.size(); ++f) {
    const std::string name =
        findFreeName(points.fields, fields.names[f], {"", "_error", "_gradient"});
    added.push_back(doubles(name, 1, fields.values.data() + f * count));
    if (!fields.errors.empty())
      added.push_back(doubles(name + "_error", 1, fields.errors.data() + f * count));
    if (!fields.gradients.empty())
      added.push_back(
          doubles(name + "_gradient", 3, fields.gradients.data() + 3 * f * count));
  }
  added.push_back({findFreeName(points.fields, "support", {""}),
                   pcl::PCLPointField::UINT8,
                   1,
                   reinterpret_cast<const std::uint8_t*>(fields.support.data())});

  const std::size_t old_step = points.point_step;
  std::size_t step = old_step;
  for (const NewField& field : added)
    step += field.bytes();
  checkMemoryOf("Appending fields",
                count,
                static_cast<double>(old_step + step) * static_cast<double>(count));
  pcl::PCLPointCloud2 joined = points;
  step = old_step;
  for (const NewField& field : added) {
    pcl::PCLPointField described;
    described.name = field.name;
    described.offset = static_cast<std::uint32_t>(step);
    described.datatype = field.datatype;
    described.count = field.count;
    joined.fields.push_back(described);
    step += field.bytes();
  }
  step = (step + 3) / 4 * 4; // see CloudView
  joined.point_step = static_cast<std::uint32_t>(step);
  joined.row_step = joined.point_step * joined.width;
  joined.data.assign(step * count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint8_t* target = joined.data.data() + i * step;
    std::memcpy(target, points.data.data() + i * old_step, old_step);
    target += old_step;
    for (const NewField& field : added) {
      std::memcpy(target, field.data + i * field.bytes(), field.bytes());
      target += field.bytes();
    }
  }
  points = std::move(joined);
  std::vector<std::string> names;
  for (const NewField& field : added)
    names.push_back(field.name);
  return names;
}

} // namespace pcl_uvol
