// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes, to scatter points over: test data for everything that takes
// surfaces.
#pragma once

#include <pcl_uvol/common/export.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Vertices and triangles, wound counter-clockwise as seen from outside. */
struct Mesh {
  std::vector<std::array<float, 3>> vertices;
  std::array<double, 3> origin{{0.0, 0.0, 0.0}}; ///< to be added to the vertices
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/** \brief Read a PLY mesh; polygons become fans of triangles.
 * \throws IOError in one sentence, also for a file without faces */
PCL_UVOL_EXPORTS Mesh
loadMesh(const std::string& path);

/** \brief A point on a mesh, relative to its origin, and the normal of its triangle. */
struct MeshPoint {
  std::array<float, 3> position, normal;
};

/** \brief Points spread evenly by area: one in every n-th part of it, at a place that
 * depends on seed and index only.
 * \throws InvalidArgument for a mesh without area */
PCL_UVOL_EXPORTS std::vector<MeshPoint>
scatterOverMesh(const Mesh& mesh, std::uint64_t n, std::uint64_t seed);

} // namespace pcl_uvol
