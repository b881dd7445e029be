// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of grids, by VTK's flying edges.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <vector>

namespace pcl_uvol {

/** \brief The isosurface of values at the centres of cells. Outside is where they are
 * higher, as for distances. Closed unless it leaves the grid.
 * \param values one per cell
 * \throws InvalidArgument for another number of values */
PCL_UVOL_EXPORTS Mesh
contourGrid(const GridShape& shape, const std::vector<float>& values, double isovalue);

} // namespace pcl_uvol
