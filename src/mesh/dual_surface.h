// SPDX-License-Identifier: BSD-3-Clause
// The surface between the cells of a tiling that lie on different sides of an
// isosurface: marching tetrahedra on the complex of touching cells.
#pragma once

#include "mesh/cell_tiling.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Two touching cells on different sides: one vertex of the surface. */
struct CellPair {
  std::uint32_t lower, higher; ///< by number, ghosts last

  bool
  operator<(const CellPair& other) const
  {
    return lower != other.lower ? lower < other.lower : higher < other.higher;
  }
  bool
  operator==(const CellPair& other) const
  {
    return lower == other.lower && higher == other.higher;
  }
};

/** \brief Whether a cell, also a ghost, lies above. All ghosts lie on one side. */
using CellSide = std::function<bool(std::uint32_t)>;

/** \brief Squared distance of the vertices of two pairs: of the two diagonals of a
 * quadrangle the shorter one is drawn. */
using PairDistance = std::function<double(const CellPair&, const CellPair&)>;

/** \brief Told of consecutive pairs, by their indices, when they are done. */
using PairsDone = std::function<void(std::size_t begin, std::size_t end)>;

/** \brief The triangles between cells of different sides.
 *
 * Every edge belongs to two triangles that walk it in opposite directions, if pairs
 * hold all pairs of a connected part of the surface.
 * \param pairs ascending, each once: all of them
 * \param done called from any thread; what it throws ends the work
 * \return triangles of indices of pairs, counter-clockwise as seen from cells below */
PCL_UVOL_EXPORTS std::vector<Triangle>
marchTetrahedra(const CellTiling& tiling,
                const std::vector<CellPair>& pairs,
                const CellSide& is_above,
                const PairDistance& distance,
                const PairsDone& done,
                unsigned threads);

} // namespace pcl_uvol::detail
