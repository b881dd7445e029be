// SPDX-License-Identifier: BSD-3-Clause
// Splats as other people's viewers read them.
#pragma once

#include "render/point_colors.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/point_cloud.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Flat Gaussians in the places of splats, with the fields that viewers of 3D
 * Gaussian splats read (Kerbl et al. 2023, the layout of their point_cloud.ply):
 * position, normal, colour (f_dc_0 to f_dc_2), opacity before the logistic function,
 * natural logarithms of the standard deviations, and the rotation as a quaternion w, x,
 * y, z. Standard deviations are 1/sqrt(2) of the radius in the plane, and a hundredth
 * of it across. These viewers know no light: colours are lit here, from above and the
 * front left.
 * \param colors one per splat, before light falls on them */
PCL_UVOL_EXPORTS pcl::PCLPointCloud2
toGaussians(const pcl::PointCloud<PointSplat>& splats, const std::vector<Rgba>& colors);

/** \brief Splats as Gaussians in the colours of a field, without their origin.
 * \param field a scalar field, "rgb", or "" for the colour of the material
 * \param mapping of its values
 * \param report gets warnings of an origin that is lost and of values that have no
 * logarithm
 * \throws InvalidArgument as colorPoints */
PCL_UVOL_EXPORTS Dataset
makeGaussians(const Dataset& splats,
              const std::string& field,
              const ColorMapping& mapping,
              Report& report);

} // namespace pcl_uvol
