// SPDX-License-Identifier: BSD-3-Clause
// Bytes of a level set.
#pragma once

#include "common/memory.h"
#include "isosurface/memory_need.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

namespace pcl_uvol {

/** \brief The need of LevelSetEvolution, besides the cloud; see there.
 * \param surface the isosurface that it starts from, which tells how many samples are
 * in the band: a start from a shape counts as one of the same size */
PCL_UVOL_EXPORTS MemoryNeed
levelSetNeed(double samples,
             const SurfaceSize& surface,
             const LevelSetParameters& parameters);

} // namespace pcl_uvol
