// SPDX-License-Identifier: BSD-3-Clause
// From records as they lie in files to datasets.
#include "records.h"

#include "files.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/scalar_field.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <unordered_set>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;
constexpr std::array<const char*, 3> axis_names{{"x", "y", "z"}};

/** x, y, z are in front, nothing lies between fields, and points are aligned. */
bool
isPacked(const Fields& fields)
{
  std::size_t end = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto& field = fields[i];
    if (field.offset != end || isPadding(field) ||
        (i < 3 && field.name != axis_names[i]))
      return false;
    end += fieldBytes(field);
  }
  return end % alignof(float) == 0;
}

std::vector<double>
coordinatesOf(const pcl::PCLPointCloud2& records)
{
  std::array<FieldComponent, 3> axes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& field = *findField(records.fields, axis_names[axis]);
    axes[axis] = {field.offset, field.datatype};
  }
  std::vector<double> xyz;
  xyz.reserve(3 * static_cast<std::size_t>(records.width));
  const std::uint8_t* point = records.data.data();
  for (std::size_t i = 0; i < records.width; ++i, point += records.point_step)
    for (const auto& axis : axes)
      xyz.push_back(axis.read(point));
  return xyz;
}

} // namespace

int
axisOf(const std::string& name)
{
  return name.size() == 1 && name[0] >= 'x' && name[0] <= 'z' ? name[0] - 'x' : -1;
}

bool
isPadding(const pcl::PCLPointField& field)
{
  return field.name.empty() || field.name == "_";
}

void
appendRun(std::vector<Run>& runs, const Run& run)
{
  if (!runs.empty() && runs.back().from + runs.back().bytes == run.from &&
      runs.back().to + runs.back().bytes == run.to)
    runs.back().bytes += run.bytes;
  else
    runs.push_back(run);
}

std::size_t
fieldBytes(const pcl::PCLPointField& field)
{
  return datatypeSize(field.datatype) * std::max<std::size_t>(field.count, 1);
}

void
appendField(Fields& fields,
            const std::string& name,
            std::uint8_t datatype,
            std::size_t count)
{
  pcl::PCLPointField field;
  field.name = name;
  field.offset = static_cast<pcl::uindex_t>(recordBytes(fields));
  field.datatype = datatype;
  field.count = static_cast<pcl::uindex_t>(count);
  fields.push_back(field);
}

std::size_t
recordBytes(const Fields& fields)
{
  return fields.empty() ? 0 : fields.back().offset + fieldBytes(fields.back());
}

pcl::PCLPointCloud2
makeRecords(const std::string& path, Fields fields, std::uint64_t count)
{
  const std::uint64_t step = recordBytes(fields);
  constexpr std::uint64_t most = std::numeric_limits<pcl::uindex_t>::max();
  if (count > most || step > most)
    throwUnreadable(path,
                    "it has " + std::to_string(count) + " points of " +
                        std::to_string(step) + " bytes, more than PCL can number");
  pcl::PCLPointCloud2 records;
  records.fields = std::move(fields);
  records.height = 1;
  records.width = static_cast<pcl::uindex_t>(count);
  records.point_step = static_cast<pcl::uindex_t>(step);
  records.row_step = static_cast<pcl::uindex_t>(step * count);
  records.data.resize(step * count);
  return records;
}

Dataset
makeDataset(const std::string& path, pcl::PCLPointCloud2&& records)
{
  for (const char* const axis : axis_names) {
    const auto* const field = findField(records.fields, axis);
    if (!field || field->count > 1)
      throwUnreadable(path,
                      std::string("it has no scalar field ") + axis +
                          "; its fields are " + describeFields(records.fields));
  }
  Dataset dataset;
  std::vector<std::string> names;
  for (const auto& field : records.fields)
    names.push_back(isPadding(field) ? std::string() : field.name);
  makeUnique(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != records.fields[i].name && !names[i].empty())
      dataset.notes.push_back("A further field '" + records.fields[i].name +
                              "' is called '" + names[i] + "'.");
    records.fields[i].name = names[i];
  }
  bool floats = true;
  for (const char* const axis : axis_names) {
    const std::uint8_t datatype = findField(records.fields, axis)->datatype;
    floats = floats && datatype == Type::FLOAT32;
    dataset.double_coordinates |= datatype == Type::FLOAT64;
  }
  if (floats) {
    dataset.cloud =
        isPacked(records.fields) ? std::move(records) : repack(records, true);
    return dataset;
  }
  const std::vector<double> xyz = coordinatesOf(records);
  dataset.cloud = std::move(records);
  setCoordinates(dataset, xyz);
  return dataset;
}

PromisedCloud
promiseOf(const Fields& fields, std::uint64_t count, double beside)
{
  std::size_t packed = axis_names.size() * sizeof(float);
  bool floats = true;
  for (const auto& field : fields)
    if (axisOf(field.name) >= 0)
      floats = floats && field.datatype == Type::FLOAT32;
    else if (!isPadding(field))
      packed += fieldBytes(field);
  PromisedCloud cloud;
  cloud.points = count;
  cloud.point_step = (packed + alignof(float) - 1) / alignof(float) * alignof(float);
  double per_point = static_cast<double>(recordBytes(fields));
  if (!floats) // coordinates in double on their way
    per_point += axis_names.size() * sizeof(double);
  if (!floats || !isPacked(fields))
    per_point += static_cast<double>(cloud.point_step);
  const auto points = static_cast<double>(count);
  cloud.reading = {per_point * points + beside,
                   static_cast<double>(cloud.point_step) * points};
  return cloud;
}

pcl::PCLPointCloud2
repack(const pcl::PCLPointCloud2& cloud, bool with_xyz)
{
  std::vector<Run> runs;
  Fields fields;
  const auto copy = [&](const pcl::PCLPointField& field) {
    appendRun(runs, {field.offset, fields.back().offset, fieldBytes(fields.back())});
  };
  for (const char* const axis : axis_names) {
    appendField(fields, axis, Type::FLOAT32);
    if (with_xyz)
      copy(*findField(cloud.fields, axis));
  }
  for (const auto& field : cloud.fields) {
    if (isPadding(field) || axisOf(field.name) >= 0)
      continue;
    appendField(fields, field.name, field.datatype, std::max(field.count, 1u));
    copy(field);
  }
  pcl::PCLPointCloud2 packed;
  packed.header = cloud.header;
  packed.fields = std::move(fields);
  packed.height = 1;
  packed.width = cloud.width * cloud.height;
  const std::size_t count = packed.width,
                    step = (recordBytes(packed.fields) + 3) / 4 * 4;
  packed.point_step = static_cast<pcl::uindex_t>(step);
  packed.row_step = static_cast<pcl::uindex_t>(step * count);
  packed.data.resize(step * count);
  const std::uint8_t* from = cloud.data.data();
  std::uint8_t* to = packed.data.data();
  for (std::size_t i = 0; i < count; ++i, from += cloud.point_step, to += step)
    for (const Run& run : runs)
      std::memcpy(to + run.to, from + run.from, run.bytes);
  return packed;
}

void
renameFields(Fields& fields, const char* const (&from)[3], const char* const (&to)[3])
{
  for (int i = 0; i < 3; ++i) {
    const auto* const field = findField(fields, from[i]);
    if (!field || field->count > 1 || findField(fields, to[i]))
      return;
  }
  for (auto& field : fields)
    for (int i = 0; i < 3; ++i)
      if (field.name == from[i])
        field.name = to[i];
}

void
makeUnique(std::vector<std::string>& names)
{
  std::unordered_set<std::string> taken(names.begin(), names.end()), seen;
  for (auto& name : names) {
    if (name.empty() || seen.insert(name).second)
      continue;
    std::string other;
    for (int number = 2;
         !taken.insert(other = name + '_' + std::to_string(number)).second;)
      ++number;
    name = other;
    seen.insert(name);
  }
}

} // namespace io
} // namespace pcl_uvol
