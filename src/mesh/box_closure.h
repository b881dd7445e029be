// SPDX-License-Identifier: BSD-3-Clause
// What a surface encloses that was cut at the faces of a periodic box.
#pragma once

#include "mesh/mesh_columns.h"
#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Closes pieces of a mesh by the parts of the box's faces that are inside.
 *
 * By Gauss's theorem with the field (0, 0, z), only the high face across z counts; by
 * Green's theorem its inner part follows from the rim there and from the box's edge
 * where y is high; and that from the points in which the rim meets this edge, and from
 * the corner of the box. Rims in opposite faces need not have the same vertices. */
class PCL_UVOL_EXPORTS BoxClosure {
public:
  /** \param box in the coordinates of the vertices
   * \param pieces how many */
  BoxClosure(const PeriodicBox& box, std::size_t pieces);

  /** \brief Add an edge of a rim, if it is in a face.
   * \param from, to its vertices, in the direction of its triangle
   * \param bulge from the middle of the edge to the surface
   * \return whether it is in a face */
  bool
  addRim(std::size_t piece,
         const std::vector<Eigen::Vector3d>& places,
         std::uint32_t from,
         std::uint32_t to,
         const Eigen::Vector3d& bulge);

  /** \return The volume of the box; 0 unless it is periodic along all axes. */
  double
  getBoxVolume() const
  {
    return box_.sides[0] * box_.sides[1] * box_.sides[2];
  }

  /** \return Whether a piece has an edge in a face. */
  bool
  isCut(std::size_t piece) const
  {
    return is_cut_[piece] != 0;
  }

  /** \brief The volume of a piece that is closed by the faces. Where the corner of the
   * box may be inside or outside, the smaller amount of the two is taken.
   * \param below the surface integral of z times the z of the normal
   * \param flux the surface integral of the z of the normal */
  double
  findVolume(std::size_t piece, double below, double flux);

  /** \brief Give the pieces other numbers.
   * \param number by piece; -1: it is left out */
  void
  renumber(const std::vector<std::int32_t>& number);

  /** \brief Sort the rims for addTurns(), once all have been added.
   * \param places of the vertices, in the coordinates of the samples */
  void
  prepare(const std::vector<Eigen::Vector3d>& places);

  /** \brief Add how often cut pieces wind around the place in the high face that is
   * above a place in the box.
   * \param places as above
   * \param found pieces, ascending */
  void
  addTurns(const std::vector<Eigen::Vector3d>& places,
           const Eigen::Vector3d& place,
           std::vector<Winding>& found) const;

private:
  /** An edge of a rim in the high face across z, in the direction of its triangle. */
  struct RimEdge {
    std::uint32_t from, to;
    std::int32_t piece;
  };

  /** Where the inner part of the box's edge, y and z high, ends (1) or begins (-1). */
  struct EdgePoint {
    std::uint32_t vertex;
    std::int32_t piece;
    int turns;
  };

  /** The bits of the faces that a place is in, two per axis: low, high. */
  unsigned
  findFaces(const Eigen::Vector3d& place) const;

  std::size_t
  columnOf(double x) const;

  PeriodicBox box_;
  std::vector<char> is_cut_, has_corner_;         ///< by piece
  std::vector<double> face_areas_, edge_lengths_; ///< by piece, without the corner
  std::vector<RimEdge> rims_;
  std::vector<EdgePoint> points_;
  double columns_low_ = 0.0, columns_per_length_ = 0.0;
  std::vector<std::size_t> begins_; ///< of the rims in columns across x, and the end
  std::vector<std::uint32_t> members_;
};

} // namespace pcl_uvol::detail
