// SPDX-License-Identifier: BSD-3-Clause
// Distance fields of discrete Voronoi diagrams.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Per cell the distance to its site, between the centres of cells, in units of
 * the coordinates.
 * \param nearest site of every cell, none of them no_site
 * \param shape the grid
 * \param sites cells, in the order of their numbers
 * \param threads 0: all cores */
PCL_UVOL_EXPORTS std::vector<float>
computeSiteDistances(const GridShape& shape,
                     const std::vector<GridCell>& sites,
                     const std::vector<std::uint32_t>& nearest,
                     unsigned threads);

} // namespace pcl_uvol
