// SPDX-License-Identifier: BSD-3-Clause
// The last step towards a mesh: its vertices become isopoints.
#pragma once

#include "isosurface/isopoints.h"
#include "mesh/working_mesh.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/mesh/surface_mesh.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Move vertices onto fits made there, which tell normal, curvature, error and
 * support, and check what came out. Isovalues are those of the input's frame.
 * \param sources input index of each sample
 * \param report gets the counts of countRoots, "pieces", "handles", "rim_edges",
 * "cap_vertices", "folds" and "slivers", and the time of "smooth_roots"
 * \throws std::logic_error unless the mesh is an oriented manifold */
SurfaceTriangles
finishMesh(const IsopointInput& input,
           float isovalue,
           WorkingMesh&& mesh,
           const std::vector<std::uint32_t>& sources,
           Report& report);

} // namespace pcl_uvol::detail
