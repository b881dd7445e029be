// SPDX-License-Identifier: BSD-3-Clause
// Cells between separators, blanks and quotes.
#include "io/text_rows.h"

#include "common/numbers.h"

namespace pcl_uvol {
namespace io {

/** What a quoted cell holds; `at` moves behind the closing quote. */
std::string_view
TextRows::takeQuoted(std::string_view line, std::size_t& at) const
{
  const std::size_t start = at + 1;
  std::size_t end = line.find('"', start);
  while (end != std::string_view::npos && line.substr(end + 1, 1) == "\"")
    end = line.find('"', end + 2); // a doubled quote belongs to the cell
  if (end == std::string_view::npos)
    throwUnreadable(path_, cursor_.tell().line, "open_quote");
  at = end + 1;
  return line.substr(start, end - start);
}

void
TextRows::split(std::string_view line, Cells& cells) const
{
  const char separator = shape_.separator;
  if (separator == blanks && line.find('"') == std::string_view::npos) {
    splitWords(line, cells);
    return;
  }
  cells.clear();
  const auto is_end = [separator](char c) {
    return separator == blanks ? c == ' ' || c == '\t' : c == separator;
  };
  for (std::size_t at = 0; at <= line.size(); ++at) {
    std::size_t start = at;
    while (start < line.size() && (line[start] == ' ' || line[start] == '\t') &&
           line[start] != separator)
      ++start;
    if (separator == blanks &&
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
        throwUnreadable(path_, cursor_.tell().line, "text_behind_quote");
    }
    else {
      while (at < line.size() && !is_end(line[at]))
        ++at;
      cell = trimmed(line.substr(start, at - start));
    }
    cells.push_back(cell);
  }
}

bool
TextRows::nextLine(std::string_view& line)
{
  while (left_ > 0 && cursor_.nextLine(line))
    if (!trimmed(line).empty() && shape_.comments.find(line[0]) == std::string::npos) {
      --left_;
      return true;
    }
  return false;
}

bool
TextRows::next(Cells& cells)
{
  std::string_view line;
  if (!nextLine(line))
    return false;
  split(line, cells);
  if (cells.size() != shape_.cells)
    throwUnreadable(path_,
                    cursor_.tell().line,
                    {"wrong_count", "the line", cells.size(), "cells", shape_.cells});
  return true;
}

} // namespace io
} // namespace pcl_uvol
