// SPDX-License-Identifier: BSD-3-Clause
// Reads .vtp, .vtu, .vts and .vti: the numbers that their tags promise. Of files whose
// cells are asked for it checks what they promise.
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/formats.h"
#include "io/little_endian.h"
#include "io/mesh_readers.h"
#include "io_vtk/encoded_bytes.h"
#include "io_vtk/vtk_messages.h"
#include "io_vtk/vtk_readers.h"
#include "io_vtk/vtk_xml_tags.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <limits>

namespace pcl_uvol {
namespace io {
namespace {

/** Reads the numbers that tags promise. */
class ArrayReader {
public:
  ArrayReader(const std::string& path, const TagCollector& tags)
      : path_(path)
      , tags_(tags)
      , cursor_(path)
  {
    encoding_.big_endian = tags.order == "BigEndian";
    encoding_.wide_headers = tags.header_type == "UInt64";
    chooseCompressor();
  }

  /** \param bytes gets the numbers of a piece */
  void
  read(const ArrayTag& array, std::uint64_t tuples, std::uint8_t* bytes);

  /** Before memory is taken for them. */
  void
  check(const ArrayTag& array, std::uint64_t tuples) const;

  /** Before another reader believes it: the numbers in front of the bytes as well. */
  void
  checkThoroughly(const ArrayTag& array, std::uint64_t tuples);

private:
  void
  chooseCompressor();
  std::uint64_t
  beginOf(const ArrayTag& array) const;
  std::uint64_t
  endOf(const ArrayTag& array) const;

  const std::string& path_;
  const TagCollector& tags_;
  FileCursor cursor_;
  ArrayEncoding encoding_;
  vtkSmartPointer<vtkDataCompressor> compressor_;
};

void
ArrayReader::chooseCompressor()
{
  if (tags_.compressor.empty())
    return;
  if (tags_.compressor == "vtkZLibDataCompressor") {
    compressor_ = vtkSmartPointer<vtkZLibDataCompressor>::New();
    encoding_.most_expansion = deflate_expansion;
  }
  else if (tags_.compressor == "vtkLZ4DataCompressor") {
    compressor_ = vtkSmartPointer<vtkLZ4DataCompressor>::New();
    encoding_.most_expansion = 255;
  }
  else if (tags_.compressor == "vtkLZMADataCompressor") {
    compressor_ = vtkSmartPointer<vtkLZMADataCompressor>::New();
    encoding_.most_expansion = 1u << 14; // zeros: measured 7000
  }
  else
    throwUnreadable(path_,
                    {"unsupported_value",
                     "the compressor",
                     shortenText(tags_.compressor),
                     "compressors of VTK"});
  encoding_.compressor = compressor_;
}

std::uint64_t
ArrayReader::beginOf(const ArrayTag& array) const
{
  if (array.format != "appended")
    return array.begin;
  if (array.offset >= tags_.appended_end - tags_.appended)
    throwUnreadable(path_, {"truncated_part", "the array " + quoteText(array.name)});
  return tags_.appended + array.offset;
}

std::uint64_t
ArrayReader::endOf(const ArrayTag& array) const
{
  return array.format == "appended" ? tags_.appended_end : array.end;
}

void
ArrayReader::check(const ArrayTag& array, std::uint64_t tuples) const
{
  const std::uint64_t bytes = endOf(array) - beginOf(array);
  const bool text = array.format == "ascii";
  checkFits(path_,
            array.name,
            array.components,
            tuples,
            text          ? 2
            : compressor_ ? 1
                          : datatypeSize(array.type->datatype),
            text ? bytes + 1 : bytes * encoding_.most_expansion);
}

void
ArrayReader::read(const ArrayTag& array, std::uint64_t tuples, std::uint8_t* bytes)
{
  check(array, tuples);
  const std::uint64_t count = array.components * tuples;
  const std::uint64_t begin = beginOf(array), end = endOf(array);
  if (array.format == "ascii") {
    cursor_.seek({begin, 0});
    return readTexts(path_, cursor_, end, array.type->datatype, count, bytes);
  }
  const bool appended = array.format == "appended";
  const std::size_t size = datatypeSize(array.type->datatype);
  EncodedBytes source(
      path_, cursor_.getFile(), begin, end, !appended || tags_.appended_base64);
  if (count > 0)
    readBlocks(path_, source, encoding_, count * size, bytes);
  if (encoding_.big_endian)
    swapBytes(bytes, size, count);
}

void
ArrayReader::checkThoroughly(const ArrayTag& array, std::uint64_t tuples)
{
  if (!array.type || tuples == 0)
    return;
  check(array, tuples);
  const std::uint64_t count = array.components * tuples;
  if (array.format == "ascii") {
    cursor_.seek({beginOf(array), 0});
    std::string_view word;
    for (std::uint64_t i = 0; i < count; ++i)
      if (!cursor_.nextWord(word) ||
          cursor_.tell().offset - word.size() >= endOf(array))
        throwUnreadable(path_,
                        {"truncated_part", "the array " + quoteText(array.name)});
    return;
  }
  EncodedBytes source(path_,
                      cursor_.getFile(),
                      beginOf(array),
                      endOf(array),
                      array.format != "appended" || tags_.appended_base64);
  checkBlocks(path_, source, encoding_, count * datatypeSize(array.type->datatype));
}

/** The whole numbers of an array of the polygons of a piece.
 * \param count of them */
std::vector<double>
readPolygonNumbers(const std::string& path,
                   ArrayReader& reader,
                   const Piece& piece,
                   const std::string& name,
                   std::uint64_t count)
{
  const auto array = std::find_if(
      piece.polygons.begin(), piece.polygons.end(), [&](const ArrayTag& tag) {
        return tag.name == name && tag.type && tag.components == 1;
      });
  if (array == piece.polygons.end())
    throwUnreadable(path, {"missing_part", "the array " + name + " of its polygons"});
  reader.check(*array, count);
  const std::size_t size = datatypeSize(array->type->datatype);
  std::vector<std::uint8_t> bytes(count * size);
  reader.read(*array, count, bytes.data());
  std::vector<double> numbers;
  for (std::size_t at = 0; at < bytes.size(); at += size)
    numbers.push_back(FieldComponent{at, array->type->datatype}.read(bytes.data()));
  return numbers;
}

/** Adds the fans of the polygons of a piece.
 * \param first of its points among all */
void
addPolygons(const std::string& path,
            ArrayReader& reader,
            const Piece& piece,
            std::uint64_t first,
            std::vector<Triangle>& triangles)
{
  const std::vector<double> ends =
      readPolygonNumbers(path, reader, piece, "offsets", piece.polygon_count);
  const std::vector<double> corners =
      readPolygonNumbers(path, reader, piece, "connectivity", countCorners(path, ends));
  addFans(path, ends, corners, piece.points, first, triangles);
}

/** A file that is cut off may have lost nothing but its end. */
void
checkEnd(const std::string& path)
{
  const InputFile file(path);
  const std::uint64_t size = std::min(file.getSize(), tail_bytes);
  std::string end(size, '\0');
  file.read(file.getSize() - size, end.data(), end.size());
  if (end.find("</VTKFile>") == std::string::npos)
    throwUnreadable(path, {"missing_part", "</VTKFile> at its end"});
}

/** Calls visit(first point in the whole, number of points) for the rows of a part of a
 * grid, in its order. */
template <typename Visit>
void
forRows(const Extent& whole, const Extent& part, const Visit& visit)
{
  const auto size = [](const Extent& extent, std::size_t axis) {
    return static_cast<std::size_t>(std::int64_t(extent[2 * axis + 1]) -
                                    extent[2 * axis] + 1);
  };
  const auto shift = [&](std::size_t axis) {
    return static_cast<std::size_t>(std::int64_t(part[2 * axis]) - whole[2 * axis]);
  };
  for (std::size_t z = 0; z < size(part, 2); ++z)
    for (std::size_t y = 0; y < size(part, 1); ++y)
      visit(((z + shift(2)) * size(whole, 1) + y + shift(1)) * size(whole, 0) +
                shift(0),
            size(part, 0));
}

/** Makes data of VTK from the pieces of a file. */
class Assembler {
public:
  explicit Assembler(const std::string& path)
      : path_(path)
      , tags_(path)
  {
  }

  VtkContent
  assemble();

private:
  void
  checkPieces();
  vtkSmartPointer<vtkDataArray>
  gather(ArrayReader& reader, bool coordinates, std::size_t index) const;
  void
  addPointData(ArrayReader& reader, VtkContent& content) const;
  vtkSmartPointer<vtkDataSet>
  makeGeometry(ArrayReader& reader) const;
  bool
  isGrid() const
  {
    return tags_.kind == "ImageData" || tags_.kind == "StructuredGrid";
  }
  void
  gatherGrid(ArrayReader& reader,
             const std::vector<const ArrayTag*>& arrays,
             std::size_t tuple_bytes,
             std::uint8_t* to) const;

  const std::string& path_;
  TagCollector tags_;
  std::uint64_t points_ = 0;
};

/** The pieces that have points; they have the same arrays, and grids are covered. */
void
Assembler::checkPieces()
{
  auto& pieces = tags_.pieces;
  const Piece first = pieces.empty() ? Piece() : pieces.front();
  pieces.erase(std::remove_if(pieces.begin(),
                              pieces.end(),
                              [](const Piece& piece) { return piece.points == 0; }),
               pieces.end());
  if (pieces.empty())
    pieces.push_back(first); // for its arrays
  for (const Piece& piece : pieces) {
    if (piece.points > std::numeric_limits<std::int64_t>::max() / 64 - points_)
      throwUnreadable(path_, {"uncountable", "points"});
    points_ += piece.points;
    const auto is_same = [](const ArrayTag& a, const ArrayTag& b) {
      return a.name == b.name && a.type == b.type && a.components == b.components;
    };
    const auto have_same = [&](const auto& some, const auto& others) {
      return std::equal(
          some.begin(), some.end(), others.begin(), others.end(), is_same);
    };
    if (!have_same(piece.arrays, pieces[0].arrays) ||
        !have_same(piece.coordinates, pieces[0].coordinates))
      throwUnreadable(path_, {"disagreeing_parts", "the arrays of its pieces"});
    if (tags_.kind != "ImageData" && piece.points > 0 &&
        (piece.coordinates.size() != 1 || piece.coordinates[0].components != 3 ||
         !piece.coordinates[0].type))
      throwUnreadable(path_,
                      {"missing_part", "an array of three coordinates in a piece"});
  }
  if (!isGrid())
    return;
  if (countOf(tags_.whole) > points_)
    throwUnreadable(path_,
                    {"wrong_count",
                     "the list of its pieces",
                     points_,
                     "points",
                     countOf(tags_.whole)});
  points_ = countOf(tags_.whole);
}

/** Reads an array of all pieces of a grid, which may share the points between them. */
void
Assembler::gatherGrid(ArrayReader& reader,
                      const std::vector<const ArrayTag*>& arrays,
                      std::size_t tuple_bytes,
                      std::uint8_t* to) const
{
  std::vector<bool> covered(points_);
  std::vector<std::uint8_t> part;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const Piece& piece = tags_.pieces[i];
    part.resize(piece.points * tuple_bytes);
    reader.read(*arrays[i], piece.points, part.data());
    const std::uint8_t* from = part.data();
    forRows(tags_.whole, piece.extent, [&](std::size_t first, std::size_t count) {
      std::copy_n(from, count * tuple_bytes, to + first * tuple_bytes);
      std::fill_n(covered.begin() + static_cast<std::ptrdiff_t>(first), count, true);
      from += count * tuple_bytes;
    });
  }
  if (std::find(covered.begin(), covered.end(), false) != covered.end())
    throwUnreadable(path_, {"missing_part", "a piece of its grid"});
}

vtkSmartPointer<vtkDataArray>
Assembler::gather(ArrayReader& reader, bool coordinates, std::size_t index) const
{
  std::vector<const ArrayTag*> arrays;
  for (const Piece& piece : tags_.pieces) {
    arrays.push_back(coordinates ? &piece.coordinates[index] : &piece.arrays[index]);
    reader.check(*arrays.back(), piece.points);
  }
  const ArrayTag& first = *arrays[0];
  auto array = makeArray(
      *first.type, coordinates ? "Points" : first.name, first.components, points_);
  const std::size_t tuple_bytes =
      datatypeSize(first.type->datatype) * static_cast<std::size_t>(first.components);
  std::uint8_t* to = bytesOf(*array);
  if (isGrid() && arrays.size() > 1) {
    gatherGrid(reader, arrays, tuple_bytes, to);
    return array;
  }
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    reader.read(*arrays[i], tags_.pieces[i].points, to);
    to += tags_.pieces[i].points * tuple_bytes;
  }
  return array;
}

void
Assembler::addPointData(ArrayReader& reader, VtkContent& content) const
{
  auto& point_data = *content.data->GetPointData();
  for (std::size_t i = 0; i < tags_.pieces[0].arrays.size(); ++i) {
    const ArrayTag& tag = tags_.pieces[0].arrays[i];
    if (!tag.type) {
      content.notes.push_back(describeTexts(tag.name));
      continue;
    }
    const auto array = gather(reader, false, i);
    point_data.AddArray(array);
    if (!tag.name.empty() && tag.name == tags_.scalars)
      point_data.SetScalars(array);
    if (!tag.name.empty() && tag.name == tags_.normals && tag.components == 3)
      point_data.SetNormals(array);
  }
}

vtkSmartPointer<vtkDataSet>
Assembler::makeGeometry(ArrayReader& reader) const
{
  if (tags_.kind == "ImageData") {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetExtent(tags_.whole[0],
                     tags_.whole[1],
                     tags_.whole[2],
                     tags_.whole[3],
                     tags_.whole[4],
                     tags_.whole[5]);
    image->SetOrigin(tags_.origin.data());
    image->SetSpacing(tags_.spacing.data());
    image->SetDirectionMatrix(tags_.direction.data());
    return image;
  }
  auto set = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  if (points_ > 0)
    points->SetData(gather(reader, true, 0));
  else
    points->SetNumberOfPoints(0);
  set->SetPoints(points);
  return set;
}

VtkContent
Assembler::assemble()
{
  tags_.collect();
  checkPieces();
  ArrayReader reader(path_, tags_);
  VtkContent content{makeGeometry(reader), {}};
  addPointData(reader, content);
  for (const std::string& name : tags_.cell_arrays) {
    vtkNew<vtkFloatArray> array; // its name is all that is asked for
    array->SetName(name.c_str());
    content.data->GetCellData()->AddArray(array);
  }
  checkLattice(path_, *content.data);
  return content;
}

} // namespace

std::vector<Triangle>
readVtpTriangles(const std::string& path)
{
  checkEnd(path);
  const VtkMessages messages; // of unpacking
  TagCollector tags(path);
  tags.collect();
  ArrayReader reader(path, tags);
  std::vector<Triangle> triangles;
  std::uint64_t first = 0;
  for (const Piece& piece : tags.pieces) {
    if (piece.polygon_count > 0)
      addPolygons(path, reader, piece, first, triangles);
    first += piece.points;
  }
  return triangles;
}

void
checkVtkXml(const std::string& path)
{
  checkEnd(path);
  TagCollector tags(path, true);
  tags.collect();
  ArrayReader reader(path, tags);
  for (const Piece& piece : tags.pieces) {
    for (const ArrayTag& array : piece.cell_arrays)
      reader.checkThoroughly(array, piece.cells);
    for (const ArrayTag& array : piece.arrays)
      reader.checkThoroughly(array, piece.points);
    for (const ArrayTag& array : piece.coordinates)
      reader.checkThoroughly(array, piece.points);
  }
  if (tags.kind == "PolyData" || tags.kind == "UnstructuredGrid")
    return;
  const Extent whole = cellsOf(tags.whole);
  std::uint64_t cells = 0;
  for (const Piece& piece : tags.pieces)
    cells += piece.cells;
  const auto refuse = [&] {
    throwUnreadable(path, {"missing_part", "a piece of its grid"});
  };
  if (cells < countOf(whole))
    refuse();
  if (tags.pieces.size() < 2)
    return;
  std::vector<bool> covered(countOf(whole));
  for (const Piece& piece : tags.pieces)
    forRows(whole, cellsOf(piece.extent), [&](std::size_t first, std::size_t count) {
      std::fill_n(covered.begin() + static_cast<std::ptrdiff_t>(first), count, true);
    });
  if (std::find(covered.begin(), covered.end(), false) != covered.end())
    refuse();
}

VtkContent
readVtkXml(const std::string& path)
{
  checkEnd(path);
  const VtkMessages messages; // of unpacking
  return Assembler(path).assemble();
}

} // namespace io
} // namespace pcl_uvol
