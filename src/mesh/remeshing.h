// SPDX-License-Identifier: BSD-3-Clause
// Even triangles: vertices glide along their surface, short edges vanish, others turn.
#pragma once

#include "mesh/working_mesh.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cstddef>

namespace pcl_uvol::detail {

/** \brief Even out the triangles of a manifold, which stays one of the same topology:
 * tangential smoothing (five rounds), collapse of edges below 0.4 of the local length,
 * flips towards Delaunay's criterion, and six more rounds of smoothing with flips
 * between them.
 *
 * Vertices stay on the surface that the feet around them tell, those of a cap in the
 * plane of their side, and an edge between the two neither moves from it nor vanishes.
 * Nothing is done that turns a triangle by more than 60 degrees from the normals of its
 * vertices. Deterministic.
 * \param mesh comes out without unused vertices
 * \param edge_length about the least one; 0: that of the local sizes
 * \param report gets the time */
PCL_UVOL_EXPORTS void
remesh(WorkingMesh& mesh, double edge_length, unsigned threads, Report& report);

} // namespace pcl_uvol::detail
