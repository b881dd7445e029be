// SPDX-License-Identifier: BSD-3-Clause
// Bytes of a level set besides the cloud, at its peak.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

namespace pcl_uvol {

/** \brief Of the stencils in the band.
 * \param crossing samples beside the surface, see usualCrossing() */
PCL_UVOL_EXPORTS double
bandBytes(double samples, double crossing, const LevelSetParameters& parameters);

/** \brief Of all samples: the tree, values and phi in its order, with their sources. */
constexpr double
orderedBytes(double samples)
{
  return 44.0 * samples;
}

} // namespace pcl_uvol
