// SPDX-License-Identifier: BSD-3-Clause
// Meshes at the faces of a box that repeats.
#pragma once

#include "neighbors/periodic_box.h"
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

namespace pcl_uvol::detail {

/** \brief Cut a mesh that goes beyond the faces of a box, and weld what is left if that
 * is asked for.
 *
 * \param result with coordinates that count from the low corner of the box; its
 * triangles, vertices, edges, pieces and counts become those of the part within */
void
cutAtFaces(const PeriodicBox& box,
           PeriodicMesh periodic_mesh,
           IsosurfaceResult& result);

} // namespace pcl_uvol::detail
