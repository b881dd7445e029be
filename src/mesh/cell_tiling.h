// SPDX-License-Identifier: BSD-3-Clause
// The leaf cells of a kd-tree as a tiling of space, and what lies around the face that
// two of them share.
#pragma once

#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/export.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A plane that bounds a cell, and the node that it splits. */
struct CellBound {
  SplitPlane plane;
  KdNode node; ///< number 0 at the border of the domain, where the plane is infinite
};

/** \brief The planes around a cell. */
struct TileCell {
  std::array<CellBound, 3> low, high;
};

class CellTiling;

/** \brief The cells that were asked for lately: rings around pairs that follow one
 * another share most of theirs, and a cell takes a way through the whole tree. */
class PCL_UVOL_EXPORTS CellCache {
public:
  /** \param tiling must outlive the cache */
  explicit CellCache(const CellTiling& tiling);

  TileCell
  find(std::uint32_t cell);

private:
  const CellTiling& tiling_;
  std::vector<std::uint32_t> numbers_;
  std::vector<TileCell> cells_;
};

/** \brief The cells of samples that tile space, with six more cells outside of the
 * samples' box, "ghosts", one beyond each of its sides.
 *
 * Planes of one axis are distinct in the order that KdTree::isBelow knows, ties of
 * coordinates included. Through a point passes at most one plane per axis, so that at
 * most three cells meet along an edge and at most four in a corner: of the nodes that
 * own these planes the first one parts the surroundings of the point in two, and each
 * further plane cuts one of the pieces only, since otherwise it would coincide with
 * another. Three planes therefore leave four pieces, each pair of which has a face in
 * common. Hence the cells, joined where they touch, are the vertices of a complex of
 * tetrahedra without gaps or overlaps, and what parts two sets of cells is a closed
 * surface without branches, for any samples.
 *
 * Cells are named by the index of their sample, ghosts by the numbers that follow. */
class PCL_UVOL_EXPORTS CellTiling {
public:
  /** \param tree over all samples, not a piece of a larger one; it and positions must
   * outlive the tiling */
  CellTiling(const KdTree& tree, const std::vector<Position>& positions);

  std::uint32_t
  countSamples() const
  {
    return tree_.getRoot().count;
  }

  /** \brief The cell beyond the low or the high side of the box. */
  std::uint32_t
  getGhost(int axis, bool is_high) const
  {
    return countSamples() + 2 * static_cast<std::uint32_t>(axis) +
           static_cast<std::uint32_t>(is_high);
  }

  bool
  isGhost(std::uint32_t cell) const
  {
    return cell >= countSamples();
  }

  TileCell
  findCell(std::uint32_t cell) const;

  /** \brief The part of a sample's cell that stands for it: within the box around all
   * samples, and towards the border of the domain not much longer than cells around, or
   * up to the sample: samples may fill a ball within their box. */
  KdBox
  findBox(std::uint32_t sample, const TileCell& cell) const;

  /** \brief The cells around the face that two touching cells share, in the order in
   * which they are met: two that follow one another form a tetrahedron with the pair,
   * of which (a, b, second, first) are positively oriented.
   * \param a, b cells that touch, at most one of them a ghost
   * \param cache of this tiling, not shared between threads
   * \param ring cleared first; the first cell is not repeated at the end */
  void
  findRing(std::uint32_t a,
           std::uint32_t b,
           CellCache& cache,
           std::vector<std::uint32_t>& ring) const;

private:
  /** The planes that a corner lies on, all but the one across which a cell is looked
   * for. */
  using CornerPlanes = std::array<SplitPlane, 3>;

  /** The longest that a cell at the border may be across it, by the cells around. */
  float
  longestSideAround(std::uint32_t sample) const;

  /** The child of a node that holds a sample, whose plane becomes one of a cell. */
  KdNode
  descend(const KdNode& node, std::uint32_t sample, TileCell& cell) const;

  bool
  isBelow(int axis, const CellBound& a, const CellBound& b) const
  {
    return KdTree::isBelow(positions_, axis, a.plane, b.plane);
  }

  std::uint32_t
  locate(int axis,
         const CellBound& bound,
         bool is_above,
         const CornerPlanes& corner) const;

  const KdTree& tree_;
  const std::vector<Position>& positions_;
};

} // namespace pcl_uvol::detail
