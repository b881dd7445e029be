// SPDX-License-Identifier: BSD-3-Clause
// Isopoints with their edges and what is counted of them.
#pragma once

#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/mesh/surface_mesh.h>

namespace pcl_uvol {

/** \brief Run an extraction on the cloud that it has.
 * \return vertices without triangles
 * \param report gets that of the extraction */
SurfaceTriangles
extractPoints(IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
              const IsosurfaceParameters& parameters,
              unsigned threads,
              Report& report);

} // namespace pcl_uvol
