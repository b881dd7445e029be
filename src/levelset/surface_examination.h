// SPDX-License-Identifier: BSD-3-Clause
// What the surface that a level set smooths rests on, by the tree that it has anyway.
#pragma once

#include "levelset/level_set_input.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

namespace pcl_uvol {

/** \brief Look at how samples lie.
 * \param is_examined whether isopoints are looked at as well
 * \param report with them, where they do not lie all around, gets the counts
 * "examined", "examined_bridged" and "examined_rim" of linear isopoints, see
 * countExamined */
SamplingSummary
examineSurface(const LevelSetInput& input,
               bool is_examined,
               unsigned threads,
               Report& report);

} // namespace pcl_uvol
