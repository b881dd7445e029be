// SPDX-License-Identifier: BSD-3-Clause
// A mesh while it is made: vertices that know the surface they lie on.
#pragma once

#include "mesh/dual_surface.h"
#include "mesh/foot.h"
#include <pcl_uvol/common/mesh.h>

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
  std::int8_t cap = -1; ///< side of the box that it closes, as ghosts are numbered; -1:
                        ///< it lies on the surface
};

/** \brief Vertices and triangles, which are counter-clockwise seen from lower values,
 * and the box of the samples. */
struct WorkingMesh {
  std::vector<WorkingVertex> vertices;
  std::vector<Triangle> triangles;
  std::array<double, 6> sides{}; ///< coordinates of the box, as ghosts are numbered

  /** \brief Not of unit length; twice the area. */
  Eigen::Vector3d
  normalOf(const Triangle& triangle) const
  {
    const Eigen::Vector3d& a = vertices[triangle[0]].foot.place;
    return (vertices[triangle[1]].foot.place - a)
        .cross(vertices[triangle[2]].foot.place - a);
  }

  /** \brief Cosine of the angle between a triangle and the mean of the normals of its
   * vertices; -1 for one without area. */
  double
  agreementOf(const Triangle& triangle) const;

  /** \brief Leave out vertices without a triangle. */
  void
  dropUnused();
};

/** \brief The smallest of the angles of a triangle, in degrees. */
double
smallestAngle(const std::array<Eigen::Vector3d, 3>& corners);

} // namespace pcl_uvol::detail
