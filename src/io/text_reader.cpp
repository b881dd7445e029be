// SPDX-License-Identifier: BSD-3-Clause
// Reads tables as text: CSV and its relatives with other separators. The types of the
// columns come from all rows, so these are looked at once before any is taken.
#include "common/numbers.h"
#include "common/printable.h"
#include "io/coordinate_columns.h"
#include "io/formats.h"
#include "io/record_source.h"
#include "io/text_column.h"
#include "io/text_head.h"
#include "io/text_rows.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <map>
#include <optional>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::size_t rows_per_report = 1u << 14; ///< between two looks at the progress

/** A table whose header was read. */
class TextTable {
public:
  TextTable(const std::string& path, const LoadOptions& options);

  /** Looks at all rows.
   * \param keep their values for collect() */
  void
  scan(bool keep);

  /** The columns that hold numbers or names; to be called after scan(). */
  RecordInfo
  describe();

  pcl::PCLPointCloud2
  collect(const RecordInfo& info) const;

  /** The rows again, one after another. */
  std::unique_ptr<RecordSource>
  stream(const RecordInfo& info);

private:
  void
  startColumns(const TextHead& head);
  std::vector<std::string>
  listNames() const;
  bool
  namesCoordinates() const;
  bool
  isXyz() const;
  std::array<std::size_t, 3>
  findCoordinates();
  void
  orderColumns();
  void
  keepDegrees(std::array<std::size_t, 3>& coordinates);
  void
  checkAssumed() const;
  void
  addFlags(bool keep);
  void
  lookAgain();
  void
  checkColumn(const TextColumn& column, bool coordinate) const;

  const std::string path_;
  const LoadOptions options_;
  std::unique_ptr<FileCursor> cursor_;
  TextRows rows_;
  TextRows::Shape shape_;
  FileCursor::Place start_; ///< of the first row
  std::vector<TextColumn> columns_;
  bool has_header_ = true;
  bool has_coordinates_;
  bool is_global_ = false;             ///< x and y are degrees, to be put on a map
  bool are_assumed_ = false;           ///< the coordinates, in spite of a header
  std::array<std::string, 3> assumed_; ///< their names
  CoordinateRange range_;
  std::optional<NormalColumns> normals_;
  std::uint64_t count_ = 0;
  std::vector<Message> notes_;
};

TextTable::TextTable(const std::string& path, const LoadOptions& options)
    : path_(path)
    , options_(options)
    , cursor_(std::make_unique<FileCursor>(path, FileCursor::Content::Text))
    , rows_(path_, *cursor_)
{
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (cursor_->getFile().head(byte_order_mark.size()) == byte_order_mark)
    cursor_->skip(byte_order_mark.size());
  const TextHead head = readTextHead(path_, *cursor_);
  notes_ = head.notes;
  start_ = head.start;
  startColumns(head);
  shape_ = head.shape;
  has_coordinates_ = options.needs_coordinates || namesCoordinates() || isXyz();
  if (!has_coordinates_)
    for (const char* const name : {"x", "y", "z"}) {
      columns_.emplace_back();
      columns_.back().name = name;
    }
  orderColumns();
}

void
TextTable::startColumns(const TextHead& head)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < head.shape.cells; ++i) {
    const bool is_named = i < head.names.size() && !head.names[i].empty();
    names.push_back(is_named ? head.names[i] : "column_" + std::to_string(i));
  }
  has_header_ = !head.names.empty();
  if (!has_header_)
    notes_.push_back({"no_header_line", {{"last", names.size() - 1}}});
  const std::vector<std::string> originals = names;
  makeUnique(names);
  constexpr std::size_t most_notes = 10;
  std::size_t renamed = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != originals[i])
      if (++renamed <= most_notes)
        notes_.push_back({"repeated_column",
                          {{"line", head.line},
                           {"name", shortenText(originals[i])},
                           {"column", shortenText(names[i])}}});
    TextColumn column;
    column.name = names[i];
    column.cell = i;
    column.decimal = head.decimal;
    columns_.push_back(std::move(column));
  }
  if (renamed > most_notes)
    notes_.push_back({"more_repeated_columns", {{"columns", renamed - most_notes}}});
}

std::vector<std::string>
TextTable::listNames() const
{
  std::vector<std::string> names;
  for (const TextColumn& column : columns_)
    names.push_back(column.name);
  return names;
}

std::array<std::size_t, 3>
TextTable::findCoordinates()
{
  const std::vector<std::string> names = listNames();
  if (options_.xyz_columns != LoadOptions().xyz_columns) {
    try {
      const auto chosen = findChosenColumns(options_.xyz_columns, names);
      is_global_ = options_.map && areGlobal(chosen, names);
      return chosen;
    }
    catch (const InvalidArgument& error) {
      throwUnreadable(path_, error.asMessage());
    }
  }
  if (const auto found = recognizeCoordinates(names, options_.map.has_value())) {
    is_global_ = found->is_global;
    if (found->note)
      notes_.push_back(*found->note);
    if (found->mixture && !options_.may_mix_units)
      notes_.push_back(*found->mixture);
    return found->columns;
  }
  if (columns_.size() < 3)
    throwUnreadable(path_, {"few_columns", columns_.size()});
  if (const auto named = findPossibleCoordinate(names))
    throwUnreadable(path_, {"some_coordinates_named", shortenText(*named)});
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < names.size() && chosen.size() < 3; ++i)
    if (!saysTime(names[i]))
      chosen.push_back(i);
  if (chosen.size() < 3)
    throwUnreadable(path_, "only_times_named");
  are_assumed_ = has_header_;
  notes_.push_back({"assumed_coordinates",
                    {{"skips_times", chosen[2] > 2},
                     {"x", shortenText(names[chosen[0]])},
                     {"y", shortenText(names[chosen[1]])},
                     {"z", shortenText(names[chosen[2]])}}});
  return {{chosen[0], chosen[1], chosen[2]}};
}

bool
TextTable::namesCoordinates() const
{
  const std::vector<std::string> names = listNames();
  return options_.xyz_columns != LoadOptions().xyz_columns ||
         recognizeCoordinates(names) ||
         std::any_of(names.begin(), names.end(), [](const std::string& name) {
           return axisOf(lowerCase(name)) >= 0;
         });
}

/** A file of numbers whose ending says what the first three columns are. */
bool
TextTable::isXyz() const
{
  return !has_header_ && columns_.size() >= 3 && getEnding(path_) == ".xyz";
}

/** Whole numbers are labels or indices as often as coordinates. */
void
TextTable::checkAssumed() const
{
  if (!are_assumed_)
    return;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (columns_[axis].integers && columns_[axis].numbers > 0)
      throwUnreadable(path_, {"ambiguous_integers", shortenText(assumed_[axis])});
}

/** Keeps longitude, latitude and the vertical as fields: coordinates are copies, which
 * go onto the map. */
void
TextTable::keepDegrees(std::array<std::size_t, 3>& coordinates)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    TextColumn copy = columns_[coordinates[axis]];
    if (axis < 2)
      columns_[coordinates[axis]].floats = false; // what the map is computed of
    else if (isDownwards(copy.name))
      copy.factor = -1.0;
    if (axisOf(lowerCase(copy.name)) >= 0)
      continue; // there is no other field of that name
    coordinates[axis] = columns_.size();
    columns_.push_back(std::move(copy));
  }
}

/** Brings the coordinates to the front. */
void
TextTable::orderColumns()
{
  auto coordinates = findCoordinates();
  if (is_global_)
    keepDegrees(coordinates);
  std::vector<TextColumn> ordered;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ordered.push_back(std::move(columns_[coordinates[axis]]));
    assumed_[axis] = ordered.back().name;
    ordered.back().name = std::string(1, static_cast<char>('x' + axis));
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const bool is_replaced = is_global_ && axisOf(columns_[i].name) >= 0;
    if (std::find(coordinates.begin(), coordinates.end(), i) == coordinates.end() &&
        !is_replaced)
      ordered.push_back(std::move(columns_[i]));
  }
  columns_ = std::move(ordered);
}

void
TextTable::scan(bool keep)
{
  cursor_->seek(start_);
  rows_.setShape(shape_);
  Report report;
  report.progress = options_.progress;
  StepTimer step(report, "read", cursor_->left());
  std::uint64_t left = cursor_->left();
  Cells cells;
  CoordinateRange::Point point{};
  std::vector<double> row(columns_.size());
  normals_.emplace(columns_);
  for (; rows_.next(cells); ++count_) {
    if (count_ % rows_per_report == 0) {
      step.advance(left - cursor_->left());
      left = cursor_->left();
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      TextColumn& column = columns_[i];
      const double value =
          column.cell
              ? column.factor * column.take(cells[*column.cell], cursor_->tell().line)
              : 0.0;
      row[i] = value;
      if (i < point.size())
        point[i] = value;
      if (keep)
        column.values.push_back(value);
    }
    normals_->take(row);
    range_.add(point);
  }
  if (shape_.rows != TextRows::Shape().rows && count_ < shape_.rows)
    throwUnreadable(path_,
                    {"truncated_rows", shape_.rows, "points of its zone", count_});
}

/** Columns with numbers below limits are joined by columns of 1 where they are, and 0.
 */
void
TextTable::addFlags(bool keep)
{
  std::vector<TextColumn> flags;
  for (const TextColumn& column : columns_)
    if (column.below > 0 && !column.holdsNames()) {
      TextColumn& flag = flags.emplace_back();
      flag.name = column.name + "_below";
      flag.cell = column.cell;
      flag.decimal = column.decimal;
      flag.is_flag = true;
      flag.numbers = count_;
      flag.low = 0.0;
      flag.high = 1.0;
      notes_.push_back({"below_detection",
                        {{"column", shortenText(column.name)},
                         {"cells", column.below},
                         {"flag", shortenText(flag.name)}}});
      if (keep)
        flag.values.assign(count_, 0.0);
    }
  for (TextColumn& flag : flags)
    columns_.push_back(std::move(flag));
}

/** Which names columns hold, and where numbers are below limits, is known before their
 * values: these are put in after a second look at the rows. */
void
TextTable::lookAgain()
{
  using Numbers = std::map<std::string, double>;
  std::vector<std::pair<TextColumn*, Numbers>> found; // in the order of the rows
  std::vector<TextColumn*> flags;
  for (auto& column : columns_) {
    if (column.holdsNames())
      found.emplace_back(&column, Numbers());
    if (column.is_flag && !column.values.empty())
      flags.push_back(&column);
  }
  if (found.empty() && flags.empty())
    return;
  cursor_->seek(start_);
  rows_.setShape(shape_);
  Cells cells;
  double ignored = 0.0;
  for (std::size_t row = 0; rows_.next(cells); ++row) {
    for (TextColumn* const flag : flags)
      flag->values[row] =
          isBelow(cells[*flag->cell], flag->decimal, ignored) ? 1.0 : 0.0;
    for (auto& [column, numbers] : found) {
      const std::string_view cell = cells[*column->cell];
      const std::string name = withoutDoubledQuotes(cell);
      auto known = numbers.find(name);
      if (known == numbers.end() && !isMissing(cell) && numbers.size() <= most_names)
        known = numbers.emplace(name, static_cast<double>(numbers.size())).first;
      if (!column->values.empty())
        column->values[row] = known == numbers.end() ? no_name : known->second;
    }
  }
  for (auto& [column, numbers] : found) {
    if (numbers.size() > most_names)
      continue;
    std::vector<double> ranks(numbers.size());
    for (const auto& [name, number] : numbers) {
      ranks[static_cast<std::size_t>(number)] =
          static_cast<double>(column->labels.size());
      column->labels.push_back(name);
    }
    for (double& value : column->values)
      value = value == no_name ? no_name : ranks[static_cast<std::size_t>(value)];
  }
}

/** Numbers that are more than names may be are values. */
void
TextTable::checkColumn(const TextColumn& column, bool coordinate) const
{
  const bool has_values = column.labels.empty() && column.isMostlyNumbers();
  if (coordinate && column.below > 0)
    throwUnreadable(path_, {"coordinate_below_limit", shortenText(column.name)});
  if (column.texts > 0 && (coordinate || has_values))
    throwUnreadable(
        path_,
        column.first_text_line,
        {"text_in_column", shortenText(column.first_text), shortenText(column.name)});
}

/** Where numbers were meant, the note tells which cell to mend. */
void
addNames(const TextColumn& column, RecordInfo& info)
{
  info.labels.emplace(column.name, column.labels);
  if (column.isMostlyNumbers())
    info.notes.push_back({"kept_as_names",
                          {{"column", shortenText(column.name)},
                           {"cell", shortenText(column.first_text)},
                           {"line", column.first_text_line}}});
}

RecordInfo
TextTable::describe()
{
  checkAssumed();
  addFlags(!columns_.empty() && !columns_.front().values.empty());
  lookAgain();
  for (const TextColumn& column : columns_)
    checkColumn(column, &column - columns_.data() < 3);
  RecordInfo info;
  info.count = count_;
  info.notes = notes_;
  std::vector<TextColumn> taken;
  for (auto& column : columns_) {
    if (column.holdsNames() && column.labels.empty()) {
      info.notes.push_back(
          {"too_many_names",
           {{"column", shortenText(column.name)}, {"most", most_names}}});
      continue;
    }
    if (column.holdsNames())
      addNames(column, info);
    else if (column.inexact)
      info.notes.push_back(
          {"rounded_integers", {{"column", shortenText(column.name)}}});
    const bool coordinate = &column - columns_.data() < 3;
    appendField(info.fields,
                column.name,
                coordinate ? std::uint8_t{Type::FLOAT64} : column.getDatatype());
    taken.push_back(std::move(column));
  }
  columns_ = std::move(taken);
  normals_->rename(info.fields);
  info.double_coordinates =
      !(columns_[0].floats && columns_[1].floats && columns_[2].floats);
  info.has_coordinates = has_coordinates_;
  info.is_global = is_global_;
  if (!is_global_) // else that of the map counts
    info.origin = findOrigin(range_, info.notes);
  return info;
}

pcl::PCLPointCloud2
TextTable::collect(const RecordInfo& info) const
{
  auto records = makeRecords(info.fields, info.count);
  for (std::size_t i = 0; i < info.fields.size(); ++i) {
    std::size_t at = info.fields[i].offset;
    for (const double value : columns_[i].values) {
      putNumber(value, info.fields[i].datatype, &records.data[at]);
      at += records.point_step;
    }
  }
  return records;
}

/** The rows of a table that was looked at. */
class TextSource : public SequentialSource {
public:
  /** \param columns those of the fields */
  TextSource(const std::string& path,
             std::unique_ptr<FileCursor> cursor,
             const TextRows::Shape& shape,
             const RecordInfo& info,
             const std::vector<TextColumn>& columns)
      : SequentialSource(path, std::move(cursor), info)
      , rows_(path_, *cursor_)
  {
    TextRows::Shape of_rows = shape;
    of_rows.rows = TextRows::Shape().rows; // the count of records bounds them
    rows_.setShape(of_rows);
    for (const auto& column : columns)
      columns_.push_back(
          {column.cell, column.factor, column.labels, column.decimal, column.is_flag});
  }

private:
  void
  readRecord(std::uint8_t* record) override
  {
    if (!rows_.next(cells_))
      throwShorter();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto& field = info_.fields[i];
      putNumber(parseValue(columns_[i]), field.datatype, record + field.offset);
    }
  }

  void
  skipRecord() override
  {
    std::string_view line;
    if (!rows_.nextLine(line))
      throwShorter();
  }

  struct SourceColumn {
    std::optional<std::size_t> cell;
    double factor;
    std::vector<std::string> labels;
    char decimal;
    bool is_flag;
  };

  double
  parseValue(const SourceColumn& column) const
  {
    if (!column.cell)
      return 0.0;
    const std::string_view cell = cells_[*column.cell];
    double limit = 0.0;
    if (column.is_flag)
      return isBelow(cell, column.decimal, limit) ? 1.0 : 0.0;
    return column.labels.empty() ? column.factor * numberIn(cell, column.decimal)
                                 : findLabel(cell, column.labels);
  }

  [[noreturn]] void
  throwShorter() const
  {
    throwUnreadable(path_, "shortened_file");
  }

  TextRows rows_;
  Cells cells_;
  std::vector<SourceColumn> columns_;
};

std::unique_ptr<RecordSource>
TextTable::stream(const RecordInfo& info)
{
  cursor_->seek(start_);
  return std::make_unique<TextSource>(
      path_, std::move(cursor_), shape_, info, columns_);
}

} // namespace

Dataset
readText(const std::string& path, const LoadOptions& options)
{
  TextTable table(path, options);
  table.scan(true);
  const RecordInfo info = table.describe();
  return makeDataset(table.collect(info), info);
}

std::unique_ptr<RecordSource>
openText(const std::string& path, const LoadOptions& options)
{
  TextTable table(path, options);
  table.scan(false);
  const RecordInfo info = table.describe();
  return table.stream(info);
}

} // namespace io
} // namespace pcl_uvol
