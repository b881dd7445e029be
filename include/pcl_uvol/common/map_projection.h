// SPDX-License-Identifier: BSD-3-Clause
// Longitude and latitude as coordinates on a map, and back.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <array>
#include <limits>
#include <optional>
#include <string>

namespace pcl_uvol {

/** \brief A map of places on the globe: x to the east and y to the north of an origin
 * (equirectangular, true to scale at the latitude of the origin). */
struct PCL_UVOL_EXPORTS MapProjection {
  /** Of the origin, in degrees east; NaN: the median of the samples is taken. */
  double longitude = std::numeric_limits<double>::quiet_NaN();
  /** Of the origin, in degrees north; NaN as longitude is. */
  double latitude = std::numeric_limits<double>::quiet_NaN();
  /** Coordinates per kilometre: 1 for kilometres, 1000 for metres; 0: metres if the
   * region of the samples is smaller than 100 km, else kilometres. */
  double per_kilometre = 0.0;

  /** \brief True if nothing is left to choose by the samples. */
  bool
  isComplete() const;

  /** \brief Coordinates per degree of longitude and of latitude. */
  std::array<double, 2>
  findFactors() const;

  /** \brief x and y of a place.
   * \param east longitude in degrees; the shorter way from the origin counts
   * \param north latitude in degrees */
  std::array<double, 2>
  toMap(double east, double north) const;

  /** \brief Longitude (-180 to 180) and latitude in degrees.
   * \param x coordinate to the east
   * \param y coordinate to the north */
  std::array<double, 2>
  toGlobe(double x, double y) const;

  /** \brief As PROJ writes it: "+proj=eqc +lon_0=8.5 ... +units=km". */
  std::string
  toText() const;

  /** \brief From what toText() gives.
   * \param text of a map
   * \return nothing for another text */
  static std::optional<MapProjection>
  fromText(const std::string& text);
};

/** \brief The map that the coordinates of points are on; nothing without one. It is the
 * frame_id of the cloud, so that every copy of the cloud keeps it.
 * \param points of a data set */
PCL_UVOL_EXPORTS std::optional<MapProjection>
findMap(const Dataset& points);

/** \brief Say that the coordinates of points are on a map.
 * \param points whose coordinates stay as they are
 * \param map without anything left to choose */
PCL_UVOL_EXPORTS void
setMap(Dataset& points, const MapProjection& map);

/** \brief Bring points from their map onto another one. Points without a map stay as
 * they are.
 * \param points whose x and y change
 * \param map without anything left to choose */
PCL_UVOL_EXPORTS void
changeMap(Dataset& points, const MapProjection& map);

/** \brief The names of the fields that are longitude and latitude in degrees, as lon,
 * LATITUDE and lat_deg.
 * \param fields of a cloud
 * \return nothing unless both are there, as single numbers */
PCL_UVOL_EXPORTS std::optional<std::array<std::string, 2>>
findGlobeFields(const std::vector<pcl::PCLPointField>& fields);

/** \brief Give points on a map their longitude and latitude, computed from x and y:
 * the fields that findGlobeFields() finds, else `longitude` and `latitude`. Points
 * without a map stay as they are.
 * \param points get the fields, in double */
PCL_UVOL_EXPORTS void
setGlobeFields(Dataset& points);

} // namespace pcl_uvol
