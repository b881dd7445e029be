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

/** \brief The field that a stage takes of samples.
 *
 * That is the named one. Without a name it is `intensity`, or else the only scalar
 * field. Coordinates, normals, colours, `curvature` and names (strings) are never
 * taken, and neither are fields of several components.
 *
 * \param named by the user; empty: none is named
 *
 * \throws InvalidArgument for a column of names, and without a name if there is no
 * scalar field or if there are several */
PCL_UVOL_EXPORTS std::string
chooseField(const Dataset& samples, const std::string& named);

/** \brief Warn where more than a few of the places of samples have several values, as
 * those of repeated experiments do.
 * \param conflicting values that are the median of different ones
 * \param values one of each field at each place */
PCL_UVOL_EXPORTS void
warnOfConflicts(std::uint64_t conflicting, std::uint64_t values, Report& report);

} // namespace pcl_uvol
