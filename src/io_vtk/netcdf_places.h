// SPDX-License-Identifier: BSD-3-Clause
// Where the samples of a file of NetCDF are: which variables tell, and how places on
// the globe become coordinates.
#pragma once

#include "io_vtk/netcdf_samples.h"
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/common/message.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief The variables that tell x, y and z, null for one that none tells. */
struct PlaceVariables {
  std::array<const NetcdfVariable*, 3> axes{};
  bool is_global = false; ///< the first two are longitude and latitude, in degrees

  /** \brief Those that there are. */
  std::vector<NetcdfVariable>
  list() const;
};

/** \brief Finds places by standard names, units, axes and usual names, as CF has them.
 *
 * \throws IOError where there are none */
PlaceVariables
findPlaces(const NetcdfFile& file);

/** \brief From numbers of a variable to a coordinate. */
struct AxisMap {
  double origin = 0.0, factor = 1.0;
  bool is_longitude = false; ///< the difference is that of the shorter way

  double
  apply(double number) const;
};

/** \brief The maps of all axes: longitude and latitude become kilometres or metres to
 * the east and north of an origin; depths and pressures count downwards. */
struct PlaceMaps {
  std::array<AxisMap, 3> axes;
  std::optional<MapProjection> projection; ///< none of places in x and y
};

/** \param wanted what the projection shall be like, see chooseMap()
 * \param notes get one that says so */
PlaceMaps
mapPlaces(const SampleSpace& space,
          const PlaceVariables& places,
          const MapProjection& wanted,
          std::vector<Message>& notes);

} // namespace io
} // namespace pcl_uvol
