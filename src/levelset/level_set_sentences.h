// SPDX-License-Identifier: BSD-3-Clause
// What people are told of level sets that did not end well.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <cstddef>
#include <optional>
#include <string>

namespace pcl_uvol {

/** \brief What helps against divergence, of the parameters that are not the stable
 * ones. */
std::string
adviseStability(const LevelSetParameters& parameters);

PCL_UVOL_EXPORTS std::string
describeVanished(const LevelSetParameters& parameters);

/** \brief Values that are alike told an automatic mu nothing.
 * \param share of the samples next to the surface */
std::string
describeTies(double isovalue, double share);

/** \brief That it still moved after its last step.
 * \param chosen_mu the weight that it was on its way to, if it has not come there */
std::string
describeStepLimit(const LevelSetParameters& parameters,
                  const LevelSetSummary& summary,
                  std::optional<double> chosen_mu);

/** \brief That samples are on the other side than the data put them.
 * \param lost how many
 * \param mu the weight of the data */
std::string
describeLostFeatures(double isovalue, std::size_t lost, double mu);

} // namespace pcl_uvol
