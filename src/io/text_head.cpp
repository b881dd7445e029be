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

/** Lines that are looked at: headers of instruments have some hundred. */
constexpr std::size_t most_lines = 4096;

/** Lines that are not comments, after which no title is looked for. */
constexpr std::size_t most_titles = 64;

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
    if (parseCell(cell, decimal, ignored))
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
    for (FileCursor::Place place = cursor.tell();
         contents_.size() < most_titles && lines_ < most_lines && cursor.nextLine(text);
         place = cursor.tell(), ++lines_)
      if (!trimmed(text).empty())
        add({place, cursor.tell(), std::string(text)});
  }

  TextHead
  read()
  {
    if (contents_.empty())
      throwUnreadable(path_, "it has no header line");
    if (!readTecplot())
      readTable();
    return std::move(head_);
  }

private:
  void
  add(Line line)
  {
    if (!isComment(line.text))
      contents_.push_back(std::move(line));
    else if (contents_.empty()) {
      addComment(line.text);
      last_comment_line_ = line.behind.line;
    }
  }

  /** The first sign decides what comments begin with, beside #: a name in the first
   * column may begin with any other one. */
  bool
  isComment(const std::string& text)
  {
    const std::string sign = text.substr(0, text.compare(0, 2, "//") == 0 ? 2 : 1);
    if (contents_.empty() && first_sign_.empty() &&
        comment_signs.find(text[0]) != std::string_view::npos)
      first_sign_ = sign;
    return sign == "#" || (!first_sign_.empty() && sign == first_sign_ &&
                           (contents_.empty() || sign.size() == 1));
  }

  /** Sea-Bird: "# name 0 = prDM: Pressure, Digiquartz [db]". */
  void
  addComment(const std::string& text)
  {
    const std::size_t length = text.compare(0, 2, "//") == 0 ? 2 : 1;
    std::string& signs = head_.shape.comments;
    if (length == 1 && signs.find(text[0]) == std::string::npos)
      signs += text[0];
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

  /** Numbers as "0,25" where commas do not part the cells. */
  void
  findDecimal(std::size_t row)
  {
    if (head_.shape.separator == ',')
      return;
    double ignored = 0.0;
    for (const std::string_view cell : cellsAt(row))
      if (cell.find(',') != std::string_view::npos && !parseCell(cell, '.', ignored) &&
          parseCell(cell, ',', ignored)) {
        head_.decimal = ',';
        head_.notes.push_back({"decimal_commas", {}});
        return;
      }
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
        throwUnreadable(path_, "it has no header line");
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
    if (comment_.find('"') == std::string::npos)
      rows_.split(comment_, names);
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
      const auto has_numbers = [&](std::size_t row) {
        return cellsAt(row).size() == cells &&
               !hasTextOnly(cellsAt(row), head_.decimal);
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
    takeNames(cells, contents_[names].behind.line);
    std::size_t row = names + 1;
    if (row + 1 < contents_.size() && cellsAt(row).size() == cells.size() &&
        cellsAt(row + 1).size() == cells.size() &&
        hasTextOnly(cellsAt(row), head_.decimal) &&
        !hasTextOnly(cellsAt(row + 1), head_.decimal)) {
      head_.notes.push_back({"skipped_units",
                             {{"line", contents_[row].behind.line},
                              {"units", shortenText(textAt(row))}}});
      ++row;
    }
    findDecimal(row);
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
    const std::string lower = lowerCase(header);
    const std::size_t variables = lower.find("variables"), zone = lower.find("zone");
    if (variables == std::string::npos || row == contents_.size())
      return false;
    if (lower.find("block") != std::string::npos)
      throw IOError("tecplot_blocks", {{"path", printable(path_)}});
    const std::string listed = header.substr(variables, zone - variables);
    for (std::size_t at = listed.find('"'); at != std::string::npos;
         at = listed.find('"', at)) {
      const std::size_t end = listed.find('"', at + 1);
      if (end == std::string::npos)
        return false;
      head_.names.push_back(listed.substr(at + 1, end - at - 1));
      at = end + 1;
    }
    begin(row);
    head_.line = contents_[row].place.line;
    head_.shape.rows = countRows(lower.substr(std::min(zone, lower.size())));
    head_.notes.push_back({"first_zone", {}});
    return head_.names.size() == head_.shape.cells;
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
    const std::uint64_t i = read("i");
    const std::uint64_t all = i * std::max<std::uint64_t>(read("j"), 1) *
                              std::max<std::uint64_t>(read("k"), 1);
    return all > 0 ? all : std::numeric_limits<std::uint64_t>::max();
  }

  const std::string& path_;
  FileCursor& cursor_;
  TextRows rows_;
  TextHead head_;
  std::vector<Line> contents_; ///< lines that are not comments
  std::size_t lines_ = 0, last_comment_line_ = 0;
  std::string first_sign_;          ///< of comments
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
