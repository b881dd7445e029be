// SPDX-License-Identifier: BSD-3-Clause
// Positions in degrees of longitude and latitude, and the map that they are put on.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/common/message.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

class RecordSource;

/** \brief Calls a function with the longitude and latitude of each sample. */
using VisitGlobe =
    std::function<void(const std::function<void(double east, double north)>&)>;

/** \brief Complete a map by the positions on it: the origin is their median, and a
 * region smaller than 100 km is in metres. Few positions far from the others have no
 * say; a note names them.
 * \param visit is called twice
 * \param wanted what it says already is kept
 * \param latitude name of the field, for the note */
PCL_UVOL_EXPORTS MapProjection
chooseMap(const VisitGlobe& visit,
          const MapProjection& wanted,
          const std::string& latitude,
          std::vector<Message>& notes);

/** \brief "Positions are mapped around 8.5 E, 42.5 S: x and y are metres to the east
 * and north."
 * \param z what z is, if that is told as well */
PCL_UVOL_EXPORTS Message
describeMap(const MapProjection& map, const std::string& z = "");

/** \brief Put points on a map by their fields of longitude and latitude, if they have
 * both and are on no map yet; z stays as it is. Without a map only say on which one
 * they are, if their coordinates follow from these fields, as those of surfaces do.
 * \param wanted see LoadOptions::map */
void
putOnMap(Dataset& points, const std::optional<MapProjection>& wanted);

/** \brief The records of a source, put on a map as putOnMap() does it with points.
 * \param source is returned as it is without such fields, and if it is on a map */
std::unique_ptr<RecordSource>
mapRecords(std::unique_ptr<RecordSource> source, const MapProjection& wanted);

} // namespace io
} // namespace pcl_uvol
