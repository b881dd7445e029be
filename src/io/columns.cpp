// SPDX-License-Identifier: BSD-3-Clause
// From datasets to the numbers of files: as text, as bytes.
#include "io/columns.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/files.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

bool
isWidened(const Column& column)
{
  return column.stored != column.datatype;
}

/** The datatype in the point of a field in the file: packed colours may be other bits
 * there, but only numbers become a float64. */
std::uint8_t
storedType(const Dataset& dataset, const pcl::PCLPointField& field)
{
  if (field.datatype != Type::FLOAT64)
    return field.datatype;
  for (const auto& stored : dataset.cloud.fields)
    if (stored.offset == field.offset && !isPadding(stored))
      return stored.datatype;
  return field.datatype;
}

/** Puts the numbers of a point one behind the other. */
class RecordPacker {
public:
  explicit RecordPacker(const std::vector<Column>& columns);

  /** True if points of that step are records already. */
  bool
  isIdentity(std::size_t point_step) const
  {
    return widened_.empty() && runs_.size() == 1 && runs_[0].from == 0 &&
           runs_[0].bytes == point_step;
  }

  std::size_t
  size() const
  {
    return size_;
  }

  void
  pack(const std::uint8_t* point, std::uint8_t* record) const;

private:
  struct Widened {
    FieldComponent from;
    std::size_t to;
    double addend;
  };
  std::vector<ByteRun> runs_;
  std::vector<Widened> widened_;
  std::size_t size_ = 0;
};

RecordPacker::RecordPacker(const std::vector<Column>& columns)
{
  for (const auto& column : columns) {
    const std::size_t bytes = datatypeSize(column.datatype);
    if (isWidened(column))
      widened_.push_back({{column.offset, column.stored}, size_, column.addend});
    else
      appendRun(runs_, {column.offset, size_, bytes});
    size_ += bytes;
  }
}

void
RecordPacker::pack(const std::uint8_t* point, std::uint8_t* record) const
{
  for (const ByteRun& run : runs_)
    std::memcpy(record + run.to, point + run.from, run.bytes);
  for (const Widened& wide : widened_) {
    const double value = wide.addend + wide.from.read(point);
    std::memcpy(record + wide.to, &value, sizeof(value));
  }
}

} // namespace

std::vector<Column>
findColumns(const Dataset& dataset, const Fields& fields)
{
  std::vector<Column> columns;
  for (const auto& field : fields) {
    const int axis = axisOf(field.name);
    const std::uint8_t stored = storedType(dataset, field);
    for (std::size_t i = 0; i < field.count; ++i)
      columns.push_back(
          {field.count > 1 ? field.name + '_' + std::to_string(i) : field.name,
           field.datatype,
           field.offset + i * datatypeSize(stored),
           stored,
           axis >= 0 ? dataset.origin[static_cast<std::size_t>(axis)] : 0.0,
           findLabels(dataset.cloud.fields, dataset.labels, field.name)});
  }
  return columns;
}

void
makeWords(std::vector<std::string>& names, std::vector<std::string>& comments)
{
  const std::vector<std::string> originals = names;
  for (auto& name : names) {
    for (char& c : name)
      if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f')
        c = '_';
    if (name == "_") // which PCL takes for bytes without meaning
      name = "field";
  }
  makeUnique(names);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] != originals[i])
      comments.push_back("field " + names[i] + " is '" + printable(originals[i]) + "'");
}

void
appendNumber(std::string& text, const Column& column, const std::uint8_t* point)
{
  const std::uint8_t* const bytes = point + column.offset;
  if (!isWidened(column)) {
    pcl_uvol::appendNumber(text, column.datatype, bytes);
    return;
  }
  const double value =
      column.addend + FieldComponent{column.offset, column.stored}.read(point);
  std::uint8_t wide[sizeof(value)];
  std::memcpy(wide, &value, sizeof(value));
  pcl_uvol::appendNumber(text, column.datatype, wide);
}

std::string
packRecords(const Dataset& dataset,
            const std::vector<Column>& columns,
            std::size_t first,
            std::size_t count)
{
  const RecordPacker packer(columns);
  const std::size_t step = dataset.cloud.point_step;
  std::string records(count * packer.size(), '\0');
  auto* to = reinterpret_cast<std::uint8_t*>(records.data());
  for (std::size_t i = first; i < first + count; ++i, to += packer.size())
    packer.pack(dataset.cloud.data.data() + i * step, to);
  return records;
}

void
writeRecords(OutputFile& file,
             const Dataset& dataset,
             const std::vector<Column>& columns,
             const SaveOptions& options)
{
  const auto& cloud = dataset.cloud;
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  const RecordPacker packer(columns);
  if (!options.ascii && packer.isIdentity(cloud.point_step)) {
    file.write(cloud.data.data(), count * cloud.point_step);
    return;
  }
  std::string& buffer = file.buffer();
  const std::uint8_t* point = cloud.data.data();
  WriteProgress progress(count, options);
  for (std::size_t i = 0; i < count; ++i, point += cloud.point_step) {
    if (options.ascii) {
      for (const Column& column : columns) {
        appendNumber(buffer, column, point);
        buffer += ' ';
      }
      buffer.back() = '\n';
    }
    else {
      const std::size_t start = buffer.size();
      buffer.resize(start + packer.size());
      packer.pack(point, reinterpret_cast<std::uint8_t*>(buffer.data()) + start);
    }
    file.flushFull();
    progress.advance();
  }
}

} // namespace io
} // namespace pcl_uvol
