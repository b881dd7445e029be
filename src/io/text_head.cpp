// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_head.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io/text_column.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace pcl_uvol::io {

namespace {

/** Lines that are looked at but for comments. */
constexpr std::size_t most_rows = 64;

constexpr std::string_view comment_signs = "#%!*/";

struct Line {
  FileCursor::Place place, behind;
  std::string text;
};

/** What a text that begins with a key is set to: "sep=;" is ";". */
std::optional<std::string>
valueOf(const std::string& text, const std::string& key)
{
  const std::size_t at = lowerCase(text).find(key);
  const std::size_t equal = text.find('=');
  if (equal == std::string::npos || at == std::string::npos ||
      at + key.size() > equal ||
      !trimmed(std::string_view(text).substr(0, at)).empty() ||
      !trimmed(std::string_view(text).substr(at + key.size(), equal - at - key.size()))
           .empty())
    return std::nullopt;
  return std::string(trimmed(std::string_view(text).substr(equal + 1)));
}

std::size_t
countNumbers(const Cells& cells, char decimal)
{
  double ignored = 0.0;
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [&](std::string_view cell) {
        return isMissing(cell) || parseCell(cell, decimal, ignored);
      }));
}

/** Whether a row has text and no number. */
bool
hasTextOnly(const Cells& cells, char decimal)
{
  double ignored = 0.0;
  bool has_text = false;
  for (const std::string_view cell : cells) {
    if (parseCell(cell, decimal, ignored) || isBelow(cell, decimal, ignored))
      return false;
    has_text = has_text || !isMissing(cell);
  }
  return has_text;
}

/** Finds the begin of the rows among the first lines. */
class HeadReader {
public:
  HeadReader(const std::string& path, FileCursor& cursor)
      : path_(path)
      , cursor_(cursor)
      , rows_(path, cursor)
  {
    std::string_view text;
    std::optional<Line> line; // which the next one tells more of
    for (FileCursor::Place place = cursor.tell();
         contents_.size() < most_rows && cursor.nextLine(text);
         place = cursor.tell()) {
      if (trimmed(text).empty())
        continue;
      if (line)
        add(std::move(*line), text);
      line = Line{place, cursor.tell(), std::string(text)};
    }
    if (line)
      add(std::move(*line), "");
  }

  TextHead
  read()
  {
    if (contents_.empty())
      throwUnreadable(path_, {"missing_part", "its header line"});
    if (!readTecplot())
      readTable();
    return std::move(head_);
  }

private:
  void
  add(Line line, std::string_view next)
  {
    if (contents_.empty() ? !isComment(line.text, next) : line.text[0] != '#')
      contents_.push_back(std::move(line));
    else if (contents_.empty()) {
      addComment(line.text);
      last_comment_line_ = line.behind.line;
    }
  }

  /** Whether a line above the rows is a comment. Behind %, !, * and / a name may begin:
   * then the line has as many cells as the next one. */
  bool
  isComment(const std::string& text, std::string_view next)
  {
    if (text[0] == '#' || text.compare(0, 2, "//") == 0)
      return true;
    if (comment_signs.find(text[0]) == std::string_view::npos)
      return false;
    if (text.size() == 1 ||
        std::string_view(" \t#%!*/").find(text[1]) != std::string_view::npos)
      return true;
    findSeparator(text);
    Cells own, below;
    if (head_.shape.separator == TextRows::blanks)
      return true;
    try {
      rows_.split(text, own);
      rows_.split(next, below);
    }
    catch (const IOError&) { // quotes that do not end
      return true;
    }
    return own.size() < 3 || own.size() != below.size();
  }

  /** Sea-Bird: "# name 0 = prDM: Pressure, Digiquartz [db]". */
  void
  addComment(const std::string& text)
  {
    const std::size_t length = text.compare(0, 2, "//") == 0 ? 2 : 1;
    std::string comment(trimmed(std::string_view(text).substr(length)));
    const std::size_t equal = comment.find('=');
    if (comment.compare(0, 5, "name ") == 0 && equal != std::string::npos) {
      const std::string name = comment.substr(equal + 1, comment.find(':') - equal - 1);
      listed_.emplace_back(trimmed(name));
    }
    if (!comment.empty() && comment.find_first_not_of("-=*#/") != std::string::npos)
      comment_ = comment;
  }

  const std::string&
  textAt(std::size_t i) const
  {
    return contents_[i].text;
  }

  Cells
  cellsAt(std::size_t i) const
  {
    Cells cells;
    if (i >= contents_.size())
      return cells;
    try {
      rows_.split(contents_[i].text, cells);
    }
    catch (const IOError&) { // again, where it is: errors tell the line
      cursor_.seek(contents_[i].behind);
      rows_.split(contents_[i].text, cells);
    }
    return cells;
  }

  bool
  isNumbers(std::size_t i) const
  {
    const Cells cells = cellsAt(i);
    return !cells.empty() && countNumbers(cells, head_.decimal) == cells.size();
  }

  void
  setSeparator(char separator)
  {
    head_.shape.separator = separator;
    rows_.setShape(head_.shape);
  }

  /** Of a line of numbers with decimal commas: the sign between them. */
  std::optional<char>
  findBetweenCommas(const std::string& text)
  {
    if (text.find(',') == std::string::npos ||
        text.find_first_of(".\"") != std::string::npos)
      return std::nullopt;
    for (const char separator : {';', '\t', TextRows::blanks}) {
      setSeparator(separator);
      Cells cells;
      rows_.split(text, cells);
      if (cells.size() >= 3 && countNumbers(cells, ',') == cells.size())
        return separator;
    }
    return std::nullopt;
  }

  void
  findSeparator(const std::string& text)
  {
    if (const auto found = findBetweenCommas(text)) {
      setSeparator(*found);
      return;
    }
    for (const char candidate : {',', ';', '\t'}) {
      bool quoted = false;
      for (const char c : text) {
        quoted ^= c == '"';
        if (c == candidate && !quoted) {
          setSeparator(candidate);
          return;
        }
      }
    }
    setSeparator(TextRows::blanks);
  }

  /** Numbers as "0,25" where commas do not part the cells: no number has a point, and
   * not all commas may be those of thousands. */
  void
  findDecimal(std::size_t first)
  {
    if (head_.shape.separator == ',' || head_.decimal == ',')
      return;
    bool has_fraction = false;
    double ignored = 0.0;
    for (std::size_t row = first; row < contents_.size(); ++row)
      for (const std::string_view cell : cellsAt(row)) {
        const std::size_t point = cell.find(',');
        if (cell.find('.') != std::string_view::npos && parseCell(cell, '.', ignored))
          return;
        if (point != std::string_view::npos && parseCell(cell, ',', ignored))
          has_fraction = has_fraction || cell.size() != point + 4 ||
                         trimmed(cell.substr(0, point)) == "0";
      }
    if (!has_fraction)
      return;
    head_.decimal = ',';
    head_.notes.push_back({"decimal_commas", {}});
  }

  void
  begin(std::size_t row)
  {
    head_.shape.cells = cellsAt(row).size();
    head_.start =
        row < contents_.size() ? contents_[row].place : contents_[row - 1].behind;
  }

  void
  takeNames(const Cells& cells, std::size_t line)
  {
    for (const std::string_view cell : cells)
      head_.names.push_back(withoutDoubledQuotes(trimmed(cell)));
    head_.line = line;
  }

  void
  readTable()
  {
    std::size_t first = 0;
    if (const auto separator = valueOf(textAt(0), "sep");
        separator && separator->size() <= 1) {
      first = 1;
      setSeparator(separator->empty() ? '\t' : (*separator)[0]);
      if (contents_.size() == 1)
        throwUnreadable(path_, {"missing_part", "its header line"});
    }
    else
      findSeparator(textAt(0));
    first = skipCount(first);
    findDecimal(first);
    if (isNumbers(first) || isBelowNames(first))
      readWithoutHeader(first);
    else
      readHeader(first);
  }

  /** A line with the number of rows above these. */
  std::size_t
  skipCount(std::size_t first)
  {
    std::uint64_t count = 0;
    if (first + 1 >= contents_.size() ||
        !parseCount(std::string(trimmed(textAt(first))), count))
      return first;
    const TextRows::Shape shape = head_.shape;
    findSeparator(textAt(first + 1));
    if (cellsAt(first + 1).size() > 1) {
      head_.notes.push_back(
          {"skipped_count", {{"line", contents_[first].behind.line}}});
      return first + 1;
    }
    setSeparator(shape.separator);
    return first;
  }

  /** The last comment, if it has a name for each cell of a row. */
  Cells
  namesAbove(std::size_t row) const
  {
    Cells names;
    try {
      rows_.split(comment_, names);
    }
    catch (const IOError&) { // a comment that is none of names
      names.clear();
    }
    if (names.size() != cellsAt(row).size() || !hasTextOnly(names, head_.decimal))
      names.clear();
    return names;
  }

  /** Whether a row with texts and numbers is below a comment with the names. */
  bool
  isBelowNames(std::size_t row) const
  {
    return !hasTextOnly(cellsAt(row), head_.decimal) && !namesAbove(row).empty();
  }

  void
  readWithoutHeader(std::size_t first)
  {
    begin(first);
    if (listed_.size() == head_.shape.cells) {
      head_.names = listed_;
      return;
    }
    takeNames(namesAbove(first), last_comment_line_);
  }

  /** Names below titles: the first line without a number above a row of as many cells.
   */
  std::optional<std::size_t>
  findBelowTitles(std::size_t first)
  {
    for (std::size_t i = first + 1; i + 1 < contents_.size(); ++i) {
      findSeparator(textAt(i));
      const std::size_t cells = cellsAt(i).size();
      const auto has_numbers = [&](std::size_t row) { // with either decimal sign
        return cellsAt(row).size() == cells &&
               (!hasTextOnly(cellsAt(row), '.') ||
                (head_.shape.separator != ',' && !hasTextOnly(cellsAt(row), ',')));
      };
      const bool is_above =
          has_numbers(i + 1) || // or above units, which are above a row
          (cellsAt(i + 1).size() == cells && has_numbers(i + 2));
      if (cells >= 3 && cells != cellsAt(first).size() && is_above &&
          hasTextOnly(cellsAt(i), head_.decimal))
        return i;
    }
    return std::nullopt;
  }

  /** Whether a row has texts only, each of them above a number of the next row. */
  bool
  areUnits(std::size_t row, std::size_t count) const
  {
    const Cells units = cellsAt(row), numbers = cellsAt(row + 1);
    if (units.size() != count || numbers.size() != count ||
        !hasTextOnly(units, head_.decimal))
      return false;
    double ignored = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      if (!isMissing(units[i]) && units[i] != "-" &&
          !parseCell(numbers[i], head_.decimal, ignored) &&
          !isBelow(numbers[i], head_.decimal, ignored))
        return false;
    return true;
  }

  void
  readHeader(std::size_t first)
  {
    std::size_t names = first;
    const char separator = head_.shape.separator;
    const std::size_t cells_of_first = cellsAt(first).size();
    if (cells_of_first < 3 ||
        (first + 1 < contents_.size() && cells_of_first != cellsAt(first + 1).size())) {
      if (const auto found = findBelowTitles(first)) {
        names = *found;
        head_.notes.push_back(
            {"skipped_titles",
             {{"lines", names - first}, {"first", shortenText(textAt(first))}}});
      }
      else
        setSeparator(separator);
    }
    const Cells cells = cellsAt(names);
    findDecimal(names + 1);
    takeNames(cells, contents_[names].behind.line);
    std::size_t row = names + 1;
    if (areUnits(row, cells.size())) {
      head_.notes.push_back({"skipped_units",
                             {{"line", contents_[row].behind.line},
                              {"units", shortenText(textAt(row))}}});
      ++row;
    }
    begin(row);
    head_.shape.cells = cells.size();
  }

  /** Words of Tecplot's header, up to the rows of the first zone. */
  bool
  readTecplot()
  {
    const auto begins = [](const std::string& text, const std::string& word) {
      return lowerCase(std::string(trimmed(text).substr(0, word.size()))) == word;
    };
    if (!begins(textAt(0), "title") && !begins(textAt(0), "variables") &&
        !begins(textAt(0), "filetype"))
      return false;
    std::string header;
    std::size_t row = 0;
    setSeparator(TextRows::blanks);
    for (; row < contents_.size() &&
           (textAt(row).find('"') != std::string::npos || !isNumbers(row));
         ++row)
      header += textAt(row) + ' ';
    const std::string bare = withoutQuoted(lowerCase(header));
    const std::size_t variables = bare.find("variables"), zone = bare.find("zone");
    if (variables == std::string::npos || row == contents_.size())
      return false;
    const std::string of_zone = bare.substr(std::min(zone, bare.size()));
    if (of_zone.find("block") != std::string::npos)
      throwUnreadable(path_, "tecplot_blocks");
    TextHead head;
    const std::string listed = header.substr(variables, zone - variables);
    for (std::size_t at = listed.find('"'); at != std::string::npos;
         at = listed.find('"', at)) {
      const std::size_t end = listed.find('"', at + 1);
      if (end == std::string::npos)
        return false;
      head.names.push_back(listed.substr(at + 1, end - at - 1));
      at = end + 1;
    }
    if (head.names.size() != cellsAt(row).size())
      return false;
    begin(row);
    head_.names = head.names;
    head_.line = contents_[row].place.line;
    head_.shape.rows = countRows(of_zone);
    head_.notes.push_back({"first_zone", {}});
    return true;
  }

  /** Blanks in the place of what is in quotes. */
  static std::string
  withoutQuoted(std::string text)
  {
    bool is_quoted = false;
    for (char& c : text) {
      is_quoted ^= c == '"';
      c = is_quoted ? ' ' : c;
    }
    return text;
  }

  /** Of "nodes=1200", "n=1200" or "i=20, j=30, k=2". */
  static std::uint64_t
  countRows(const std::string& zone)
  {
    const auto read = [&](const std::string& key) -> std::uint64_t {
      for (std::size_t at = zone.find(key); at != std::string::npos;
           at = zone.find(key, at + 1)) {
        const std::size_t equal = zone.find_first_not_of(' ', at + key.size());
        if ((at > 0 && std::string(" ,").find(zone[at - 1]) == std::string::npos) ||
            equal == std::string::npos || zone[equal] != '=')
          continue;
        const std::size_t from = zone.find_first_not_of(' ', equal + 1);
        std::uint64_t count = 0;
        if (from != std::string::npos &&
            parseCount(zone.substr(from, zone.find_first_of(" ,)", from) - from),
                       count))
          return count;
      }
      return 0;
    };
    for (const char* const key : {"nodes", "n"})
      if (const std::uint64_t nodes = read(key))
        return nodes;
    constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max(),
                            most = std::uint64_t(1) << 20; // along an axis
    std::uint64_t all = read("i");
    for (const char* const key : {"j", "k"}) {
      const std::uint64_t more = std::max<std::uint64_t>(read(key), 1);
      if (all > most || more > most)
        return unknown;
      all *= more;
    }
    return all > 0 ? all : unknown;
  }

  const std::string& path_;
  FileCursor& cursor_;
  TextRows rows_;
  TextHead head_;
  std::vector<Line> contents_; ///< lines that are not comments
  std::size_t last_comment_line_ = 0;
  std::string comment_;             ///< the last one above them
  std::vector<std::string> listed_; ///< names in comments
};

} // namespace

TextHead
readTextHead(const std::string& path, FileCursor& cursor)
{
  return HeadReader(path, cursor).read();
}

} // namespace pcl_uvol::io
