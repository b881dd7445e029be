// SPDX-License-Identifier: BSD-3-Clause
// Stretching for samples that are spread very differently along the axes: ocean
// profiles are 1000 km wide and 2 km deep.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

namespace pcl_uvol {

/** \brief Factors per axis that make the samples spread equally along all of them.
 *
 * The spread is the range between the 5th and the 95th percentile of the finite
 * coordinates, so that a few strays do not decide. The axis of the largest spread has
 * factor 1, an axis without spread as well. \throws InvalidArgument if no sample has
 * finite coordinates */
PCL_UVOL_EXPORTS Eigen::Array3f
equalizingScale(const CloudView& cloud);

} // namespace pcl_uvol
