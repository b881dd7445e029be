// SPDX-License-Identifier: BSD-3-Clause
// Part of what a stage reports, for one that runs it.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Add some counts of a stage, and no others: those it has of the same samples.
 * \param names of counts that the stage may have */
PCL_UVOL_EXPORTS void
addCounts(const Report& stage, const std::vector<std::string>& names, Report& report);

} // namespace pcl_uvol
