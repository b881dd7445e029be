// SPDX-License-Identifier: BSD-3-Clause
// Slices of discrete Voronoi diagrams as pictures (thesis Figure 2.15).
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>
#include <pcl_uvol/render/renderer.h>

namespace pcl_uvol {

/** \brief Draw slices perpendicular to an axis, evenly spread, in rows of three, each
 * region in a colour of its own that depends on its number. A cell is a square of as
 * many pixels as make a slice some 300 wide or high, at least one.
 * \param axis 0, 1, 2 for x, y, z
 * \param slices >= 1, at most those of the grid are drawn
 * \throws InvalidArgument for another axis or no slice */
PCL_UVOL_EXPORTS Image
drawVoronoiSlices(const VoronoiGrid& grid, int axis, int slices);

} // namespace pcl_uvol
