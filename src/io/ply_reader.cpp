// SPDX-License-Identifier: BSD-3-Clause
// Reads vertices of PLY files: no reader at hand keeps the names and types of all
// properties and finds truncated files.
#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/formats.h"
#include "io/label_comments.h"
#include "io/ply_header.h"
#include "io/ply_types.h"
#include "io/record_source.h"

#include <algorithm>
#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;
using Words = std::vector<std::string_view>;

[[noreturn]] void
throwTruncated(const std::string& path, const PlyElement& element)
{
  throwUnreadable(path,
                  {"truncated_part",
                   "the element " + quoteText(element.name) + " of " +
                       std::to_string(element.count) + " rows"});
}

/** Before any memory is taken: do that many bytes follow at all? */
void
checkCount(const std::string& path,
           const PlyElement& element,
           PlyFormat format,
           std::uint64_t left)
{
  std::uint64_t least = element.bytes();
  for (const auto& property : element.properties)
    least += property.length_type ? datatypeSize(property.length_type) : 0;
  if (format == PlyFormat::Ascii) { // a digit and a blank each, but for the last
    least = 2 * element.properties.size();
    ++left;
  }
  if (least > 0 && element.count > left / least)
    throwTruncated(path, element);
}

/** Lengths of lists are whole numbers of any type, see the header. */
void
checkLength(const std::string& path, const PlyProperty& property, double length)
{
  if (length < 0.0)
    throwUnreadable(
        path, {"invalid_part", "the length of a list " + quoteText(property.name)});
}

/** Takes the numbers of an element from a binary body. */
class BinaryElement {
public:
  BinaryElement(const std::string& path,
                FileCursor& cursor,
                const PlyElement& element,
                bool swapped)
      : path_(path)
      , cursor_(cursor)
      , element_(element)
      , swapped_(swapped)
  {
  }

  void
  take(std::uint8_t datatype, std::uint8_t* to);

  void
  skip(std::uint64_t bytes)
  {
    if (!cursor_.skip(bytes))
      throwTruncated(path_, element_);
  }

  void
  skip(const PlyProperty& property);

private:
  const std::string& path_;
  FileCursor& cursor_;
  const PlyElement& element_;
  const bool swapped_;
};

void
BinaryElement::take(std::uint8_t datatype, std::uint8_t* to)
{
  const std::size_t bytes = datatypeSize(datatype);
  const char* const from = cursor_.take(bytes);
  if (!from)
    throwTruncated(path_, element_);
  std::memcpy(to, from, bytes);
  if (swapped_)
    std::reverse(to, to + bytes);
}

void
BinaryElement::skip(const PlyProperty& property)
{
  double length = 1.0;
  if (property.length_type) {
    std::uint8_t bytes[8];
    take(property.length_type, bytes);
    length = FieldComponent{0, property.length_type}.read(bytes);
    checkLength(path_, property, length);
  }
  skip(static_cast<std::uint64_t>(length) * datatypeSize(property.datatype));
}

/** Vertices that are not of one size, because they have lists. */
class ListSource : public SequentialSource {
public:
  ListSource(const std::string& path,
             std::unique_ptr<FileCursor> cursor,
             RecordInfo info,
             const PlyElement& vertex,
             bool swapped)
      : SequentialSource(path, std::move(cursor), std::move(info))
      , vertex_(vertex)
      , binary_(path_, *cursor_, vertex_, swapped)
  {
  }

private:
  void
  readRecord(std::uint8_t* record) override
  {
    for (const auto& property : vertex_.properties)
      if (property.length_type)
        binary_.skip(property);
      else {
        binary_.take(property.datatype, record);
        record += datatypeSize(property.datatype);
      }
  }

  void
  skipRecord() override
  {
    for (const auto& property : vertex_.properties)
      binary_.skip(property);
  }

  const PlyElement vertex_;
  BinaryElement binary_;
};

/** Vertices as lines of numbers. */
class PlyAsciiSource : public SequentialSource {
public:
  PlyAsciiSource(const std::string& path,
                 std::unique_ptr<FileCursor> cursor,
                 RecordInfo info,
                 const PlyElement& vertex)
      : SequentialSource(path, std::move(cursor), std::move(info))
      , vertex_(vertex)
  {
  }

private:
  void
  readRecord(std::uint8_t* record) override;
  void
  skipRecord() override;
  [[noreturn]] void
  throwInLine(const FileReason& reason) const
  {
    throwUnreadable(path_, cursor_->tell().line, reason);
  }

  const PlyElement vertex_;
  Words words_;
};

void
PlyAsciiSource::skipRecord()
{
  if (!cursor_->nextWords(words_))
    throwTruncated(path_, vertex_);
}

void
PlyAsciiSource::readRecord(std::uint8_t* record)
{
  skipRecord();
  std::size_t word = 0;
  for (const auto& property : vertex_.properties) {
    if (word >= words_.size())
      throwInLine({"numbers_unlike_header", true});
    const std::string_view text = words_[word++];
    std::uint64_t length = 0;
    if (property.length_type) {
      if (!parseCount(text, length) || length > words_.size() - word)
        throwInLine({"unexpected_word",
                     shortenText(text),
                     "a valid length of the list " + quoteText(property.name)});
      word += length;
      continue;
    }
    if (!parseNumber(text, property.datatype, record))
      throwInLine({"unexpected_word",
                   shortenText(text),
                   "a number for the property " + property.name + " (" +
                       plyTypeName(property.datatype) + ")"});
    record += datatypeSize(property.datatype);
  }
  if (word != words_.size())
    throwInLine({"numbers_unlike_header", false});
}

/** Goes behind an element in front of the vertices. */
void
skipElement(const std::string& path,
            FileCursor& cursor,
            const PlyElement& element,
            PlyFormat format)
{
  checkCount(path, element, format, cursor.left());
  if (element.properties.empty())
    return;
  Words words;
  BinaryElement binary(path, cursor, element, format == PlyFormat::BigEndian);
  if (format != PlyFormat::Ascii && !element.hasLists())
    return binary.skip(element.bytes() * element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (format != PlyFormat::Ascii)
      for (const auto& property : element.properties)
        binary.skip(property);
    else if (!cursor.nextWords(words))
      throwTruncated(path, element);
  }
}

/** Takes the corners of faces as fans of triangles. */
class FaceReader {
public:
  /** \param vertices how many there are */
  FaceReader(const std::string& path,
             FileCursor& cursor,
             const PlyElement& face,
             PlyFormat format,
             std::uint64_t vertices)
      : path_(path)
      , cursor_(cursor)
      , face_(face)
      , is_text_(format == PlyFormat::Ascii)
      , vertices_(static_cast<double>(vertices))
      , binary_(path, cursor, face, format == PlyFormat::BigEndian)
  {
  }

  std::vector<Triangle>
  read()
  {
    for (std::uint64_t i = 0; i < face_.count; ++i) {
      if (is_text_ && !cursor_.nextWords(words_))
        throwTruncated(path_, face_);
      word_ = 0;
      for (const PlyProperty& property : face_.properties)
        takeProperty(property);
    }
    return std::move(triangles_);
  }

private:
  void
  takeProperty(const PlyProperty& property);
  double
  takeNumber(std::uint8_t datatype);

  const std::string& path_;
  FileCursor& cursor_;
  const PlyElement& face_;
  const bool is_text_;
  const double vertices_;
  BinaryElement binary_;
  Words words_;
  std::size_t word_ = 0;
  std::vector<Triangle> triangles_;
};

double
FaceReader::takeNumber(std::uint8_t datatype)
{
  std::uint8_t bytes[8];
  if (!is_text_)
    binary_.take(datatype, bytes);
  else if (word_ == words_.size())
    throwUnreadable(path_, cursor_.tell().line, {"numbers_unlike_header", true});
  else if (!parseNumber(words_[word_++], datatype, bytes))
    throwUnreadable(
        path_,
        cursor_.tell().line,
        {"unexpected_word", shortenText(words_[word_ - 1]), "a number for a face"});
  return FieldComponent{0, datatype}.read(bytes);
}

void
FaceReader::takeProperty(const PlyProperty& property)
{
  const double length = property.length_type ? takeNumber(property.length_type) : 1.0;
  const bool corners = property.length_type && (property.name == "vertex_indices" ||
                                                property.name == "vertex_index");
  checkLength(path_, property, length);
  const auto count = static_cast<std::uint64_t>(length);
  Triangle triangle{};
  for (std::uint64_t k = 0; k < count; ++k) {
    const double number = takeNumber(property.datatype);
    if (!corners)
      continue;
    if (!(number >= 0.0 && number < vertices_))
      throwUnreadable(path_, {"missing_target", "a face", "a vertex"});
    triangle[1] = triangle[2];
    triangle[2] = static_cast<std::uint32_t>(number);
    if (k == 0)
      triangle[0] = triangle[2];
    if (k >= 2)
      triangles_.push_back(triangle);
  }
}

/** Reads the header and goes in front of the first element of that name.
 * \param behind_vertices if they have been read already
 * \return null if there is none */
const PlyElement*
findElement(const std::string& path,
            FileCursor& cursor,
            const std::string& name,
            PlyHeader& header,
            const FileCursor::Place* behind_vertices = nullptr)
{
  header = readPlyHeader(path, cursor);
  for (const PlyElement& element : header.elements) {
    if (element.name == name) {
      checkCount(path, element, header.format, cursor.left());
      return &element;
    }
    if (behind_vertices && element.name == "vertex")
      cursor.seek(*behind_vertices);
    else
      skipElement(path, cursor, element, header.format);
  }
  return nullptr;
}

RecordInfo
makeInfo(const std::string& path, const PlyElement& vertex, LabelNames&& labels)
{
  RecordInfo info;
  info.count = vertex.count;
  for (const auto& property : vertex.properties)
    if (property.length_type == 0)
      appendField(info.fields, property.name, property.datatype);
    else
      info.notes.push_back(
          {"list_property", {{"property", shortenText(property.name)}}});
  if (info.fields.empty())
    throwUnreadable(path, {"missing_part", "a coordinate of its vertices"});
  renameFields(info.fields, ply_normals, cloud_normals);
  info.labels = std::move(labels);
  return info;
}

} // namespace

std::unique_ptr<RecordSource>
openPly(const std::string& path)
{
  auto cursor = std::make_unique<FileCursor>(path);
  PlyHeader header;
  const PlyElement* const vertex = findElement(path, *cursor, "vertex", header);
  if (!vertex)
    throwUnreadable(path, {"missing_part", "the element 'vertex'"});
  RecordInfo info = makeInfo(path, *vertex, std::move(header.labels));
  const bool swapped = header.format == PlyFormat::BigEndian;
  if (header.format == PlyFormat::Ascii)
    return std::make_unique<PlyAsciiSource>(
        path, std::move(cursor), std::move(info), *vertex);
  if (vertex->hasLists())
    return std::make_unique<ListSource>(
        path, std::move(cursor), std::move(info), *vertex, swapped);
  return std::make_unique<FixedSource>(
      path, std::move(info), cursor->tell().offset, swapped);
}

LoadedMesh
readPlyMesh(const std::string& path)
{
  FileCursor::Place behind_vertices;
  LoadedMesh mesh{readWhole(openPly(path), nullptr, &behind_vertices), {}};
  FileCursor cursor(path);
  PlyHeader header;
  const PlyElement* const face =
      findElement(path, cursor, "face", header, &behind_vertices);
  if (face)
    mesh.triangles =
        FaceReader(path, cursor, *face, header.format, mesh.vertices.cloud.width)
            .read();
  return mesh;
}

} // namespace io
} // namespace pcl_uvol
