// SPDX-License-Identifier: BSD-3-Clause
// What uvol_levelset and uvol_isosurface -smooth share.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace uvol_tools {

/** \brief The value of -mu: a number in [0, 1], or "auto". \throws UsageError */
double
parseMu(const std::string& text);

/** \brief Bytes of a point of cloudOfPhi. */
constexpr std::size_t phi_point_bytes = 4 * sizeof(float);

/** \brief A cloud of the points' coordinates and phi. */
pcl::PCLPointCloud2
cloudOfPhi(const pcl_uvol::CloudView& cloud, const std::vector<float>& phi);

/** \brief What an evolution found out, for the report. */
std::vector<std::pair<std::string, std::string>>
describe(const pcl_uvol::LevelSetSummary& summary, bool mu_is_automatic);

} // namespace uvol_tools
