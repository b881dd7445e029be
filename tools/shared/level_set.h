// SPDX-License-Identifier: BSD-3-Clause
// What uvol_levelset and uvol_isosurface -smooth share.
#pragma once

#include "shared/facts.h"
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace uvol_tools {

/** \brief What an evolution found out, for the report.
 * \param of_isovalue behind the names of the facts, where there are several level sets
 */
Facts
describe(const pcl_uvol::LevelSetSummary& summary,
         bool mu_is_automatic,
         const std::string& of_isovalue = {});

} // namespace uvol_tools
