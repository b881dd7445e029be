// SPDX-License-Identifier: BSD-3-Clause
// Meshes of modelling and printing as vertices and triangles.
#pragma once

#include "io/formats.h"
#include <pcl_uvol/common/export.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** Polygons become fans of triangles.
 * \throws IOError @{ */

/** \brief An .obj: its vertices, with normals where every vertex has one and no more.
 * Textures, materials, groups, lines and points are passed over. */
LoadedMesh
readObj(const std::string& path);

/** \brief An .off, also with colours, which are passed over. */
LoadedMesh
readOff(const std::string& path);

/** \brief An .stl, binary or text. Corners at one place become one vertex; normals,
 * which are those of triangles, are passed over. */
LoadedMesh
readStl(const std::string& path);
/** @} */

/** \brief Corners of the polygons of VTK's files.
 * \param ends of the polygons among their corners, one behind the other
 * \throws IOError unless they ascend */
PCL_UVOL_EXPORTS std::uint64_t
countCorners(const std::string& path, const std::vector<double>& ends);

/** \brief Append the fans of polygons whose corners were counted.
 * \param corners numbers of points
 * \param points that there are
 * \param first number of these points among all
 * \throws IOError for a polygon that names a point that is not there */
PCL_UVOL_EXPORTS void
addFans(const std::string& path,
        const std::vector<double>& ends,
        const std::vector<double>& corners,
        std::uint64_t points,
        std::uint64_t first,
        std::vector<Triangle>& triangles);

} // namespace io
} // namespace pcl_uvol
