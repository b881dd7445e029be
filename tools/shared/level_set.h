// SPDX-License-Identifier: BSD-3-Clause
// What uvol_levelset and uvol_isosurface -smooth share.
#pragma once

#include "shared/facts.h"
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace uvol_tools {

/** \brief The value of -mu: a number in [0, 1], or none for "auto".
 * \throws UsageError */
std::optional<double>
parseMu(const std::string& text);

/** \brief What an evolution found out, for the report. */
Facts
describe(const pcl_uvol::LevelSetSummary& summary, bool mu_is_automatic);

} // namespace uvol_tools
