// SPDX-License-Identifier: BSD-3-Clause
// Which closed pieces of a mesh are around a place.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A piece of a mesh and how often it winds around a place. */
struct Winding {
  std::int32_t piece;
  int turns; ///< 1 inside of a piece that looks outwards; not 0
};

/** \brief 1 where the edge of a triangle passes behind a place, in the direction of y,
 * to the left, that is to lower x, -1 where it passes to the right, and 0 where it does
 * not pass behind. The two directions of an edge give opposite numbers, however it
 * rounds. */
int
crossingBehind(const std::vector<Eigen::Vector3d>& places,
               std::uint32_t from,
               std::uint32_t to,
               const Eigen::Vector3d& place);

/** \brief Add turns to those of a piece.
 * \param found ascending by piece */
void
addTurns(std::int32_t piece, int turns, std::vector<Winding>& found);

class BoxClosure;

/** \brief Triangles by the columns, parallel to the z axis, that they are in.
 *
 * A place is inside where a ray along z leaves more often than it enters. On which side
 * of an edge the ray passes is computed in one way for both triangles of the edge, and
 * a ray through a vertex is taken to be a little to its right: what rounds wrongly
 * moves the edge, and opens no gap. */
class PCL_UVOL_EXPORTS MeshColumns {
public:
  /** \param places of the vertices; they and the triangles must outlive this
   * \param piece_of by vertex
   * \param closure of pieces that were cut at the faces of a box; null: none was */
  MeshColumns(const std::vector<Eigen::Vector3d>& places,
              const std::vector<Triangle>& triangles,
              const std::vector<std::int32_t>& piece_of,
              const BoxClosure* closure = nullptr);

  /** \brief The pieces around a place, ascending.
   * \param found cleared first */
  void
  findAround(const Eigen::Vector3d& place, std::vector<Winding>& found) const;

private:
  /** Columns that a box reaches into: from low to high, both included. */
  struct ColumnRange {
    std::array<std::size_t, 2> low, high;
  };

  std::size_t
  columnOf(int axis, double coordinate) const;

  ColumnRange
  columnsOf(const Triangle& triangle) const;

  int
  crossingOf(const Triangle& triangle, const Eigen::Vector3d& place) const;

  Eigen::Vector3d
  enterCaps(const Eigen::Vector3d& place) const;

  void
  addCrossings(const Eigen::Vector3d& place, std::vector<Winding>& found) const;

  const std::vector<Eigen::Vector3d>& places_;
  const std::vector<Triangle>& triangles_;
  const std::vector<std::int32_t>& piece_of_;
  const BoxClosure* closure_;
  Eigen::Vector3d low_, high_;
  std::array<bool, 3> is_capped_low_{}, is_capped_high_{}; ///< by triangles in the face
  std::array<std::size_t, 2> columns_;
  std::vector<std::size_t> begins_; // by column, and the end
  std::vector<std::uint32_t> members_;
};

} // namespace pcl_uvol::detail
