// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams as image files of VTK.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <array>
#include <string>

namespace pcl_uvol {

/** \brief Write a diagram as .vti, one point of the image at the centre of each cell,
 * with the arrays `site` (the lowest index of the samples in the nearest filled cell)
 * and `distance` (in units of the coordinates). The file appears whole or not at all.
 * \param origin added to the coordinates, as in Dataset
 * \throws IOError */
PCL_UVOL_EXPORTS void
saveVoronoiGrid(const std::string& path,
                const VoronoiGrid& grid,
                const std::array<double, 3>& origin,
                unsigned threads = 0);

/** \brief Throw IOError unless the name ends in .vti and its folder can be written to.
 */
PCL_UVOL_EXPORTS void
checkGridPath(const std::string& path);

} // namespace pcl_uvol
