// SPDX-License-Identifier: BSD-3-Clause
// The first mesh of an isosurface: a vertex between each two touching cells that it
// parts.
#pragma once

#include "isosurface/isopoints.h"
#include "mesh/cell_tiling.h"
#include "mesh/cell_values.h"
#include "mesh/working_mesh.h"
#include <pcl_uvol/common/stage.h>

#include <vector>

namespace pcl_uvol::detail {

/** \brief Make the closed surface of one isovalue: where values on the inner side reach
 * the border of the samples' box, caps close it.
 * \param report gets the counts of CellValues and the times of "cells" and "triangles"
 */
WorkingMesh
makeBandSurface(const IsopointInput& input, float isovalue, Report& report);

} // namespace pcl_uvol::detail
