// SPDX-License-Identifier: BSD-3-Clause
// The box that IsosurfacePipeline's samples repeat in.
#pragma once

#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <array>

namespace pcl_uvol {

/** \brief The sides of the box that repeats. */
inline std::array<double, 3>
sidesOf(const IsosurfacePipelineParameters& parameters)
{
  const Eigen::Array3d& sides = parameters.periodic;
  return {{sides[0], sides[1], sides[2]}};
}

} // namespace pcl_uvol
