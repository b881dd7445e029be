// SPDX-License-Identifier: BSD-3-Clause
// The lines along which a surface meets the caps that close it, and caps one another.
#pragma once

#include "mesh/working_mesh.h"
#include <pcl_uvol/common/export.h>

namespace pcl_uvol::detail {

/** \brief Part the triangles that reach from the surface onto a cap, or from one side
 * of the box onto another, along the line where the two meet: such triangles cut the
 * corner between them.
 *
 * Edges across a line get a vertex on it, and triangles across two of them one in the
 * point where these meet, so that the mesh stays a manifold of the same topology, and
 * each triangle belongs to one region.
 * \param mesh whose vertices lie on the surface or on one side; its regions are set */
PCL_UVOL_EXPORTS void
splitCreases(WorkingMesh& mesh);

} // namespace pcl_uvol::detail
