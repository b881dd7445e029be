// SPDX-License-Identifier: BSD-3-Clause
// Measures of surfaces that are given as points with normals.
#pragma once

#include "mesh/measured_mesh.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/stage.h>

namespace pcl_uvol::detail {

/** \brief Measure a surface without a mesh by the triangles around each of its points,
 * see PointFans, of which every point counts its Voronoi cell.
 *
 * Pieces have no triangles, and one rim where they are open. Points that have
 * no triangle, duplicates among them, are in no piece and have no share. Errors hold
 * what disagreement about triangles may make, as though it were random.
 * \param points with normals; and `isovalue`, if they have it: one is no neighbour of
 * another isovalue's
 * \throws InvalidArgument without normals, without a finite point that has one, and
 * without a triangle */
MeasuredSurface
measurePoints(const CloudView& points, unsigned threads, Report& report);

} // namespace pcl_uvol::detail
