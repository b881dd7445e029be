// SPDX-License-Identifier: BSD-3-Clause
#include "generation/mesh_scatter.h"

#include "common/random.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

Eigen::Vector3d
vertexOf(const Mesh& mesh, std::size_t triangle, std::size_t corner)
{
  const auto& vertex = mesh.vertices[mesh.triangles[triangle][corner]];
  return {vertex[0], vertex[1], vertex[2]};
}

} // namespace

std::vector<MeshPoint>
scatterOverMesh(const Mesh& mesh, std::uint64_t n, std::uint64_t seed)
{
  std::vector<double> area_up_to(mesh.triangles.size());
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3d a = vertexOf(mesh, i, 0);
    area += 0.5 * (vertexOf(mesh, i, 1) - a).cross(vertexOf(mesh, i, 2) - a).norm();
    area_up_to[i] = area;
  }
  if (!(area > 0.0) || !std::isfinite(area))
    throw InvalidArgument("mesh_without_area", {});
  std::vector<MeshPoint> points(n);
  for (std::uint64_t i = 0; i < n; ++i) {
    const double target = area * (static_cast<double>(i) + uniformAt(seed, i, 0)) /
                          static_cast<double>(n);
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end(), target);
    const auto triangle = static_cast<std::size_t>(
        std::min(found, area_up_to.end() - 1) - area_up_to.begin());
    const Eigen::Vector3d a = vertexOf(mesh, triangle, 0);
    const Eigen::Vector3d ab = vertexOf(mesh, triangle, 1) - a;
    const Eigen::Vector3d ac = vertexOf(mesh, triangle, 2) - a;
    const double root = std::sqrt(uniformAt(seed, i, 1)), v = uniformAt(seed, i, 2);
    const Eigen::Vector3f position =
        (a + root * (1.0 - v) * ab + root * v * ac).cast<float>();
    const Eigen::Vector3f normal = ab.cross(ac).stableNormalized().cast<float>();
    std::copy_n(position.data(), 3, points[i].position.begin());
    std::copy_n(normal.data(), 3, points[i].normal.begin());
  }
  return points;
}

} // namespace pcl_uvol
