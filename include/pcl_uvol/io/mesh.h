// SPDX-License-Identifier: BSD-3-Clause
// Meshes as files.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/mesh.h>
#include <pcl_uvol/io/dataset.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Read a PLY mesh; polygons become fans of triangles.
 * \throws IOError in one sentence, also for a file without faces */
PCL_UVOL_EXPORTS Mesh
loadMesh(const std::string& path);

/** \brief Read the vertices of a PLY file with all their fields, and its faces, as
 * saveMesh() writes them; polygons become fans of triangles.
 * \param[out] triangles stay empty for a file of points
 * \throws IOError in one sentence */
PCL_UVOL_EXPORTS Dataset
loadMesh(const std::string& path, std::vector<Triangle>& triangles);

/** \brief Write a mesh as PLY. The file appears whole or not at all.
 * \param vertices with any fields
 * \throws IOError, also for a name that does not end in .ply */
PCL_UVOL_EXPORTS void
saveMesh(const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options = {});

/** \brief Throw IOError unless the name ends in .ply and its folder can be written to.
 */
PCL_UVOL_EXPORTS void
checkMeshPath(const std::string& path);

/** \brief The vertices of a mesh with their normals, as points. */
PCL_UVOL_EXPORTS Dataset
toDataset(const Mesh& mesh);

} // namespace pcl_uvol
