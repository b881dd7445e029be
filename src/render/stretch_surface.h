// SPDX-License-Identifier: BSD-3-Clause
// A surface stretched along the axes, for pictures.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

namespace pcl_uvol {

/** \brief Multiply positions and origin by factors per axis, normals as the covectors
 * that they are, and lengths of edges by the largest factor. Other fields keep their
 * values.
 * \param factors above 0
 * \throws InvalidArgument for splats, whose axes would no longer be at right angles */
PCL_UVOL_EXPORTS void
stretchSurface(Dataset& surface, const Eigen::Vector3d& factors);

} // namespace pcl_uvol
