// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes: what cluster hulls and contours are, and what points are spread
// over.
#pragma once

#include <pcl_uvol/common/export.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Indices of vertices, counter-clockwise as seen from outside. */
using Triangle = std::array<std::uint32_t, 3>;

/** \brief Vertices and triangles. */
struct Mesh {
  std::vector<std::array<float, 3>> vertices;
  std::array<double, 3> origin{{0.0, 0.0, 0.0}}; ///< to be added to the vertices
  std::vector<Triangle> triangles;
};

/** \brief Unit normals of the vertices: means of their triangles', weighted by area; 0
 * for a vertex without any.
 * \param mesh whose triangles name vertices that it has */
PCL_UVOL_EXPORTS std::vector<std::array<float, 3>>
computeVertexNormals(const Mesh& mesh);

} // namespace pcl_uvol
