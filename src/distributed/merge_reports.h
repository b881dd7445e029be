// SPDX-License-Identifier: BSD-3-Clause
// One report of what several processes did together.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The reports of all processes as one: counts are added, of times the longest
 * of each step counts, a warning of several is given once.
 * \param largest counts whose largest is added as "largest_<name>" */
PCL_UVOL_EXPORTS Report
mergeReports(const Report& report,
             Communicator& communicator,
             const std::vector<std::string>& largest = {});

} // namespace pcl_uvol
