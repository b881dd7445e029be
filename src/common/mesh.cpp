// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/dataset.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace pcl_uvol {

std::vector<std::array<float, 3>>
computeVertexNormals(const Mesh& mesh)
{
  const auto vertex = [&](std::uint32_t index) -> Eigen::Vector3d {
    return Eigen::Map<const Eigen::Vector3f>(mesh.vertices[index].data())
        .cast<double>();
  };
  std::vector<Eigen::Vector3d> sums(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3d a = vertex(triangle[0]);
    const Eigen::Vector3d twice_area =
        (vertex(triangle[1]) - a).cross(vertex(triangle[2]) - a);
    for (const std::uint32_t corner : triangle)
      sums[corner] += twice_area;
  }
  std::vector<std::array<float, 3>> normals(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Eigen::Vector3f normal = sums[i].stableNormalized().cast<float>();
    std::copy_n(normal.data(), 3, normals[i].begin());
  }
  return normals;
}

} // namespace pcl_uvol
