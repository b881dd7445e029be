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
  throwInLine(const std::string& reason) const
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
    throwInLine("a property comes before any element");
  PlyProperty property;
  std::size_t type = 1;
  if (words.size() == 5 && words[1] == "list") {
    property.length_type = plyDatatype(words[2]);
    type = 3;
    if (property.length_type == 0 || property.length_type == Type::FLOAT32 ||
        property.length_type == Type::FLOAT64)
      throwInLine(quoteText(words[2]) +
                  " is not a valid type for the length of a list");
  }
  if (words.size() != type + 2)
    throwInLine("a property needs a type and a name");
  property.datatype = plyDatatype(words[type]);
  property.name = words[type + 1];
  if (property.datatype == 0)
    throwInLine("the property " + quoteText(property.name) + " has the type " +
                quoteText(words[type]) + ", which PLY does not have");
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
  throwInLine("the format is not ascii, binary_little_endian or "
              "binary_big_endian");
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
      throwInLine("an element needs a name and a count");
    element.name = words[1];
    header_.elements.push_back(element);
  }
  else if (words[0] == "property")
    takeProperty(words);
  else
    throwInLine("the line does not belong to a PLY header");
}

PlyHeader
PlyHeaderParser::parse()
{
  std::string_view line;
  if (!cursor_.nextLine(line) || line != "ply")
    throwUnreadable(path_, "it is not a PLY file: its first line is not 'ply'");
  Words words;
  while (cursor_.nextLine(line)) {
    splitWords(line, words);
    if (words.empty())
      continue;
    if (words[0] == "end_header") {
      if (header_.format == PlyFormat::None)
        throwUnreadable(path_, "its header has no format line");
      return std::move(header_);
    }
    takeLine(line, words);
  }
  throwUnreadable(path_, "its header has no end_header line");
}

} // namespace

PlyHeader
readPlyHeader(const std::string& path, FileCursor& cursor)
{
  return PlyHeaderParser(path, cursor).parse();
}

} // namespace io
} // namespace pcl_uvol
