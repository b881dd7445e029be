// SPDX-License-Identifier: BSD-3-Clause
// Names of longitude and latitude.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <string>

namespace pcl_uvol {

/** \brief A name in lower case and the unit behind its first word: "x (km)" -> "x",
 * "km". */
struct NameParts {
  std::string word, unit;
};

PCL_UVOL_EXPORTS NameParts
splitName(const std::string& name);

/** \brief Whether the first word of a name is longitude (axis 0) or latitude (1). */
PCL_UVOL_EXPORTS bool
saysDegrees(const std::string& word, std::size_t axis);

/** \brief The same of a whole name whose unit is degrees, or is not named: lon,
 * LATITUDE, lat_deg, "Longitude [degrees_east]"; not lon_rad, and not LATITUDE_QC. */
PCL_UVOL_EXPORTS bool
isInDegrees(const std::string& name, std::size_t axis);

} // namespace pcl_uvol
