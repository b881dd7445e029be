// SPDX-License-Identifier: BSD-3-Clause
// Reads vertices of PLY files: no reader at hand keeps the names and types of all
// properties and finds truncated files.
#include "files.h"
#include "formats.h"
#include "numbers.h"
#include "ply_types.h"
#include <pcl_uvol/common/scalar_field.h>

#include <algorithm>
#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;
using Words = std::vector<std::string_view>;

struct Property {
  std::string name;
  std::uint8_t datatype = 0;
  std::uint8_t length_type = 0; ///< of the number in front of a list, 0 for a scalar
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool
  hasLists() const
  {
    return std::any_of(properties.begin(), properties.end(), [](const Property& p) {
      return p.length_type != 0;
    });
  }

  /** Bytes of the scalars. */
  std::uint64_t
  bytes() const
  {
    std::uint64_t sum = 0;
    for (const auto& property : properties)
      if (property.length_type == 0)
        sum += datatypeSize(property.datatype);
    return sum;
  }
};

enum class Format { None, Ascii, LittleEndian, BigEndian };

struct Header {
  Format format = Format::None;
  std::vector<Element> elements; ///< up to the vertices
  std::size_t lines = 0;
};

/** The scalars. */
Fields
fieldsOf(const Element& element)
{
  Fields fields;
  for (const auto& property : element.properties)
    if (property.length_type == 0)
      appendField(fields, property.name, property.datatype);
  return fields;
}

/** The vertices of a file, record by record. */
class PlyReader {
public:
  /** \param most bytes to read: all that follow the header, or none of them */
  PlyReader(const std::string& path, std::uint64_t most);

  Dataset
  read();

  /** \param file_bytes of the whole file */
  std::optional<PromisedCloud>
  promise(std::uint64_t file_bytes) const;

private:
  void
  parseHeader(Lines& lines);
  void
  parseProperty(const Words& words, std::size_t line);
  const Element&
  findVertex() const;
  std::uint64_t
  leastBytes(const Element& element) const;
  void
  checkCount(const Element& element) const;
  void
  skip(const Element& element);
  void
  readBinary(const Element& vertex, pcl::PCLPointCloud2& records);
  void
  readAscii(const Element& vertex, pcl::PCLPointCloud2& records);

  [[noreturn]] void
  throwTruncated(const Element& element) const;
  const char*
  take(std::uint64_t bytes, const Element& element);
  void
  copyNumber(const char* from, std::uint8_t datatype, std::uint8_t* to) const;
  std::uint64_t
  takeListLength(const Property& list, const Element& element);
  bool
  nextLine(Words& words);

  const std::string path_;
  std::string bytes_;
  Header header_;
  std::string_view body_;
  Lines lines_{std::string_view()}; ///< of an ascii body
};

PlyReader::PlyReader(const std::string& path, std::uint64_t most)
    : path_(path)
{
  bytes_ = InputFile(path).head(most);
  Lines lines(bytes_);
  parseHeader(lines);
  body_ = lines.rest();
  lines_ = Lines(body_, lines.lineNumber());
}

void
PlyReader::parseProperty(const Words& words, std::size_t line)
{
  if (header_.elements.empty())
    throwUnreadable(path_, line, "a property comes before any element");
  Property property;
  std::size_t type = 1;
  if (words.size() == 5 && words[1] == "list") {
    property.length_type = plyDatatype(words[2]);
    type = 3;
    if (property.length_type == 0 || property.length_type == Type::FLOAT32 ||
        property.length_type == Type::FLOAT64)
      throwUnreadable(path_,
                      line,
                      "'" + std::string(words[2]) + "' is no type for a list's length");
  }
  if (words.size() != type + 2)
    throwUnreadable(path_, line, "a property needs a type and a name");
  property.datatype = plyDatatype(words[type]);
  property.name = words[type + 1];
  if (property.datatype == 0)
    throwUnreadable(path_,
                    line,
                    "the property '" + property.name + "' has the type '" +
                        std::string(words[type]) + "', which PLY does not have");
  header_.elements.back().properties.push_back(property);
}

void
PlyReader::parseHeader(Lines& lines)
{
  std::string_view line;
  if (!lines.next(line) || line != "ply")
    throwUnreadable(path_, "it is no PLY file: its first line is not 'ply'");
  Words words;
  while (lines.next(line)) {
    splitWords(line, words);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info")
      continue;
    if (words[0] == "end_header") {
      if (header_.format == Format::None)
        throwUnreadable(path_, "its header has no format line");
      return;
    }
    if (words[0] == "format") {
      if (words.size() == 3 && words[1] == "ascii")
        header_.format = Format::Ascii;
      else if (words.size() == 3 && words[1] == "binary_little_endian")
        header_.format = Format::LittleEndian;
      else if (words.size() == 3 && words[1] == "binary_big_endian")
        header_.format = Format::BigEndian;
      else
        throwUnreadable(path_,
                        lines.lineNumber(),
                        "the format is none of ascii, binary_little_endian and "
                        "binary_big_endian");
    }
    else if (words[0] == "element") {
      Element element;
      if (words.size() != 3 || !parseCount(words[2], element.count))
        throwUnreadable(
            path_, lines.lineNumber(), "an element needs a name and a count");
      element.name = words[1];
      header_.elements.push_back(element);
    }
    else if (words[0] == "property")
      parseProperty(words, lines.lineNumber());
    else
      throwUnreadable(path_, lines.lineNumber(), "this is no line of a PLY header");
  }
  throwUnreadable(path_, "its header has no end_header line");
}

void
PlyReader::throwTruncated(const Element& element) const
{
  throwUnreadable(path_,
                  "it is truncated or damaged: its header promises " +
                      std::to_string(element.count) + " of the element " +
                      element.name + ", but the file ends before");
}

/** Of one of them in the file. */
std::uint64_t
PlyReader::leastBytes(const Element& element) const
{
  if (header_.format == Format::Ascii)
    return 2 * element.properties.size(); // a digit and a blank each
  std::uint64_t least = element.bytes();
  for (const auto& property : element.properties)
    least += property.length_type ? datatypeSize(property.length_type) : 0;
  return least;
}

/** Before any memory is taken: does that much follow at all? */
void
PlyReader::checkCount(const Element& element) const
{
  const std::uint64_t least = leastBytes(element);
  if (least > 0 && element.count > (body_.size() + 1) / least)
    throwTruncated(element);
}

const char*
PlyReader::take(std::uint64_t bytes, const Element& element)
{
  if (bytes > body_.size())
    throwTruncated(element);
  const char* const start = body_.data();
  body_.remove_prefix(bytes);
  return start;
}

void
PlyReader::copyNumber(const char* from, std::uint8_t datatype, std::uint8_t* to) const
{
  const std::size_t bytes = datatypeSize(datatype);
  std::memcpy(to, from, bytes);
  if (header_.format == Format::BigEndian)
    std::reverse(to, to + bytes);
}

std::uint64_t
PlyReader::takeListLength(const Property& list, const Element& element)
{
  std::uint8_t bytes[8];
  copyNumber(take(datatypeSize(list.length_type), element), list.length_type, bytes);
  const double length = FieldComponent{0, list.length_type}.read(bytes);
  if (length < 0)
    throwUnreadable(path_, "a list '" + list.name + "' has a negative length");
  return static_cast<std::uint64_t>(length);
}

bool
PlyReader::nextLine(Words& words)
{
  std::string_view line;
  while (lines_.next(line)) {
    splitWords(line, words);
    if (!words.empty())
      return true;
  }
  return false;
}

void
PlyReader::skip(const Element& element)
{
  checkCount(element);
  if (element.properties.empty())
    return;
  if (header_.format == Format::Ascii) {
    Words words;
    for (std::uint64_t i = 0; i < element.count; ++i)
      if (!nextLine(words))
        throwTruncated(element);
    return;
  }
  if (!element.hasLists()) {
    take(element.bytes() * element.count, element);
    return;
  }
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const auto& property : element.properties) {
      const std::uint64_t length =
          property.length_type ? takeListLength(property, element) : 1;
      take(length * datatypeSize(property.datatype), element);
    }
}

void
PlyReader::readBinary(const Element& vertex, pcl::PCLPointCloud2& records)
{
  std::uint8_t* to = records.data.data();
  if (header_.format == Format::LittleEndian && !vertex.hasLists()) {
    if (!records.data.empty())
      std::memcpy(to, take(records.data.size(), vertex), records.data.size());
    return;
  }
  for (std::uint64_t i = 0; i < vertex.count; ++i)
    for (const auto& property : vertex.properties) {
      const std::size_t bytes = datatypeSize(property.datatype);
      if (property.length_type) {
        take(takeListLength(property, vertex) * bytes, vertex);
        continue;
      }
      copyNumber(take(bytes, vertex), property.datatype, to);
      to += bytes;
    }
}

void
PlyReader::readAscii(const Element& vertex, pcl::PCLPointCloud2& records)
{
  std::uint8_t* to = records.data.data();
  Words words;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    if (!nextLine(words))
      throwTruncated(vertex);
    std::size_t word = 0;
    for (const auto& property : vertex.properties) {
      if (word >= words.size())
        throwUnreadable(path_, lines_.lineNumber(), "there are too few numbers");
      const std::string_view text = words[word++];
      std::uint64_t length = 0;
      if (property.length_type) {
        if (!parseCount(text, length) || length > words.size() - word)
          throwUnreadable(path_,
                          lines_.lineNumber(),
                          "'" + std::string(text) + "' is no length of the list '" +
                              property.name + "'");
        word += length;
        continue;
      }
      if (!parseNumber(text, property.datatype, to))
        throwUnreadable(path_,
                        lines_.lineNumber(),
                        "'" + std::string(text) + "' is no number for the property " +
                            property.name + " (" + plyTypeName(property.datatype) +
                            ")");
      to += datatypeSize(property.datatype);
    }
    if (word != words.size())
      throwUnreadable(path_, lines_.lineNumber(), "there are too many numbers");
  }
}

const Element&
PlyReader::findVertex() const
{
  const auto is_vertex = [](const Element& e) { return e.name == "vertex"; };
  const auto vertex =
      std::find_if(header_.elements.begin(), header_.elements.end(), is_vertex);
  if (vertex == header_.elements.end())
    throwUnreadable(path_, "it has no element 'vertex'");
  return *vertex;
}

std::optional<PromisedCloud>
PlyReader::promise(std::uint64_t file_bytes) const
{
  const Element& vertex = findVertex();
  const std::uint64_t least = leastBytes(vertex);
  if (least == 0 || vertex.count > (file_bytes + 1) / least)
    return std::nullopt;
  return promiseOf(fieldsOf(vertex), vertex.count, static_cast<double>(file_bytes));
}

Dataset
PlyReader::read()
{
  const Element& vertex = findVertex();
  for (const Element* element = header_.elements.data(); element != &vertex; ++element)
    skip(*element);
  if (header_.format == Format::Ascii)
    body_ = lines_.rest();
  checkCount(vertex);
  Fields fields = fieldsOf(vertex);
  std::vector<std::string> notes;
  for (const auto& property : vertex.properties)
    if (property.length_type != 0)
      notes.push_back("The list property '" + property.name +
                      "' of the vertices is left out.");
  if (fields.empty())
    throwUnreadable(path_, "its vertices have no coordinates");
  auto records = makeRecords(path_, std::move(fields), vertex.count);
  if (header_.format == Format::Ascii)
    readAscii(vertex, records);
  else
    readBinary(vertex, records);
  renameFields(records.fields, ply_normals, cloud_normals);
  Dataset dataset = makeDataset(path_, std::move(records));
  dataset.notes.insert(dataset.notes.end(), notes.begin(), notes.end());
  return dataset;
}

} // namespace

Dataset
readPly(const std::string& path)
{
  return PlyReader(path, InputFile(path).getSize()).read();
}

std::optional<PromisedCloud>
promisePly(const std::string& path)
{
  constexpr std::uint64_t header_room = 1u << 16; // for nearly every header
  const InputFile file(path);
  if (file.head(header_room).find("\nend_header") == std::string::npos)
    return std::nullopt;
  return PlyReader(path, header_room).promise(file.getSize());
}

} // namespace io
} // namespace pcl_uvol
