// SPDX-License-Identifier: BSD-3-Clause
// What all who hand samples to a stage, tools and Python, refuse and warn of.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cstdint>
#include <string>

namespace pcl_uvol {

/** \brief Names have no values between them.
 * \throws InvalidArgument for a column of names */
PCL_UVOL_EXPORTS void
refuseNames(const Dataset& samples, const std::string& field);

/** \brief Warn where more than a few of the places of samples have several values, as
 * those of repeated experiments do.
 * \param conflicting values that are the median of different ones
 * \param values one of each field at each place */
PCL_UVOL_EXPORTS void
warnOfConflicts(std::uint64_t conflicting, std::uint64_t values, Report& report);

} // namespace pcl_uvol
