// SPDX-License-Identifier: BSD-3-Clause
// Distance fields of meshes, again by discrete Voronoi diagrams (thesis 2.6).
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <vector>

namespace pcl_uvol {

/** \brief Per cell the distance to the nearest cell that a mesh goes through, between
 * their centres, in units of the coordinates. What a closed mesh encloses has distance
 * 0, so that an isosurface lies outside.
 * \param mesh within the grid; what lies beyond it is taken to its border
 * \param report gets times
 * \throws InvalidArgument for a mesh without vertices */
PCL_UVOL_EXPORTS std::vector<float>
distanceToMesh(const GridShape& shape,
               const Mesh& mesh,
               unsigned threads,
               Report& report);

} // namespace pcl_uvol
