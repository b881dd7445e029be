// SPDX-License-Identifier: BSD-3-Clause
// The surface of a level set, with errors of where it is: fits to phi alone tell how
// well they follow phi.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/mesh/surface_mesh.h>

#include <vector>

namespace pcl_uvol {

/** \brief As extractZeroLevel(), a mesh. */
SurfaceTriangles
meshZeroLevel(const CloudView& samples,
              const std::vector<float>& phi,
              const std::vector<float>& deviations,
              const IsosurfaceParameters& parameters,
              const MeshingParameters& meshing,
              unsigned threads,
              Report& report);

} // namespace pcl_uvol
