// SPDX-License-Identifier: BSD-3-Clause
// The exact Voronoi cell that a place would have among samples, without a
// triangulation.
#pragma once

#include "neighbors/cell_search.h"
#include "neighbors/convex_polygon.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A plane, with axes of its own in it. */
struct CellPlane {
  Eigen::Vector3d normal, first, second; ///< orthonormal
  double height = 0.0;                   ///< of the plane, along the normal

  CellPlane() = default;

  /** \param normal of any length but 0
   * \param limit the plane is where normal . x = limit */
  CellPlane(const Eigen::Vector3d& normal, double limit);

  /** \brief Keep the part of a polygon in this plane where another normal . x <= limit.
   * \return false if that is all there was */
  bool
  cut(ConvexPolygon& polygon,
      const Eigen::Vector3d& other_normal,
      double limit,
      double tolerance) const
  {
    return polygon.cut(other_normal.dot(first),
                       other_normal.dot(second),
                       limit - height * other_normal.dot(normal),
                       tolerance);
  }

  /** \brief A place in the plane. */
  Eigen::Vector3d
  placeOf(const Eigen::Vector2d& in_plane) const
  {
    return height * normal + in_plane.x() * first + in_plane.y() * second;
  }
};

/** \brief A face of a cell. It is a polygon of its own: cutting a cell never has to
 * find its way from face to face, so that no rounding can break it, whatever the planes
 * have in common. */
struct CellFace {
  static constexpr int no_tag = -1; ///< of the cube that a cell starts as
  int tag = no_tag;                 ///< of the sample beyond the face
  CellPlane plane;
  ConvexPolygon polygon;

  /** \brief Squared distance of the farthest vertex from the place. */
  double
  getSqReach() const
  {
    return plane.height * plane.height + polygon.getSqReach();
  }
};

/** \brief Cells of one place after another; one object per thread.
 *
 * A cell is cut by the bisectors of near samples first. A vertex of it is one of the
 * final cell if no sample lies in the ball around it that the place lies on; where one
 * does, its bisector cuts the vertex off. */
class VoronoiCellFinder {
public:
  /** \brief Find the cell of a place that is no sample.
   * \return false if the cell is not bounded: the place lies outside of the convex hull
   * of the samples; what is found then is the cell among the first ones and some
   * others, within a cube far outside */
  bool
  find(const CellSearch& around);

  /** \brief Find the cell of a sample, to its end also where it is not bounded: then
   * within a cube of some hundred diagonals of the samples' box. */
  void
  findWhole(const CellSearch& around);

  /** \brief Call visit(face) for the faces that samples give the cell, relative to the
   * place; their tags are places in getNeighbors(). */
  template <typename Visit>
  void
  forFaces(const Visit& visit) const
  {
    for (std::size_t i = 0; i < count_; ++i)
      if (faces_[i].tag != CellFace::no_tag)
        visit(faces_[i]);
  }

  /** \brief Distance of the farthest vertex of the cell from the place. */
  double
  getReach() const
  {
    return reach_;
  }

  /** \brief Samples whose bisectors were tried, some of them without a face. */
  const std::vector<std::uint32_t>&
  getNeighbors() const
  {
    return neighbors_;
  }

private:
  struct Vertex {
    double sq_length; ///< from the place
    Eigen::Vector3d place;

    bool
    operator<(double other) const
    {
      return sq_length < other;
    }
  };

  /** Cut with the first samples. */
  void
  start(const CellSearch& around);

  /** A face at the end. */
  CellFace&
  addFace(int tag, const CellPlane& plane);

  /** Keep what lies nearer to the place than to a sample.
   * \return false if that is all there was, but for rounding */
  bool
  cut(const Eigen::Vector3d& offset, int tag);

  /** Look at the farthest vertex that may not be final: cut it off if it is not.
   * \return false if all are */
  bool
  improve(const CellSearch& around);

  bool
  isKnown(const Eigen::Vector3d& vertex) const;

  std::size_t count_ = 0;       ///< of faces
  std::vector<CellFace> faces_; ///< those behind the last keep their memory
  double reach_ = 0.0;
  std::vector<std::uint32_t> neighbors_;
  std::vector<Vertex> final_; ///< ascending
  bool is_bounded_ = true;
  double sq_reach_ = 0.0; ///< all samples nearer to the place are tried
};

} // namespace pcl_uvol::detail
