// SPDX-License-Identifier: BSD-3-Clause
// Meshes of modelling and printing as vertices and triangles.
#pragma once

#include "io/formats.h"

#include <string>

namespace pcl_uvol {
namespace io {

/** Polygons become fans of triangles. \throws IOError @{ */

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

} // namespace io
} // namespace pcl_uvol
