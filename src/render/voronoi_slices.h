// SPDX-License-Identifier: BSD-3-Clause
// Slices of discrete Voronoi diagrams as pictures (thesis Figure 2.15).
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>
#include <pcl_uvol/render/renderer.h>

namespace pcl_uvol {

/** \brief Draw slices perpendicular to an axis, evenly spread, in rows of three, each
 * region in a colour of its own that depends on its number. A cell is a square of as
 * many pixels as make a slice some 300 wide or high, at least one; in a picture of a
 * given size slices are as large as have room, in its middle.
 * \param axis 0, 1, 2 for x, y, z
 * \param slices >= 1, at most those of the grid are drawn
 * \param width, height of the picture, pixels; 0: as large as the slices are
 * \throws InvalidArgument for another axis or no slice */
PCL_UVOL_EXPORTS Image
drawVoronoiSlices(
    const VoronoiGrid& grid, int axis, int slices, int width = 0, int height = 0);

} // namespace pcl_uvol
