// SPDX-License-Identifier: BSD-3-Clause
// A mesh while it is made: vertices that know the surface they lie on.
#pragma once

#include "common/large_array.h"
#include "mesh/dual_surface.h"
#include "mesh/foot.h"
#include <pcl_uvol/common/dataset.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A vertex. */
struct WorkingVertex {
  Foot foot;     ///< itself; its normal looks to lower values, on a cap out of the box
  double size;   ///< distance of cells there, about the length of edges
  CellPair pair; ///< of cells that it was made for, or that one merged into it was
  bool is_on_surface = true; ///< else it closes the box
  BoxSides sides = 0;        ///< of the samples' box, that it stays on
};

/** \brief What a triangle is a part of: a side of the box, as ghosts are numbered, or
 * the surface itself. */
using MeshRegion = std::int8_t;
constexpr MeshRegion surface_region = -1;

/** \brief Vertices and triangles, which are counter-clockwise seen from lower values,
 * and the box of the samples. */
struct WorkingMesh {
  LargeArray<WorkingVertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<MeshRegion> regions; ///< by triangle
  std::array<double, 6> sides{};   ///< coordinates of the box, as ghosts are numbered

  /** \brief Not of unit length; twice the area. */
  Eigen::Vector3d
  normalOf(const Triangle& triangle) const
  {
    const Eigen::Vector3d& a = vertices[triangle[0]].foot.place;
    return (vertices[triangle[1]].foot.place - a)
        .cross(vertices[triangle[2]].foot.place - a);
  }

  /** \brief Cosine of the angle between a triangle and the mean of the normals of its
   * vertices, on a cap of those that are not on the surface; -1 for one without area,
   * and for one of a cap whose vertices all are, which could not be told from the
   * surface. */
  double
  agreementOf(const Triangle& triangle, MeshRegion region) const;

  bool
  isWithinBox(const Eigen::Vector3d& place) const;

  /** \brief The place of a vertex that stays on sides of the box, or the nearest one
   * that is not too near to the others: the surface may leave the box close by an edge
   * or a corner of it, which has a vertex of its own. */
  Eigen::Vector3d
  keepInBox(const WorkingVertex& vertex, const Eigen::Vector3d& place) const;

  /** \brief The foot below a place that belongs to a vertex: as blendFeet(), and for
   * vertices that stay on sides of the box, within the box.
   * \param feet at least one */
  Foot
  footBelow(const WorkingVertex& vertex,
            const Eigen::Vector3d& place,
            const std::vector<Foot>& feet) const;

  /** \brief Leave out the triangles for which drops(index) is true, and the vertices
   * that no other has. */
  template <typename Drops>
  void
  dropTriangles(const Drops& drops)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
      if (!drops(i)) {
        triangles[kept] = triangles[i];
        regions[kept++] = regions[i];
      }
    triangles.resize(kept);
    regions.resize(kept);
    dropUnused();
  }

private:
  void
  dropUnused();
};

/** \brief The smallest of the angles of a triangle, in degrees. */
double
smallestAngle(const std::array<Eigen::Vector3d, 3>& corners);

} // namespace pcl_uvol::detail
