// SPDX-License-Identifier: BSD-3-Clause
// Reads tables as text: CSV and its relatives with other separators.
#include "files.h"
#include "formats.h"
#include "numbers.h"
#include <pcl_uvol/common/records.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;
using Cells = std::vector<std::string_view>;

constexpr char blanks = ' '; ///< the separator of words between blanks and tabs
constexpr double exact_integers = 0x1p53; ///< double holds the integers below

struct TextColumn {
  std::string name;
  std::vector<double> values;
  bool floats = true;   ///< float32 holds all digits
  bool integers = true; ///< all cells are whole numbers
  bool inexact = false; ///< double does not hold some of these
  std::size_t numbers = 0;
  std::size_t texts = 0;
  std::size_t first_text_line = 0;
  std::string first_text;
};

bool
isMissing(std::string_view cell)
{
  if (cell.empty())
    return true;
  if (cell.size() > 4)
    return false;
  const std::string lower = lowerCase(cell);
  return lower == "nan" || lower == "na" || lower == "n/a" || lower == "null";
}

/** The smallest type that keeps the cells as they are given. */
std::uint8_t
datatypeOf(const TextColumn& column)
{
  if (column.integers && column.numbers > 0) {
    const auto range = std::minmax_element(column.values.begin(), column.values.end());
    if (*range.first >= std::numeric_limits<std::int32_t>::min() &&
        *range.second <= std::numeric_limits<std::int32_t>::max())
      return Type::INT32;
  }
  return column.floats ? Type::FLOAT32 : Type::FLOAT64;
}

/** A table read line by line. */
class TextReader {
public:
  TextReader(const std::string& path, const LoadOptions& options);

  Dataset
  read();

private:
  void
  parseHeader();
  void
  startColumns(std::string_view header, std::size_t line);
  void
  startUnnamedColumns(std::size_t count);
  void
  parseRow(std::string_view line);
  void
  takeCell(TextColumn& column, std::string_view cell);
  void
  split(std::string_view line, Cells& cells) const;
  std::string_view
  takeQuoted(std::string_view line, std::size_t& at) const;
  bool
  namesCoordinates() const;
  void
  addOrigins();
  std::array<std::size_t, 3>
  findCoordinates();
  pcl::PCLPointCloud2
  collect();

  const std::string path_;
  const LoadOptions options_;
  std::string text_;
  Lines lines_{std::string_view()};
  char separator_ = blanks;
  std::vector<TextColumn> columns_;
  Cells cells_;
  std::vector<std::string> notes_;
};

TextReader::TextReader(const std::string& path, const LoadOptions& options)
    : path_(path)
    , options_(options)
{
  const InputFile file(path);
  text_ = file.head(file.getSize());
  std::string_view text = text_;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.compare(0, byte_order_mark.size(), byte_order_mark) == 0)
    text.remove_prefix(byte_order_mark.size());
  if (text.find('\0') != std::string_view::npos)
    throwUnreadable(path, "it is no text: it has bytes that are zero");
  lines_ = Lines(text);
}

/** What a quoted cell holds; `at` moves behind the closing quote. */
std::string_view
TextReader::takeQuoted(std::string_view line, std::size_t& at) const
{
  const std::size_t start = at + 1;
  std::size_t end = line.find('"', start);
  while (end != std::string_view::npos && line.substr(end + 1, 1) == "\"")
    end = line.find('"', end + 2); // a doubled quote belongs to the cell
  if (end == std::string_view::npos)
    throwUnreadable(path_, lines_.lineNumber(), "a quoted cell does not end");
  at = end + 1;
  return line.substr(start, end - start);
}

void
TextReader::split(std::string_view line, Cells& cells) const
{
  if (separator_ == blanks && line.find('"') == std::string_view::npos) {
    splitWords(line, cells);
    return;
  }
  cells.clear();
  const auto is_end = [this](char c) {
    return separator_ == blanks ? c == ' ' || c == '\t' : c == separator_;
  };
  for (std::size_t at = 0; at <= line.size(); ++at) {
    std::size_t start = at;
    while (start < line.size() && (line[start] == ' ' || line[start] == '\t') &&
           line[start] != separator_)
      ++start;
    if (separator_ == blanks &&
        (start = line.find_first_not_of(" \t", at)) == std::string_view::npos)
      return;
    std::string_view cell;
    at = start;
    if (start < line.size() && line[start] == '"') {
      cell = takeQuoted(line, at);
      const std::size_t behind = at;
      while (at < line.size() && !is_end(line[at]))
        ++at;
      if (!trimmed(line.substr(behind, at - behind)).empty())
        throwUnreadable(
            path_, lines_.lineNumber(), "there is text behind the quotes of a cell");
    }
    else {
      while (at < line.size() && !is_end(line[at]))
        ++at;
      cell = trimmed(line.substr(start, at - start));
    }
    cells.push_back(cell);
  }
}

void
TextReader::startColumns(std::string_view header, std::size_t line)
{
  Cells cells;
  split(header, cells);
  std::vector<std::string> names;
  for (const std::string_view cell : cells) {
    std::string name(trimmed(cell));
    for (std::size_t at = 0; (at = name.find("\"\"", at)) != std::string::npos; ++at)
      name.erase(at, 1);
    if (name.empty())
      name = "column_" + std::to_string(names.size());
    names.push_back(name);
  }
  const std::vector<std::string> originals = names;
  makeUnique(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != originals[i])
      notes_.push_back("Line " + std::to_string(line) + " names '" + originals[i] +
                       "' again: that column is called '" + names[i] + "'.");
    columns_.emplace_back();
    columns_.back().name = names[i];
  }
}

void
TextReader::startUnnamedColumns(std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i) {
    columns_.emplace_back();
    columns_.back().name = "column_" + std::to_string(i);
  }
  notes_.push_back(
      "There is no header line: the columns are called column_0 to column_" +
      std::to_string(count - 1) + ".");
}

/** Finds the separator and the names: in the first line, else in a comment above
 * numbers ("# x y z density"). */
void
TextReader::parseHeader()
{
  std::string_view line, comment;
  const auto is_comment = [](std::string_view text) {
    return text.substr(0, 1) == "#" || text.substr(0, 2) == "//";
  };
  do {
    if (!lines_.next(line))
      throwUnreadable(path_, "it has no header line");
    if (is_comment(line))
      comment = line.substr(line[0] == '#' ? 1 : 2);
  } while (trimmed(line).empty() || is_comment(line));
  for (const char candidate : {',', ';', '\t'}) {
    bool quoted = false;
    for (const char c : line) {
      quoted ^= c == '"';
      if (c == candidate && !quoted)
        separator_ = candidate;
    }
    if (separator_ != blanks)
      break;
  }
  const auto numbers_in = [](const Cells& cells) {
    double ignored = 0.0;
    return std::count_if(cells.begin(), cells.end(), [&](std::string_view cell) {
      return isMissing(cell) || parseNumber(cell, ignored);
    });
  };
  Cells cells, names;
  split(line, cells);
  if (numbers_in(cells) != static_cast<std::ptrdiff_t>(cells.size())) {
    startColumns(line, lines_.lineNumber());
    return;
  }
  split(comment, names);
  if (!comment.empty() && names.size() == cells.size() && numbers_in(names) == 0)
    startColumns(comment, lines_.lineNumber() - 1);
  else
    startUnnamedColumns(cells.size());
  parseRow(line);
}

void
TextReader::takeCell(TextColumn& column, std::string_view cell)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  const bool parsed = parseNumber(cell, value);
  if (parsed && !std::isnan(value)) {
    ++column.numbers;
    column.floats = column.floats && floatHoldsDigits(cell, value);
    column.integers = column.integers && std::floor(value) == value &&
                      cell.find_first_of(".eE") == std::string_view::npos;
    column.inexact =
        column.inexact || (column.integers && std::abs(value) >= exact_integers);
  }
  else {
    column.integers = false;
    const bool text = !parsed && !isMissing(cell);
    if (text && column.texts == 0) {
      column.first_text_line = lines_.lineNumber();
      column.first_text = cell;
    }
    column.texts += text;
  }
  column.values.push_back(value);
}

void
TextReader::parseRow(std::string_view line)
{
  split(line, cells_);
  if (cells_.size() != columns_.size())
    throwUnreadable(path_,
                    lines_.lineNumber(),
                    "there are " + std::to_string(cells_.size()) + " cells for the " +
                        std::to_string(columns_.size()) + " columns of the header");
  for (std::size_t i = 0; i < cells_.size(); ++i)
    takeCell(columns_[i], cells_[i]);
}

std::array<std::size_t, 3>
TextReader::findCoordinates()
{
  std::array<std::size_t, 3> found{{0, 1, 2}};
  if (options_.xyz_columns != LoadOptions().xyz_columns) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int column = options_.xyz_columns[axis];
      if (column < 0 || static_cast<std::size_t>(column) >= columns_.size())
        throwUnreadable(path_,
                        "there is no column " + std::to_string(column) +
                            " for a coordinate; columns are 0 to " +
                            std::to_string(columns_.size() - 1));
      found[axis] = static_cast<std::size_t>(column);
    }
    if (found[0] == found[1] || found[0] == found[2] || found[1] == found[2])
      throwUnreadable(path_, "the coordinates need three different columns");
    return found;
  }
  std::array<std::optional<std::size_t>, 3> named;
  for (std::size_t i = columns_.size(); i-- > 0;) { // the first of each counts
    const std::string name = lowerCase(columns_[i].name);
    if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z')
      named[static_cast<std::size_t>(name[0] - 'x')] = i;
  }
  if (named[0] && named[1] && named[2])
    return {*named[0], *named[1], *named[2]};
  if (named[0] || named[1] || named[2])
    throwUnreadable(path_,
                    "its header names only some of x, y and z: choose the columns of "
                    "the coordinates by their numbers");
  if (columns_.size() < 3)
    throwUnreadable(path_,
                    "it has " + std::to_string(columns_.size()) +
                        " columns, and coordinates need three; are they separated by "
                        "comma, semicolon, tab or blanks?");
  notes_.push_back("The header names no x, y, z: the first three columns (" +
                   columns_[0].name + ", " + columns_[1].name + ", " +
                   columns_[2].name + ") are the coordinates.");
  return found;
}

/** By x, y, z, or by first columns such as x_km, y_km, z_minus_dbar. */
bool
TextReader::namesCoordinates() const
{
  if (options_.xyz_columns != LoadOptions().xyz_columns ||
      std::any_of(columns_.begin(), columns_.end(), [](const TextColumn& column) {
        return axisOf(lowerCase(column.name)) >= 0;
      }))
    return true;
  if (columns_.size() < 3)
    return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name = lowerCase(columns_[axis].name);
    const bool goes_on = name.size() > 1 && name[1] >= 'a' && name[1] <= 'z';
    if (name.empty() || name[0] != static_cast<char>('x' + axis) || goes_on)
      return false;
  }
  return true;
}

/** Coordinates for points that have none. */
void
TextReader::addOrigins()
{
  for (const char* const name : {"x", "y", "z"}) {
    TextColumn column;
    column.name = name;
    column.values.assign(columns_[0].values.size(), 0.0);
    columns_.push_back(std::move(column));
  }
}

/** The columns that hold numbers, as records. */
pcl::PCLPointCloud2
TextReader::collect()
{
  Fields fields;
  std::vector<const TextColumn*> taken;
  for (const auto& column : columns_) {
    const bool coordinate = &column - columns_.data() < 3;
    // names that happen to be numbers ("34873" beside "B1-001") make no column of
    // numbers
    const bool names = column.texts > column.numbers && !coordinate;
    if (column.texts > 0 && !names)
      throwUnreadable(path_,
                      column.first_text_line,
                      "'" + column.first_text + "' in column '" + column.name +
                          "' is no number");
    if (names) {
      notes_.push_back("The column '" + column.name +
                       "' holds names, not numbers, and is left out.");
      continue;
    }
    const std::uint8_t datatype =
        coordinate ? std::uint8_t{Type::FLOAT64} : datatypeOf(column);
    if (column.inexact)
      notes_.push_back("The column '" + column.name +
                       "' holds integers beyond 2^53, which lose digits.");
    appendField(fields, column.name, datatype);
    taken.push_back(&column);
  }
  auto records = makeRecords(fields, columns_[0].values.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    std::uint8_t* to = records.data.data() + fields[i].offset;
    for (const double value : taken[i]->values) {
      const auto single = static_cast<float>(value);
      if (fields[i].datatype == Type::FLOAT64)
        std::memcpy(to, &value, sizeof(value));
      else if (fields[i].datatype == Type::FLOAT32)
        std::memcpy(to, &single, sizeof(single));
      else {
        const auto whole = static_cast<std::int32_t>(value);
        std::memcpy(to, &whole, sizeof(whole));
      }
      to += records.point_step;
    }
  }
  return records;
}

Dataset
TextReader::read()
{
  parseHeader();
  std::string_view line;
  while (lines_.next(line))
    if (!trimmed(line).empty() && line[0] != '#')
      parseRow(line);
  const bool has_coordinates = options_.needs_coordinates || namesCoordinates();
  if (!has_coordinates)
    addOrigins();
  const auto coordinates = findCoordinates();
  std::vector<TextColumn> ordered;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ordered.push_back(std::move(columns_[coordinates[axis]]));
    ordered.back().name = std::string(1, static_cast<char>('x' + axis));
  }
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (std::find(coordinates.begin(), coordinates.end(), i) == coordinates.end())
      ordered.push_back(std::move(columns_[i]));
  columns_ = std::move(ordered);
  const bool doubles =
      !(columns_[0].floats && columns_[1].floats && columns_[2].floats);
  Dataset dataset = makeDataset(collect());
  dataset.double_coordinates = doubles;
  dataset.has_coordinates = has_coordinates;
  dataset.notes.insert(dataset.notes.begin(), notes_.begin(), notes_.end());
  return dataset;
}

} // namespace

Dataset
readText(const std::string& path, const LoadOptions& options)
{
  return TextReader(path, options).read();
}

} // namespace io
} // namespace pcl_uvol
