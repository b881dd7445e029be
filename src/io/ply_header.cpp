// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_header.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io/formats.h"
#include "io/ply_types.h"

#include <string_view>
#include <utility>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;
using Words = std::vector<std::string_view>;

/** Parses the lines of a header, up to end_header. */
class PlyHeaderParser {
public:
  PlyHeaderParser(const std::string& path, FileCursor& cursor)
      : path_(path)
      , cursor_(cursor)
  {
  }

  PlyHeader
  parse();

private:
  void
  takeLine(std::string_view line, const Words& words);
  PlyFormat
  formatIn(const Words& words) const;
  void
  takeProperty(const Words& words);

  [[noreturn]] void
  throwInLine(const FileReason& reason) const
  {
    throwUnreadable(path_, cursor_.tell().line, reason);
  }

  const std::string& path_;
  FileCursor& cursor_;
  PlyHeader header_;
};

void
PlyHeaderParser::takeProperty(const Words& words)
{
  if (header_.elements.empty())
    throwInLine({"foreign_line", "an element"});
  PlyProperty property;
  std::size_t type = 1;
  if (words.size() == 5 && words[1] == "list") {
    property.length_type = plyDatatype(words[2]);
    type = 3;
    if (property.length_type == 0 || property.length_type == Type::FLOAT32 ||
        property.length_type == Type::FLOAT64)
      throwInLine({"unexpected_word",
                   shortenText(words[2]),
                   "a valid type for the length of a list"});
  }
  if (words.size() != type + 2)
    throwInLine({"incomplete_entry", "a property", "a type and a name"});
  property.datatype = plyDatatype(words[type]);
  property.name = words[type + 1];
  if (property.datatype == 0)
    throwInLine(
        {"unexpected_word",
         shortenText(words[type]),
         "a type of PLY, as the property " + quoteText(property.name) + " requires"});
  header_.elements.back().properties.push_back(property);
}

PlyFormat
PlyHeaderParser::formatIn(const Words& words) const
{
  if (words.size() == 3 && words[1] == "ascii")
    return PlyFormat::Ascii;
  if (words.size() == 3 && words[1] == "binary_little_endian")
    return PlyFormat::LittleEndian;
  if (words.size() == 3 && words[1] == "binary_big_endian")
    return PlyFormat::BigEndian;
  throwInLine({"unexpected_word",
               shortenText(words.size() > 1 ? words[1] : ""),
               "ascii, binary_little_endian or binary_big_endian"});
}

void
PlyHeaderParser::takeLine(std::string_view line, const Words& words)
{
  if (words[0] == "comment" && words.size() > 1)
    takeLabelComment(
        line.substr(static_cast<std::size_t>(words[1].data() - line.data())),
        header_.labels);
  if (words[0] == "comment" || words[0] == "obj_info")
    return;
  if (words[0] == "format")
    header_.format = formatIn(words);
  else if (words[0] == "element") {
    PlyElement element;
    if (words.size() != 3 || !parseCount(words[2], element.count))
      throwInLine({"incomplete_entry", "an element", "a name and a count"});
    element.name = words[1];
    header_.elements.push_back(element);
  }
  else if (words[0] == "property")
    takeProperty(words);
  else
    throwInLine({"foreign_line", "a PLY header"});
}

PlyHeader
PlyHeaderParser::parse()
{
  std::string_view line;
  if (!cursor_.nextLine(line) || line != "ply")
    throwUnreadable(path_, {"wrong_start", "a PLY file", "a line 'ply'"});
  Words words;
  while (cursor_.nextLine(line)) {
    splitWords(line, words);
    if (words.empty())
      continue;
    if (words[0] == "end_header") {
      if (header_.format == PlyFormat::None)
        throwUnreadable(path_, {"missing_part", "the format line of its header"});
      return std::move(header_);
    }
    takeLine(line, words);
  }
  throwUnreadable(path_, {"missing_part", "the end_header line of its header"});
}

} // namespace

PlyHeader
readPlyHeader(const std::string& path, FileCursor& cursor)
{
  return PlyHeaderParser(path, cursor).parse();
}

} // namespace io
} // namespace pcl_uvol
