// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/vtk_xml_tags.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io_vtk/vtk_readers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {
namespace io {

std::uint64_t
countOf(const Extent& extent)
{
  std::uint64_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) // each below 2^31 + 1
    count *= static_cast<std::uint64_t>(std::max<std::int64_t>(
        0, std::int64_t(extent[2 * axis + 1]) - extent[2 * axis] + 1));
  return count;
}

Extent
cellsOf(const Extent& extent)
{
  Extent cells = extent;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (cells[2 * axis] < cells[2 * axis + 1])
      --cells[2 * axis + 1];
  return cells;
}

template <std::size_t N>
void
TagCollector::takeNumbers(const std::string* text, std::array<double, N>& numbers) const
{
  if (!text)
    return;
  std::vector<std::string_view> words;
  splitWords(*text, words);
  bool valid = words.size() == N;
  for (std::size_t i = 0; i < N && valid; ++i)
    valid = parseNumber(words[i], numbers[i]);
  if (!valid)
    throwUnreadable(path_,
                    {"unexpected_word",
                     shortenText(*text),
                     "a list of " + std::to_string(N) + " numbers"});
}

Extent
TagCollector::extentIn(const std::string& text) const
{
  std::array<double, 6> numbers{};
  takeNumbers(&text, numbers);
  Extent extent{};
  constexpr double most = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < 6; ++i) {
    const double low = numbers[i / 2 * 2];
    if (!(std::abs(numbers[i]) <= most) || numbers[i] != std::floor(numbers[i]) ||
        numbers[i] < low - 1 || numbers[i] - low >= most)
      throwUnreadable(path_,
                      {"unexpected_word", shortenText(text), "the extent of a grid"});
    extent[i] = static_cast<int>(numbers[i]);
  }
  if (countOf({extent[0], extent[1], extent[2], extent[3], 0, 0}) > std::uint64_t(1)
                                                                        << 32)
    throwUnreadable(path_, {"uncountable", "points"});
  return extent;
}

std::uint64_t
TagCollector::countIn(const XmlTag& tag,
                      std::string_view attribute,
                      std::uint64_t absent) const
{
  const std::string* const text = tag.find(attribute);
  if (text && !parseCount(trimmed(*text), absent))
    throwUnreadable(
        path_,
        {"unexpected_word", shortenText(*text), "a valid " + std::string(attribute)});
  return absent;
}

void
TagCollector::takeRoot(const XmlTag& tag)
{
  const auto get = [&tag](std::string_view attribute) {
    const std::string* const value = tag.find(attribute);
    return value ? *value : std::string();
  };
  kind = get("type");
  order = get("byte_order");
  header_type = get("header_type");
  compressor = get("compressor");
  for (const char* const known :
       {"PolyData", "UnstructuredGrid", "StructuredGrid", "ImageData"})
    if (kind == known)
      return;
  if (with_cells_ && kind == "RectilinearGrid")
    return;
  throwUnreadable(path_, {"other_content", quoteText(kind), "points"});
}

void
TagCollector::takeGrid(const XmlTag& tag)
{
  if (const std::string* const extent = tag.find("WholeExtent"))
    whole = extentIn(*extent);
  takeNumbers(tag.find("Origin"), origin);
  takeNumbers(tag.find("Spacing"), spacing);
  takeNumbers(tag.find("Direction"), direction);
}

void
TagCollector::takePiece(const XmlTag& tag)
{
  Piece piece;
  const bool grid = kind != "PolyData" && kind != "UnstructuredGrid";
  if (const std::string* const extent = tag.find("Extent"); grid && extent) {
    piece.extent = extentIn(*extent);
    for (std::size_t i = 0; i < 6; i += 2)
      if (piece.extent[i] < whole[i] || piece.extent[i + 1] > whole[i + 1])
        throwUnreadable(path_, {"invalid_part", "the extent of a piece"});
    piece.points = countOf(piece.extent);
    piece.cells = countOf(cellsOf(piece.extent));
  }
  else if (grid)
    throwUnreadable(path_, {"missing_part", "the extent of a piece"});
  else
    piece.points = countIn(tag, "NumberOfPoints", 0);
  if (kind == "PolyData")
    piece.polygon_count = countIn(tag, "NumberOfPolys", 0);
  if (with_cells_ && !grid)
    for (const char* const kind_of_cells : {"NumberOfCells",
                                            "NumberOfVerts",
                                            "NumberOfLines",
                                            "NumberOfStrips",
                                            "NumberOfPolys"}) {
      const std::uint64_t cells = countIn(tag, kind_of_cells, 0);
      if (cells > std::uint64_t(1) << 40) // more than memory holds, with a byte each
        throwUnreadable(path_, {"uncountable", "cells"});
      piece.cells += cells;
    }
  pieces.push_back(std::move(piece));
}

void
TagCollector::takeArray(const XmlTag& tag)
{
  const std::string& section = scanner_.getOpen()[3];
  if (const std::string* const name = tag.find("Name"); section == "CellData") {
    cell_arrays.insert(name ? *name : std::string());
    checkArrayCount(path_, cell_arrays.size());
  }
  const bool of_cells = with_cells_ && section == "CellData";
  if (section != "PointData" && section != "Points" && section != "Polys" && !of_cells)
    return;
  // The first one of several steps of time counts.
  if (const std::string* const step = tag.find("TimeStep"); step && *step != "0")
    return;
  ArrayTag array;
  const std::string* const name = tag.find("Name");
  const std::string* const type = tag.find("type");
  const std::string* const format = tag.find("format");
  array.name = name ? *name : std::string();
  array.type = findXmlType(type ? *type : std::string());
  if (!array.type && (!type || *type != "String"))
    throwUnreadable(path_,
                    {"unsupported_value",
                     "the type of the array " + quoteText(array.name),
                     shortenText(type ? *type : ""),
                     "types of numbers"});
  array.components = countIn(tag, "NumberOfComponents", 1);
  array.format = format ? *format : "ascii";
  array.offset = countIn(tag, "offset", 0);
  Piece& piece = pieces.back();
  auto& arrays = section == "Points"  ? piece.coordinates
                 : section == "Polys" ? piece.polygons
                 : of_cells           ? piece.cell_arrays
                                      : piece.arrays;
  arrays.push_back(std::move(array));
  checkArrayCount(path_, arrays.size());
  if (!tag.empty)
    array_ = &arrays.back();
}

/** Tags between <Piece> and </Piece>. */
void
TagCollector::takeInside(const XmlTag& tag)
{
  const std::size_t depth = scanner_.getOpen().size() + (tag.empty ? 1 : 0);
  const bool directly_in_array = depth == (tag.closes ? 4 : 6);
  if (array_ && directly_in_array && array_->begin == array_->end) {
    array_->begin = tag.text; // keys of information may follow
    array_->end = tag.begin;
  }
  if (tag.closes) {
    if (depth == 4)
      array_ = nullptr;
  }
  else if (depth == 4 && tag.name == "PointData") {
    const auto get = [&tag](std::string_view key, std::string& value) {
      if (const std::string* const given = tag.find(key); given && value.empty())
        value = *given;
    };
    get("Scalars", scalars);
    get("Normals", normals);
  }
  else if (depth == 5 && (tag.name == "DataArray" || tag.name == "Array"))
    takeArray(tag);
}

/** Appended data follow an underscore. */
void
TagCollector::skipToAppended(const XmlTag& tag)
{
  const std::string* const encoding = tag.find("encoding");
  appended_base64 = encoding && *encoding == "base64";
  FileCursor cursor(path_);
  cursor.seek({tag.end, 0});
  const char* const mark = cursor.skipBlanks() ? cursor.take(1) : nullptr;
  if (!mark || *mark != '_')
    throwUnreadable(path_, {"missing_part", "the '_' before its appended data"});
  appended = cursor.tell().offset;
  const std::uint64_t size = cursor.getFile().getSize();
  std::string end(std::min(tail_bytes, size - appended), '\0');
  cursor.getFile().read(size - end.size(), end.data(), end.size());
  const std::size_t found = end.rfind("</AppendedData");
  if (found == end.npos)
    throwUnreadable(path_, {"truncated_part", "the block of appended data"});
  appended_end = size - end.size() + found;
}

void
TagCollector::collect()
{
  XmlTag tag;
  while (scanner_.next(tag)) {
    const auto& open = scanner_.getOpen();
    const std::size_t depth = open.size() + (tag.empty ? 1 : 0);
    const bool inside = open.size() >= 2 && open[0] == "VTKFile" && open[1] == kind;
    if (inside && (depth > 3 || (depth == 3 && tag.closes)) && !pieces.empty() &&
        open[2] == "Piece")
      takeInside(tag);
    else if (tag.closes)
      continue;
    else if (depth == 1 && tag.name == "VTKFile")
      takeRoot(tag);
    else if (depth == 2 && tag.name == kind && open[0] == "VTKFile") {
      takeGrid(tag);
      has_grid = true;
    }
    else if (inside && depth == 3 && tag.name == "Piece")
      takePiece(tag);
    else if (depth == 2 && tag.name == "AppendedData") {
      skipToAppended(tag);
      break; // raw data are no XML
    }
  }
  if (!has_grid)
    throwUnreadable(path_, {"not_format", "a VTK file of points"});
}

} // namespace io
} // namespace pcl_uvol
