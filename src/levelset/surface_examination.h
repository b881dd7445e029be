// SPDX-License-Identifier: BSD-3-Clause
// What the surface that a level set smooths rests on, by the tree that it has anyway.
#pragma once

#include "levelset/level_set_input.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

namespace pcl_uvol {

/** \brief Look at how samples lie.
 * \param is_examined whether isopoints are looked at as well
 * \param tally with them, where they do not lie all around, gets what linear isopoints
 * rest on
 * \param report gets it as countExamined() counts it */
SamplingSummary
examineSurface(const LevelSetInput& input,
               bool is_examined,
               unsigned threads,
               SurfaceTally& tally,
               Report& report);

} // namespace pcl_uvol
