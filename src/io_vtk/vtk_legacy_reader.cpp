// SPDX-License-Identifier: BSD-3-Clause
// Reads legacy .vtk: points, lattices and the data of their points. Cells are passed
// over by their counts, which nothing else depends on.
#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io_vtk/vtk_arrays.h"
#include "io_vtk/vtk_legacy_body.h"
#include "io_vtk/vtk_readers.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>

namespace pcl_uvol {
namespace io {
namespace {

using Words = std::vector<std::string_view>;
using Array = vtkSmartPointer<vtkDataArray>;

/** The four lines in front of the data. */
struct Header {
  bool binary = false;
  std::string kind; ///< in lower case
};

Header
takeHeader(const std::string& path, FileCursor& cursor)
{
  std::string_view line;
  if (!cursor.nextLine(line) || line.substr(0, 14) != "# vtk DataFile")
    throwUnreadable(path, {"wrong_start", "a VTK file", "'# vtk DataFile'"});
  cursor.nextLine(line); // the title
  Words words;
  Header header;
  const std::string format =
      cursor.nextWords(words) ? lowerCase(words[0]) : std::string();
  if (format != "ascii" && format != "binary")
    throwUnreadable(path, 3, {"missing_part", "the line ASCII or BINARY"});
  header.binary = format == "binary";
  if (!cursor.nextWords(words) || words.size() != 2 || lowerCase(words[0]) != "dataset")
    throwUnreadable(
        path, cursor.tell().line, {"missing_part", "the DATASET of its points"});
  header.kind = lowerCase(words[1]);
  return header;
}

class LegacyReader {
public:
  explicit LegacyReader(const std::string& path)
      : path_(path)
      , cursor_(path)
      , header_(takeHeader(path, cursor_))
      , body_(path_, cursor_, header_.binary)
  {
  }

  VtkContent
  read();

  /** Takes all that the file holds. */
  void
  scan();

private:
  enum class Data { None, Points, Cells };

  bool
  takeGeometry(const std::string& key);
  bool
  takeCells(const std::string& key);
  bool
  takeAttribute(const std::string& key);
  void
  takeScalars();
  void
  takeColors();
  void
  takeField();
  void
  keep(const Array& array);
  void
  takeData(Data data);
  std::uint64_t
  count(std::size_t word) const;
  std::uint64_t
  tuples() const
  {
    return data_ == Data::Points ? points_ : cells_;
  }
  vtkSmartPointer<vtkDataSet>
  makeGeometry() const;

  [[noreturn]] void
  fail(const FileReason& reason) const
  {
    throwUnreadable(path_, cursor_.tell().line, reason);
  }

  /** A word of the line; a line has as many as its keyword needs. */
  std::string_view
  word(std::size_t i) const
  {
    if (i >= words_.size())
      fail({"incomplete_entry", quoteText(words_[0]), "more words"});
    return words_[i];
  }

  const std::string& path_;
  FileCursor cursor_;
  Header header_;
  LegacyBody body_;
  std::vector<std::string> words_; ///< of the line; kept while the cursor goes on
  Data data_ = Data::None;
  std::uint64_t points_ = 0, cells_ = 0;
  std::optional<std::array<std::uint64_t, 3>> dims_;
  std::array<double, 3> origin_{{0.0, 0.0, 0.0}}, spacing_{{1.0, 1.0, 1.0}};
  std::array<Array, 3> axes_;
  Array coordinates_;
  std::vector<Array> arrays_;
  Array scalars_, normals_;
  std::set<std::string> cell_arrays_; ///< names of data of cells
  std::vector<Message> notes_;
};

std::uint64_t
LegacyReader::count(std::size_t i) const
{
  std::uint64_t value = 0;
  if (!parseCount(word(i), value))
    fail({"unexpected_word", shortenText(word(i)), "a count"});
  return value;
}

void
LegacyReader::keep(const Array& array)
{
  if (data_ == Data::Points)
    arrays_.push_back(array);
  else if (data_ == Data::Cells)
    cell_arrays_.insert(array->GetName() ? array->GetName() : "");
  checkArrayCount(path_, std::max(arrays_.size(), cell_arrays_.size()));
}

/** DIMENSIONS, POINTS, ...
 * \return false for another keyword */
bool
LegacyReader::takeGeometry(const std::string& key)
{
  const auto numbers = [this] {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i)
      if (!parseNumber(word(i + 1), values[i]))
        fail({"unexpected_word", shortenText(word(i + 1)), "a number"});
    return values;
  };
  if (key == "dimensions") {
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    dims_ = {count(1), count(2), count(3)};
    std::uint64_t product = 1;
    for (const std::uint64_t size : *dims_) {
      if (size > most || (size > 0 && product > (std::uint64_t(1) << 62) / size))
        fail({"uncountable", "points"});
      product *= size;
    }
    points_ = product;
  }
  else if (key == "spacing" || key == "aspect_ratio")
    spacing_ = numbers();
  else if (key == "origin")
    origin_ = numbers();
  else if (key == "points") {
    const std::uint64_t points = count(1);
    if (dims_ && points != points_)
      fail({"wrong_count", "the grid", points, "points", points_});
    points_ = points;
    coordinates_ = body_.readArray(lowerCase(word(2)), "Points", 3, points);
  }
  else if (key.size() == 13 && key.substr(1) == "_coordinates" && key[0] >= 'x' &&
           key[0] <= 'z') {
    Array& axis = axes_[static_cast<std::size_t>(key[0] - 'x')];
    axis = body_.readArray(lowerCase(word(2)), key, 1, count(1));
  }
  else
    return false;
  return true;
}

/** \return false for another keyword */
bool
LegacyReader::takeCells(const std::string& key)
{
  if (key == "cell_types") {
    body_.skipNumbers(*findLegacyType("int"), count(1));
    return true;
  }
  if (key != "cells" && key != "vertices" && key != "lines" && key != "polygons" &&
      key != "triangle_strips")
    return false;
  const std::uint64_t sizes[] = {count(1), count(2)};
  const auto place = cursor_.tell();
  std::string_view first;
  const bool lists = cursor_.nextWord(first) && lowerCase(first) == "offsets";
  cursor_.seek(place);
  if (!lists) { // all in one list, as before version 5
    body_.skipNumbers(*findLegacyType("int"), sizes[1]);
    return true;
  }
  for (const std::uint64_t size : sizes) {
    Words words;
    const bool has_type = cursor_.nextWords(words) && words.size() == 2;
    const VtkType* const type = findLegacyType(has_type ? lowerCase(words[1]) : "");
    if (!type)
      fail({"missing_part", "OFFSETS or CONNECTIVITY of its cells"});
    body_.skipNumbers(*type, size);
  }
  return true;
}

void
LegacyReader::takeScalars()
{
  const std::string name = decodeLegacyName(word(1)), type = lowerCase(word(2));
  const std::uint64_t components = words_.size() > 3 ? count(3) : 1;
  Words words;
  const auto place = cursor_.tell();
  if (!cursor_.nextWords(words) || lowerCase(words[0]) != "lookup_table")
    cursor_.seek(place);
  const Array array = body_.readArray(type, name, components, tuples());
  keep(array);
  if (data_ == Data::Points && !scalars_)
    scalars_ = array;
}

/** Colours are bytes, as text numbers from 0 to 1. */
void
LegacyReader::takeColors()
{
  const std::string name = decodeLegacyName(word(1));
  const std::uint64_t components = count(2);
  Array array;
  if (body_.isBinary())
    array = body_.readArray("unsigned_char", name, components, tuples());
  else {
    const Array values = body_.readArray("float", name, components, tuples());
    array = makeArray(*findLegacyType("unsigned_char"), name, components, tuples());
    for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i) {
      const double value = values->GetVariantValue(i).ToDouble();
      bytesOf(*array)[i] =
          static_cast<std::uint8_t>(std::clamp(255.0 * value + 0.5, 0.0, 255.0));
    }
  }
  keep(array);
  if (data_ == Data::Points && !scalars_)
    scalars_ = array;
}

/** Arrays of any number, which are data of points or cells, or of the whole. */
void
LegacyReader::takeField()
{
  const std::uint64_t arrays = count(2);
  for (std::uint64_t i = 0; i < arrays; ++i) {
    Words words;
    if (!cursor_.nextWords(words))
      fail({"truncated_part", "a FIELD"});
    if (lowerCase(words[0]) == "metadata") {
      body_.skipMetadata();
      --i;
      continue;
    }
    words_.assign(words.begin(), words.end());
    const std::string name = decodeLegacyName(word(0)), type = lowerCase(word(3));
    const std::uint64_t components = count(1), tuples = count(2);
    if (type == "string") {
      if (components > 0 && tuples > cursor_.left() / components)
        fail({"truncated_part", "an array"});
      body_.skipTexts(components * tuples);
      if (data_ == Data::Points)
        notes_.push_back(describeTexts(name));
    }
    else if (components > 0 && tuples > 0)
      keep(body_.readArray(type, name, components, tuples));
  }
}

/** Data of points or cells.
 * \return false for another keyword */
bool
LegacyReader::takeAttribute(const std::string& key)
{
  if (key == "field") {
    takeField();
    return true;
  }
  if (data_ == Data::None)
    return false;
  constexpr std::pair<std::string_view, std::uint64_t> kinds[] = {{"vectors", 3},
                                                                  {"normals", 3},
                                                                  {"tensors", 9},
                                                                  {"tensors6", 6},
                                                                  {"global_ids", 1},
                                                                  {"pedigree_ids", 1},
                                                                  {"edge_flags", 1}};
  for (const auto& [kind, components] : kinds)
    if (key == kind) {
      const Array array = body_.readArray(
          lowerCase(word(2)), decodeLegacyName(word(1)), components, tuples());
      keep(array);
      if (key == "normals" && data_ == Data::Points && !normals_)
        normals_ = array;
      return true;
    }
  if (key == "scalars")
    takeScalars();
  else if (key == "color_scalars")
    takeColors();
  else if (key == "texture_coordinates")
    keep(body_.readArray(
        lowerCase(word(3)), decodeLegacyName(word(1)), count(2), tuples()));
  else if (key == "lookup_table") {
    const std::uint64_t rows = count(2);
    if (rows > cursor_.left())
      fail({"truncated_part", "a table of colours"});
    body_.skipNumbers(*findLegacyType("unsigned_char"), 4 * rows);
  }
  else
    return false;
  return true;
}

void
LegacyReader::takeData(Data data)
{
  data_ = data;
  if (data == Data::Cells)
    cells_ = count(1);
  else if (count(1) != points_)
    fail({"wrong_count", "POINT_DATA", count(1), "points", points_});
}

vtkSmartPointer<vtkDataSet>
LegacyReader::makeGeometry() const
{
  if (header_.kind == "structured_points" || header_.kind == "rectilinear_grid") {
    if (!dims_)
      throwUnreadable(path_, {"missing_part", "DIMENSIONS of its grid"});
    const auto dims = [this](std::size_t axis) {
      return static_cast<int>((*dims_)[axis]);
    };
    if (header_.kind == "structured_points") {
      auto image = vtkSmartPointer<vtkImageData>::New();
      image->SetDimensions(dims(0), dims(1), dims(2));
      image->SetOrigin(origin_.data());
      image->SetSpacing(spacing_.data());
      return image;
    }
    auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!axes_[axis] || axes_[axis]->GetNumberOfTuples() != dims(axis))
        throwUnreadable(path_,
                        {"disagreeing_parts",
                         std::string(1, static_cast<char>('X' + axis)) +
                             "_COORDINATES and DIMENSIONS"});
    grid->SetDimensions(dims(0), dims(1), dims(2));
    grid->SetXCoordinates(axes_[0]);
    grid->SetYCoordinates(axes_[1]);
    grid->SetZCoordinates(axes_[2]);
    return grid;
  }
  if (!coordinates_)
    throwUnreadable(path_, {"missing_part", "the list POINTS"});
  auto set = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(coordinates_);
  set->SetPoints(points);
  return set;
}

void
LegacyReader::scan()
{
  constexpr std::string_view kinds[] = {"structured_points",
                                        "structured_grid",
                                        "rectilinear_grid",
                                        "polydata",
                                        "unstructured_grid"};
  if (std::find(std::begin(kinds), std::end(kinds), header_.kind) == std::end(kinds))
    fail({"other_content", quoteText(header_.kind), "points"});
  Words words;
  while (cursor_.nextWords(words)) {
    words_.assign(words.begin(), words.end());
    const std::string key = lowerCase(words_[0]);
    if (key == "point_data")
      takeData(Data::Points);
    else if (key == "cell_data")
      takeData(Data::Cells);
    else if (key == "metadata")
      body_.skipMetadata();
    else if (!takeGeometry(key) && !takeCells(key) && !takeAttribute(key))
      fail({"unexpected_word", shortenText(words_[0]), "a keyword of its data"});
  }
}

VtkContent
LegacyReader::read()
{
  scan();
  VtkContent content{makeGeometry(), std::move(notes_)};
  auto& point_data = *content.data->GetPointData();
  for (const Array& array : arrays_)
    point_data.AddArray(array);
  if (scalars_)
    point_data.SetScalars(scalars_);
  if (normals_)
    point_data.SetNormals(normals_);
  for (const std::string& name : cell_arrays_) {
    vtkNew<vtkFloatArray> array; // its name is all that is asked for
    array->SetName(name.c_str());
    content.data->GetCellData()->AddArray(array);
  }
  checkLattice(path_, *content.data);
  return content;
}

} // namespace

VtkContent
readVtkLegacy(const std::string& path)
{
  return LegacyReader(path).read();
}

void
checkVtkLegacy(const std::string& path)
{
  LegacyReader(path).scan();
}

std::string
findLegacyKind(const std::string& path)
{
  FileCursor cursor(path);
  return takeHeader(path, cursor).kind;
}

} // namespace io
} // namespace pcl_uvol
