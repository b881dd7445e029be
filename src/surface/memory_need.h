// SPDX-License-Identifier: BSD-3-Clause
// Bytes of normals and splats.
#pragma once

#include "common/memory.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/surface/splat_generation.h>

namespace pcl_uvol {

/** \brief The memory of SurfaceNormalEstimation besides the cloud: with k neighbours 4
 * k and 70 to 80 bytes per point, of which the 16 of the normal remain. */
PCL_UVOL_EXPORTS MemoryNeed
surfaceNormalsNeed(double points, double k);

/** \brief The part of the points that splats will be grown from, told by those of two
 * patches of the surface, where points lie as close as everywhere. It assumes that they
 * are like the rest. */
PCL_UVOL_EXPORTS double
estimateSplats(const CloudView& cloud,
               const SplatParameters& parameters,
               unsigned threads);

/** \brief The memory of SplatGeneration besides the cloud: 166 to 174 bytes per point,
 * 130 per splat while they are grown, of which 88 remain.
 * \param has_normals the cloud has some: they need not be estimated */
PCL_UVOL_EXPORTS MemoryNeed
splatsNeed(double points, double splats, bool has_normals);

} // namespace pcl_uvol
