// SPDX-License-Identifier: BSD-3-Clause
// What the tags of VTK's XML files promise: pieces, arrays, and where their numbers
// are.
#pragma once

#include "io/xml_scanner.h"
#include "io_vtk/vtk_arrays.h"

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief First and last point along each axis. */
using Extent = std::array<int, 6>;

/** \brief The closing tags of a file lie within its last bytes. */
constexpr std::uint64_t tail_bytes = 256;

/** \brief Points of an extent, below 2^63. */
std::uint64_t
countOf(const Extent& extent);

/** \brief The cells between the points of an extent: an axis of one point has cells
 * without that side. */
Extent
cellsOf(const Extent& extent);

/** \brief A tag DataArray, and where its numbers are. */
struct ArrayTag {
  std::string name;
  const VtkType* type = nullptr; ///< null for texts
  std::uint64_t components = 1;
  std::string format;
  std::uint64_t begin = 0, end = 0; ///< of the text in the file
  std::uint64_t offset = 0;         ///< in the appended data
};

/** \brief A part of the points. */
struct Piece {
  std::uint64_t points = 0;
  Extent extent{};
  std::vector<ArrayTag> arrays;      ///< of its points
  std::vector<ArrayTag> coordinates; ///< one
  std::uint64_t polygon_count = 0;
  std::vector<ArrayTag> polygons; ///< "connectivity" and "offsets"
  std::uint64_t cells = 0;
  std::vector<ArrayTag> cell_arrays; ///< of its cells; only where they are asked for
};

/** \brief Takes the tags of a file. */
class TagCollector {
public:
  /** \param with_cells takes the data of cells, and rectilinear grids, too */
  explicit TagCollector(const std::string& path, bool with_cells = false)
      : path_(path)
      , with_cells_(with_cells)
      , scanner_(path)
  {
  }

  /** \throws IOError */
  void
  collect();

  std::string kind;  ///< "PolyData", "ImageData", ...
  std::string order; ///< of bytes
  std::string header_type, compressor;
  Extent whole{};
  std::array<double, 3> origin{{0.0, 0.0, 0.0}}, spacing{{1.0, 1.0, 1.0}};
  std::array<double, 9> direction{{1, 0, 0, 0, 1, 0, 0, 0, 1}};
  std::string scalars, normals; ///< names of active arrays
  std::vector<Piece> pieces;
  std::set<std::string> cell_arrays; ///< names of data of cells
  bool has_grid = false;
  bool appended_base64 = false;
  std::uint64_t appended = 0, appended_end = 0; ///< in the file, 0 without

private:
  void
  takeRoot(const XmlTag& tag);
  void
  takeGrid(const XmlTag& tag);
  void
  takePiece(const XmlTag& tag);
  void
  takeArray(const XmlTag& tag);
  void
  takeInside(const XmlTag& tag);
  Extent
  extentIn(const std::string& text) const;
  template <std::size_t N>
  void
  takeNumbers(const std::string* text, std::array<double, N>& numbers) const;
  std::uint64_t
  countIn(const XmlTag& tag, std::string_view attribute, std::uint64_t absent) const;
  void
  skipToAppended(const XmlTag& tag);

  const std::string& path_;
  const bool with_cells_;
  XmlScanner scanner_;
  ArrayTag* array_ = nullptr; ///< the one that is open
};

} // namespace io
} // namespace pcl_uvol
