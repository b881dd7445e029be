// SPDX-License-Identifier: BSD-3-Clause
// Meshes as files.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/mesh.h>
#include <pcl_uvol/io/dataset.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Read a mesh as the other loadMesh() does, places and faces only.
 * \param path of the file
 * \throws IOError in one sentence, also for a file without faces */
PCL_UVOL_EXPORTS Mesh
loadMesh(const std::string& path);

/** \brief Read the vertices of a .ply, .vtp, .vtkhdf, .obj, .off or .stl with all their
 * fields, and its faces, as saveMesh() writes them; polygons become fans of triangles.
 * Vertices of an .obj have normals where all faces name the same one at each; corners
 * of an .stl at one place become one vertex. \param[out] triangles stay empty for a
 * file of points \param path of the file \throws IOError in one sentence */
PCL_UVOL_EXPORTS Dataset
loadMesh(const std::string& path, std::vector<Triangle>& triangles);

/** \brief Write a mesh as .ply, .vtp or .vtkhdf with all fields of the vertices, as
 * .obj with their normals, or as .off or .stl, by the ending of the name. STL is
 * written in binary and in single precision, relative to the origin of the vertices;
 * the others hold all digits. The file appears whole or not at all. \param vertices
 * with any fields \param path of the file \param triangles of these vertices \param
 * options text or binary, comments \throws IOError, also for another ending */
PCL_UVOL_EXPORTS void
saveMesh(const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options = {});

/** \brief Throw IOError unless saveMesh() knows the ending of the name and its folder
 * can be written to.
 * \param path as saveMesh() will get it */
PCL_UVOL_EXPORTS void
checkMeshPath(const std::string& path);

/** \brief True for the endings of files that may hold a mesh: .ply, .vtp, .vtkhdf, and
 * those of isMeshOnly(). \param path of a file that need not be there */
PCL_UVOL_EXPORTS bool
isMeshPath(const std::string& path);

/** \brief True for the endings .obj, .off and .stl, of files that hold no points
 * without triangles.
 * \param path of a file that need not be there */
PCL_UVOL_EXPORTS bool
isMeshOnly(const std::string& path);

/** \brief The vertices of a mesh with their normals, as points.
 * \param mesh whose triangles are left out */
PCL_UVOL_EXPORTS Dataset
toDataset(const Mesh& mesh);

} // namespace pcl_uvol
