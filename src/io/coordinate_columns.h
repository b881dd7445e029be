// SPDX-License-Identifier: BSD-3-Clause
// Which columns of a table hold the coordinates.
#pragma once

#include <pcl_uvol/common/message.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol::io {

/** \brief The columns of x, y and z. */
struct CoordinateColumns {
  std::array<std::size_t, 3> columns{{0, 1, 2}};
  std::optional<Message> note;    ///< what was assumed about their names
  std::optional<Message> mixture; ///< which units distances mix, if that is known
  bool is_global = false; ///< x and y are longitude and latitude in degrees, for a map
};

/** \brief Whether x and y of some columns are longitude and latitude in degrees. */
bool
areGlobal(const std::array<std::size_t, 3>& columns,
          const std::vector<std::string>& names);

/** \brief Whether a name is that of a vertical axis that counts downwards: a depth or
 * a pressure. */
bool
isDownwards(const std::string& name);

/** \brief Find coordinates by the names of columns.
 *
 * Upper and lower case are the same, and so are separators between the words of a name.
 * Words such as position, coordinate, point and center are ignored. In this order:
 * - x, y, z
 * - x, y, z with a unit of length, as x_km, "y (m)", z[ft], or with ignored words, as
 *   pos_x, XCOORD, "Points:0"; a vertical (elevation, rl, altitude, height, depth)
 *   counts as z, and z may have any ending (z_minus_dbar)
 * - easting, northing and a vertical
 * - longitude, latitude and a vertical
 * - x, y, z with another ending in common, as x_kpch, y_kpch, z_kpch; a note says so
 * - px, py, pz or x1, x2, x3; a note says so
 *
 * Words of a vertical and of easting and northing are also those of German, French,
 * Spanish and Italian. On maps a pressure is a vertical, if there is no other.
 *
 * A name with a word of another quantity (velocity, error, ...) is not a coordinate. Of
 * several columns for an axis the first counts.
 * \param on_map longitude and latitude in degrees come first, and no note is about them
 * \return nothing if the names do not contain three axes */
std::optional<CoordinateColumns>
recognizeCoordinates(const std::vector<std::string>& names, bool on_map = false);

/** \brief The first name that has an axis of any of these systems, or is a component of
 * another quantity, as x_vel: then no coordinates are assumed. The letters e and n
 * count only together, as columns of other quantities are called so as well.
 *
 * \return nothing if there is none */
std::optional<std::string>
findPossibleCoordinate(const std::vector<std::string>& names);

/** \brief Whether a name tells a time, as time_s, timestamp and "date (UTC)" do: such a
 * column is no coordinate unless it is chosen. */
bool
saysTime(const std::string& name);

/** \brief The columns that a user chose.
 * \param chosen names, or numbers from 0; three numbers of columns are numbers, unless
 * all three are names as well
 * \throws InvalidArgument for a column that is not there, and for one that is chosen
 * twice */
std::array<std::size_t, 3>
findChosenColumns(const std::array<std::string, 3>& chosen,
                  const std::vector<std::string>& names);

} // namespace pcl_uvol::io
