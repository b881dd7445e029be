// SPDX-License-Identifier: BSD-3-Clause
// Which columns of a table hold the coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol::io {

/** \brief The columns of x, y and z. */
struct CoordinateColumns {
  std::array<std::size_t, 3> columns{{0, 1, 2}};
  std::string note; ///< what their names do not promise; empty: nothing
};

/** \brief Find coordinates by the names of columns.
 *
 * In this order: x, y, z; the same with a unit of length, as x_km, "y (m)", z[ft], or
 * without one (x_coord), where a vertical (elevation, rl, altitude, height, depth) is
 * as good as z, and z may have any ending (z_minus_dbar); easting, northing and a
 * vertical; longitude, latitude and a vertical. A note tells of degrees, and of units
 * of length that differ. Upper and lower case are the same, and of several columns the
 * first counts.
 * \return nothing if the names tell no coordinates */
std::optional<CoordinateColumns>
recognizeCoordinates(const std::vector<std::string>& names);

/** \brief Whether a name tells an axis of any of these systems, alone or not. */
bool
mayBeCoordinate(const std::string& name);

/** \brief Whether a name tells a time, as time_s, timestamp and "date (UTC)" do: such a
 * column is no coordinate unless it is chosen. */
bool
saysTime(const std::string& name);

/** \brief The columns that a user chose.
 * \param chosen names, or numbers from 0
 * \throws InvalidArgument for a column that is not there, and for one that is chosen
 * twice */
std::array<std::size_t, 3>
findChosenColumns(const std::array<std::string, 3>& chosen,
                  const std::vector<std::string>& names);

} // namespace pcl_uvol::io
