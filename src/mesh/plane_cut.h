// SPDX-License-Identifier: BSD-3-Clause
// The part of a mesh on one side of a plane.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <vector>

namespace pcl_uvol::detail {

/** \brief A mesh that has been cut. */
struct PlaneCut {
  /** Where its vertices lie between vertices of the mesh before; those that were there
   * have both ends in common. */
  IsoEdges vertices;
  std::vector<Triangle> triangles;
};

/** \brief Keep what lies above a plane or in it; it ends there in a rim. Vertices
 * without a triangle go.
 *
 * \param heights of the vertices above the plane */
PCL_UVOL_EXPORTS PlaneCut
cutByPlane(const std::vector<double>& heights, const std::vector<Triangle>& triangles);

} // namespace pcl_uvol::detail
