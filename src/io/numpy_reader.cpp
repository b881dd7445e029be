// SPDX-License-Identifier: BSD-3-Clause
// Arrays of NumPy: .npy, and .npz, which is a zip of them (numpy.lib.format, versions 1
// to 3).
#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/column_source.h"
#include "io/formats.h"
#include "io/position_tables.h"
#include "io/zip_reader.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::uint64_t most_header_bytes = 1u << 16;

/** A field of an array: the whole array has one without a name. */
struct Member {
  std::string name;
  std::uint8_t datatype = 0;
  std::uint64_t components = 1;
  bool swapped = false;
};

struct Array {
  std::string name;
  std::vector<Member> members;
  bool is_structured = false, by_columns = false;
  std::vector<std::uint64_t> shape;
  std::uint64_t offset = 0; ///< of the numbers
  std::shared_ptr<const InputFile> file;

  std::uint64_t
  rows() const
  {
    return shape.empty() ? 1 : shape[0];
  }

  std::uint64_t
  components() const
  {
    std::uint64_t product = 1;
    for (std::size_t i = 1; i < shape.size(); ++i)
      product *= shape[i];
    return product;
  }
};

/** Takes the literal of Python in a header apart. */
class NpyHeaderParser {
public:
  NpyHeaderParser(const std::string& path, std::string_view text)
      : path_(path)
      , rest_(text)
  {
  }

  void
  parse(Array& array);

private:
  bool
  take(char c)
  {
    rest_ = trimmed(rest_);
    if (rest_.empty() || rest_[0] != c)
      return false;
    rest_.remove_prefix(1);
    return true;
  }
  void
  expect(char c)
  {
    if (!take(c))
      fail();
  }
  std::string
  takeText();
  std::vector<std::uint64_t>
  takeCounts();
  Member
  takeType(const std::string& name);
  bool
  takeTruth();
  [[noreturn]] void
  fail() const
  {
    throwUnreadable(path_, {"invalid_part", "the header of an array"});
  }

  const std::string& path_;
  std::string_view rest_;
};

std::string
NpyHeaderParser::takeText()
{
  rest_ = trimmed(rest_);
  if (rest_.empty() || (rest_[0] != '\'' && rest_[0] != '"'))
    fail();
  const std::size_t end = rest_.find(rest_[0], 1);
  if (end == std::string_view::npos)
    fail();
  std::string text(rest_.substr(1, end - 1));
  rest_.remove_prefix(end + 1);
  return text;
}

std::vector<std::uint64_t>
NpyHeaderParser::takeCounts()
{
  std::vector<std::uint64_t> counts;
  expect('(');
  while (!take(')')) {
    const std::size_t end = rest_.find_first_of(",)");
    std::uint64_t count = 0;
    if (end == std::string_view::npos ||
        !parseCount(trimmed(rest_.substr(0, end)), count) || counts.size() == 32)
      fail();
    counts.push_back(count);
    rest_.remove_prefix(end);
    take(',');
  }
  return counts;
}

bool
NpyHeaderParser::takeTruth()
{
  rest_ = trimmed(rest_);
  for (const bool truth : {true, false}) {
    const std::string_view word = truth ? "True" : "False";
    if (rest_.substr(0, word.size()) == word) {
      rest_.remove_prefix(word.size());
      return truth;
    }
  }
  fail();
}

/** "<f4" and the like. */
Member
NpyHeaderParser::takeType(const std::string& name)
{
  const std::string type = takeText();
  constexpr struct {
    const char* name;
    Type::PointFieldTypes datatype;
  } types[] = {{"f4", Type::FLOAT32},
               {"f8", Type::FLOAT64},
               {"i1", Type::INT8},
               {"i2", Type::INT16},
               {"i4", Type::INT32},
               {"i8", Type::INT64},
               {"u1", Type::UINT8},
               {"u2", Type::UINT16},
               {"u4", Type::UINT32},
               {"u8", Type::UINT64},
               {"b1", Type::BOOL}};
  for (const auto& known : types)
    if (type.size() == 3 && type.compare(1, 2, known.name) == 0)
      return {name, static_cast<std::uint8_t>(known.datatype), 1, type[0] == '>'};
  throwUnreadable(path_,
                  {"unsupported_value",
                   "the type of a field",
                   shortenText(type),
                   "integers and reals with up to 8 bytes"});
}

void
NpyHeaderParser::parse(Array& array)
{
  expect('{');
  while (!take('}')) {
    const std::string key = takeText();
    expect(':');
    if (key == "descr") {
      array.is_structured = take('[');
      if (!array.is_structured)
        array.members = {takeType("")};
      while (array.is_structured && !take(']')) {
        expect('(');
        const std::string name = takeText();
        expect(',');
        Member member = takeType(name);
        if (take(','))
          for (const std::uint64_t count : takeCounts())
            member.components *= std::min<std::uint64_t>(count, UINT16_MAX);
        expect(')');
        if (member.components < 1 || member.components > most_table_components)
          throwUnreadable(path_,
                          {"too_many_parts",
                           "its field " + quoteText(name),
                           most_table_components,
                           "numbers"});
        array.members.push_back(member);
        take(',');
      }
    }
    else if (key == "fortran_order")
      array.by_columns = takeTruth();
    else if (key == "shape")
      array.shape = takeCounts();
    else
      fail();
    take(',');
  }
  if (array.members.empty())
    fail();
}

/** The array that starts at an offset of a file. */
Array
readArray(const std::string& path,
          const std::string& name,
          std::shared_ptr<const InputFile> file,
          std::uint64_t start,
          std::uint64_t bytes)
{
  std::array<std::uint8_t, 12> head{};
  if (bytes < head.size())
    throwUnreadable(path, {"truncated_part", "the header of an array"});
  file->read(start, head.data(), head.size());
  if (std::memcmp(head.data(), "\x93NUMPY", 6) != 0 || head[6] < 1 || head[6] > 3)
    throwUnreadable(path, {"not_format", "a NumPy array of format 1 to 3"});
  const bool is_long = head[6] > 1;
  std::uint64_t length = head[8] | std::uint64_t(head[9]) << 8;
  if (is_long)
    length |= std::uint64_t(head[10]) << 16 | std::uint64_t(head[11]) << 24;
  const std::uint64_t begin = is_long ? 12 : 10;
  if (length > most_header_bytes || length > bytes - begin)
    throwUnreadable(path, {"truncated_part", "the header of an array"});
  std::string text(length, '\0');
  file->read(start + begin, text.data(), text.size());
  Array array;
  array.name = name;
  NpyHeaderParser(path, text).parse(array);
  array.offset = start + begin + length;
  array.file = std::move(file);
  std::uint64_t size = 0;
  for (const Member& member : array.members)
    size += member.components * datatypeSize(member.datatype);
  const std::uint64_t left = bytes - begin - length;
  std::uint64_t count = 1;
  bool fits = true;
  for (const std::uint64_t side : array.shape) {
    fits = fits && (side == 0 || count <= left / side);
    count *= fits ? side : 0;
  }
  if (!fits || count > left / size)
    throwUnreadable(path, {"truncated_part", "the array " + quoteText(name)});
  return array;
}

/** Columns of a table by their numbers, contiguous each or row by row. */
class StridedColumn : public FileColumn {
public:
  StridedColumn(const Array& array, std::uint64_t column, std::size_t components)
      : array_(array)
      , column_(column)
      , components_(components)
      , size_(datatypeSize(array.members[0].datatype))
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    const std::size_t step = components_ * size_;
    for (std::size_t k = 0; k < components_; ++k) {
      block_.resize(count * size_);
      array_.file->read(array_.offset + ((column_ + k) * array_.rows() + first) * size_,
                        block_.data(),
                        block_.size());
      for (std::size_t i = 0; i < count; ++i) {
        std::uint8_t* const to = tuples + i * step + k * size_;
        std::copy_n(block_.data() + i * size_, size_, to);
        if (array_.members[0].swapped)
          std::reverse(to, to + size_);
      }
    }
  }

private:
  Array array_;
  std::uint64_t column_;
  std::size_t components_, size_;
  std::vector<std::uint8_t> block_;
};

const std::vector<std::string> axis_names{"x", "y", "z"};

/** A column of all numbers of an array. */
NamedColumn
openColumn(const Array& array, std::vector<std::string> names)
{
  const Member& type = array.members[0];
  const auto components = static_cast<std::size_t>(array.components());
  return {std::move(names),
          type.datatype,
          components,
          array.by_columns && components > 1
              ? std::make_unique<StridedColumn>(array, 0, components)
              : openStored(
                    array.file, array.offset, type.datatype, components, type.swapped)};
}

/** Structured arrays are records as they are. */
class StructuredSource : public NumberedSource {
public:
  explicit StructuredSource(const Array& array)
      : array_(array)
  {
    info_.count = array.rows() * array.components();
    for (const Member& member : array.members) {
      const auto components = static_cast<std::size_t>(member.components);
      const bool is_position =
          findPositionTables({{member.name, 1, member.components}}).size() == 1;
      for (std::size_t k = 0; is_position && k < 3; ++k)
        appendField(info_.fields, axis_names[k], member.datatype);
      if (!is_position)
        appendField(info_.fields, member.name, member.datatype, components);
    }
  }

  void
  read(std::size_t count, std::uint8_t* records) override
  {
    const std::size_t step = recordBytes(info_.fields);
    array_.file->read(array_.offset + next_ * step, records, count * step);
    next_ += count;
    for (std::size_t i = 0; i < count; ++i)
      for (const Member& member : array_.members)
        for (std::uint64_t k = 0; k < member.components; ++k) {
          const std::size_t size = datatypeSize(member.datatype);
          if (member.swapped)
            std::reverse(records, records + size);
          records += size;
        }
  }

private:
  Array array_;
};

/** x, y, z in the first three columns, further ones by their numbers. */
std::unique_ptr<RecordSource>
openTable(const std::string& path, const Array& array)
{
  if (array.is_structured)
    return std::make_unique<StructuredSource>(array);
  if (array.shape.size() != 2 || array.shape[1] < 3 ||
      array.shape[1] > most_table_components)
    throwUnreadable(path, {"no_point_array", most_table_components});
  std::vector<NamedColumn> columns;
  std::vector<std::string> names = axis_names;
  for (std::uint64_t i = 3; i < array.shape[1]; ++i)
    names.push_back("column_" + std::to_string(i));
  std::vector<Message> notes;
  if (names.size() > 3)
    notes.push_back({"unnamed_columns", {}});
  columns.push_back(openColumn(array, names));
  return std::make_unique<ColumnSource>(
      array.rows(), std::move(columns), std::move(notes));
}

} // namespace

std::unique_ptr<RecordSource>
openNpy(const std::string& path)
{
  auto file = std::make_shared<const InputFile>(path);
  const std::uint64_t bytes = file->getSize();
  return openTable(path, readArray(path, "", std::move(file), 0, bytes));
}

std::unique_ptr<RecordSource>
openNpz(const std::string& path)
{
  const std::string ending = ".npy";
  std::vector<Array> arrays;
  for (const ZipPart& part : openZip(path, ending))
    arrays.push_back(readArray(path,
                               part.name.substr(0, part.name.size() - ending.size()),
                               part.file,
                               part.offset,
                               part.bytes));
  if (arrays.size() == 1)
    return openTable(path, arrays[0]);
  std::vector<NumberTable> tables;
  tables.reserve(arrays.size());
  for (const Array& array : arrays)
    tables.push_back(
        {array.name, array.rows(), array.is_structured ? 0 : array.components()});
  const std::vector<std::size_t> positions = findPositionTables(tables);
  const auto has = [&](const char* name) {
    return std::any_of(arrays.begin(), arrays.end(), [&](const Array& array) {
      return array.name == name;
    });
  };
  if (positions.empty() && has("x") && has("y") && !has("z"))
    throwUnreadable(path, "z_is_missing");
  if (positions.empty())
    throwUnreadable(path, {"no_position_array", std::string(usual_position_names)});
  std::vector<NamedColumn> columns;
  for (std::size_t i = 0; i < positions.size(); ++i)
    columns.push_back(openColumn(
        arrays[positions[i]],
        positions.size() == 1 ? axis_names : std::vector<std::string>{axis_names[i]}));
  const std::uint64_t rows = tables[positions[0]].rows;
  std::vector<Message> notes;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (std::find(positions.begin(), positions.end(), i) != positions.end())
      continue;
    if (arrays[i].shape.empty() || tables[i].rows != rows || tables[i].components < 1 ||
        tables[i].components > most_table_components)
      notes.push_back({"array_of_others", {{"array", shortenText(tables[i].name)}}});
    else
      columns.push_back(openColumn(arrays[i], {tables[i].name}));
  }
  return std::make_unique<ColumnSource>(rows, std::move(columns), std::move(notes));
}

} // namespace io
} // namespace pcl_uvol
