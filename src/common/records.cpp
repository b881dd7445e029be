// SPDX-License-Identifier: BSD-3-Clause
// From records as they lie in files to datasets.
#include "common/records.h"

#include "common/large_array.h"
#include "common/merged_positions.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace pcl_uvol {
namespace {

using Type = pcl::PCLPointField;
constexpr std::array<const char*, 3> axis_names{{"x", "y", "z"}};

/** Points with x, y, z in front and the others packed behind. */
struct PackedLayout {
  Fields fields;
  std::size_t step;
  std::vector<ByteRun> runs; ///< to it
};

PackedLayout
packedLayout(const Fields& fields, bool with_xyz)
{
  PackedLayout packed;
  const auto copy = [&packed](const pcl::PCLPointField& field) {
    const auto& last = packed.fields.back();
    appendRun(packed.runs, {field.offset, last.offset, fieldBytes(last)});
  };
  for (const char* const axis : axis_names) {
    appendField(packed.fields, axis, Type::FLOAT32);
    if (with_xyz)
      copy(*findField(fields, axis));
  }
  for (const auto& field : fields) {
    if (isPadding(field) || axisOf(field.name) >= 0)
      continue;
    appendField(packed.fields, field.name, field.datatype, std::max(field.count, 1u));
    copy(field);
  }
  packed.step = (recordBytes(packed.fields) + 3) / 4 * 4;
  return packed;
}

void
copyRuns(const std::vector<ByteRun>& runs, const std::uint8_t* from, std::uint8_t* to)
{
  for (const ByteRun& run : runs)
    std::memcpy(to + run.to, from + run.from, run.bytes);
}

/** Names that differ, empty for padding. */
Fields
namedFields(Fields fields, std::vector<Message>& notes)
{
  std::vector<std::string> names;
  for (const auto& field : fields)
    names.push_back(isPadding(field) ? std::string() : field.name);
  makeUnique(names);
  constexpr std::size_t most_notes = 10;
  std::size_t renamed = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != fields[i].name && !names[i].empty())
      if (++renamed <= most_notes)
        notes.push_back({"repeated_field",
                         {{"field", shortenText(fields[i].name)},
                          {"name", shortenText(names[i])}}});
    fields[i].name = names[i];
  }
  if (renamed > most_notes)
    notes.push_back({"more_repeated_fields", {{"fields", renamed - most_notes}}});
  return fields;
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
appendRun(std::vector<ByteRun>& runs, const ByteRun& run)
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

void
checkSize(std::uint64_t count, std::uint64_t step)
{
  if (count > most_points || step > most_points)
    throw InvalidArgument("records_beyond_numbers",
                          {{"points", count}, {"bytes", step}});
}

pcl::PCLPointCloud2
makeRecords(Fields fields, std::uint64_t count)
{
  checkSize(count, recordBytes(fields));
  pcl::PCLPointCloud2 records;
  records.fields = std::move(fields);
  records.point_step = static_cast<pcl::uindex_t>(recordBytes(records.fields));
  resizePoints(records, static_cast<std::size_t>(count));
  return records;
}

RecordLayout::RecordLayout(const RecordInfo& info, std::size_t step)
    : record_step_(step)
    , point_bytes_(0)
{
  for (const char* const axis : axis_names) {
    const auto* const field = findField(info.fields, axis);
    if (!field || field->count > 1)
      throw InvalidArgument("no_coordinate_field",
                            {{"axis", axis}, {"fields", describeFields(info.fields)}});
  }
  header_.notes = info.notes;
  header_.has_coordinates = info.has_coordinates;
  header_.box = info.box;
  const Fields fields = namedFields(info.fields, header_.notes);
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (const auto* const names =
            findLabels(info.fields, info.labels, info.fields[i].name))
      header_.labels.emplace(fields[i].name, *names);
  bool doubles = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& field = *findField(fields, axis_names[axis]);
    axes_[axis] = {field.offset, field.datatype};
    floats_ = floats_ && field.datatype == Type::FLOAT32;
    doubles = doubles || field.datatype == Type::FLOAT64;
  }
  header_.double_coordinates = info.double_coordinates.value_or(doubles);
  header_.origin = info.origin.value_or(header_.origin);
  needs_origin_ = !floats_ && !info.origin;
  is_global_ = info.is_global;
  PackedLayout packed = packedLayout(fields, floats_);
  runs_ = std::move(packed.runs);
  point_bytes_ = recordBytes(packed.fields);
  header_.cloud.fields = std::move(packed.fields);
  header_.cloud.point_step = static_cast<pcl::uindex_t>(packed.step);
  resizePoints(header_.cloud, 0);
}

bool
RecordLayout::isIdentity() const
{
  const std::size_t step = header_.cloud.point_step;
  return floats_ && step == record_step_ && runs_.size() == 1 && runs_[0].from == 0 &&
         runs_[0].bytes == step;
}

void
RecordLayout::setOrigin(const CoordinateRange& range)
{
  std::vector<Message> of_degrees; // what the map rounds counts
  header_.origin = findOrigin(range, is_global_ ? of_degrees : header_.notes);
  needs_origin_ = false;
}

void
RecordLayout::addTo(CoordinateRange& range,
                    const std::uint8_t* records,
                    std::size_t count) const
{
  for (std::size_t i = 0; i < count; ++i, records += record_step_)
    range.add({axes_[0].read(records), axes_[1].read(records), axes_[2].read(records)});
}

void
RecordLayout::removeNonPlaces(std::size_t count, std::uint8_t* points) const
{
  const std::size_t step = header_.cloud.point_step;
  for (std::size_t i = 0; i < count; ++i, points += step)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float coordinate;
      std::memcpy(&coordinate, points + axis * sizeof(coordinate), sizeof(coordinate));
      if (std::abs(coordinate) == std::numeric_limits<float>::max())
        putCoordinate(placeOrNaN(static_cast<double>(coordinate)), axis, points);
    }
}

void
RecordLayout::convert(const std::uint8_t* records,
                      std::size_t count,
                      std::uint8_t* points) const
{
  const std::size_t step = header_.cloud.point_step;
  for (std::size_t i = 0; i < count; ++i, records += record_step_, points += step) {
    copyRuns(runs_, records, points);
    for (std::size_t axis = 0; axis < 3 && !floats_; ++axis)
      putCoordinate(
          placeOrNaN(axes_[axis].read(records)) - header_.origin[axis], axis, points);
    if (point_bytes_ < step)
      std::memset(points + point_bytes_, 0, step - point_bytes_);
    if (floats_)
      removeNonPlaces(1, points);
  }
}

std::optional<Message>
RecordLayout::describeMerging(const std::uint8_t* records, std::size_t count) const
{
  if (floats_ || is_global_)
    return std::nullopt;
  const auto position_at = [&](std::size_t i) -> std::array<double, 3> {
    const std::uint8_t* const record = records + i * record_step_;
    return {placeOrNaN(axes_[0].read(record)),
            placeOrNaN(axes_[1].read(record)),
            placeOrNaN(axes_[2].read(record))};
  };
  return describe(findMergedPositions(count, position_at, header_.origin));
}

std::array<double, 3>
findOrigin(const CoordinateRange& range, std::vector<Message>& notes)
{
  const std::array<double, 3> origin = range.findOrigin();
  for (const auto& note : {range.describeBeyond(), range.describeRounding(origin)})
    if (note)
      notes.push_back(*note);
  return origin;
}

void
resizePoints(pcl::PCLPointCloud2& cloud, std::size_t count)
{
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(count);
  cloud.row_step = static_cast<pcl::uindex_t>(count * cloud.point_step);
  resizeLarge(cloud.data, count * cloud.point_step);
}

Dataset
makeDataset(pcl::PCLPointCloud2&& records, RecordInfo info)
{
  info.fields = records.fields;
  RecordLayout layout(info, records.point_step);
  const std::size_t count = records.width;
  if (layout.needsOrigin()) {
    CoordinateRange range;
    layout.addTo(range, records.data.data(), count);
    layout.setOrigin(range);
  }
  Dataset dataset = layout.getHeader();
  dataset.cloud.header = records.header;
  if (layout.isIdentity()) {
    dataset.cloud.data = std::move(records.data);
    resizePoints(dataset.cloud, count);
    layout.removeNonPlaces(count, dataset.cloud.data.data());
    return dataset;
  }
  if (const auto merging = layout.describeMerging(records.data.data(), count))
    dataset.notes.push_back(*merging);
  resizePoints(dataset.cloud, count);
  layout.convert(records.data.data(), count, dataset.cloud.data.data());
  return dataset;
}

void
checkComplete(const pcl::PCLPointCloud2& cloud)
{
  const auto points = static_cast<std::uint64_t>(cloud.width) * cloud.height;
  if (cloud.data.size() / std::max<std::size_t>(cloud.point_step, 1) < points)
    throw InvalidArgument("cloud_incomplete", {{"points", points}});
  for (const auto& field : cloud.fields)
    if (field.offset + fieldBytes(field) > cloud.point_step)
      throw InvalidArgument("field_behind_point", {{"field", shortenText(field.name)}});
}

Fields
findNormals(const Fields& fields)
{
  Fields normals;
  for (const char* const axis : normal_names)
    if (const auto* const field = findField(fields, axis))
      if (field->count == 1 &&
          (normals.empty() || normals.front().datatype == field->datatype))
        normals.push_back(*field);
  if (normals.size() < normal_names.size() || findField(fields, "Normals"))
    normals.clear();
  return normals;
}

Fields
savedFields(const Dataset& dataset)
{
  const auto& cloud = dataset.cloud;
  checkComplete(cloud);
  const bool doubles =
      dataset.double_coordinates || dataset.origin != std::array<double, 3>{};
  Fields saved;
  for (const auto& field : cloud.fields) {
    if (isPadding(field))
      continue;
    saved.push_back(field);
    saved.back().count = std::max(field.count, 1u);
    if (axisOf(field.name) >= 0 && field.datatype == Type::FLOAT32 && doubles)
      saved.back().datatype = Type::FLOAT64;
  }
  for (const char* const axis : {"x", "y", "z"}) {
    const auto* const field = findField(cloud.fields, axis);
    if (!field || field->datatype != Type::FLOAT32)
      throw InvalidArgument("cloud_without_float_xyz",
                            {{"fields", describeFields(cloud.fields)}});
  }
  return saved;
}

pcl::PCLPointCloud2
repack(const pcl::PCLPointCloud2& cloud, bool with_xyz)
{
  PackedLayout layout = packedLayout(cloud.fields, with_xyz);
  pcl::PCLPointCloud2 packed;
  packed.header = cloud.header;
  packed.fields = std::move(layout.fields);
  packed.point_step = static_cast<pcl::uindex_t>(layout.step);
  const std::size_t count = cloud.width * cloud.height;
  resizePoints(packed, count);
  const std::uint8_t* from = cloud.data.data();
  std::uint8_t* to = packed.data.data();
  for (std::size_t i = 0; i < count; ++i, from += cloud.point_step, to += layout.step)
    copyRuns(layout.runs, from, to);
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
  std::unordered_map<std::string, std::size_t> numbers; // the last one tried
  for (auto& name : names) {
    if (name.empty() || seen.insert(name).second)
      continue;
    std::size_t& number = numbers.try_emplace(name, 1).first->second;
    std::string other;
    do
      other = name + '_' + std::to_string(++number);
    while (!taken.insert(other).second);
    name = other;
    seen.insert(name);
  }
}

Dataset
withoutCloud(const Dataset& dataset)
{
  Dataset result;
  result.origin = dataset.origin;
  result.double_coordinates = dataset.double_coordinates;
  result.box = dataset.box;
  result.labels = dataset.labels;
  return result;
}

const std::vector<std::string>*
findLabels(const Fields& fields, const LabelNames& labels, const std::string& field)
{
  const auto names = labels.find(field);
  if (names == labels.end())
    return nullptr;
  const pcl::PCLPointField* const stored = findField(fields, field);
  return stored && stored->datatype == Type::INT32 && stored->count <= 1
             ? &names->second
             : nullptr;
}

std::string
nameOfLabel(const std::vector<std::string>& names, double label)
{
  return label >= 0.0 && label < static_cast<double>(names.size())
             ? names[static_cast<std::size_t>(label)]
             : std::string();
}

Fields
listNumberFields(const Dataset& dataset)
{
  Fields numbers;
  for (const auto& field : dataset.cloud.fields)
    if (!findLabels(dataset.cloud.fields, dataset.labels, field.name))
      numbers.push_back(field);
  return numbers;
}

} // namespace pcl_uvol
