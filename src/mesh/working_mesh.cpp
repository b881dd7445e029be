// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/working_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

namespace {

constexpr double degrees = 180.0 / 3.14159265358979323846;

} // namespace

double
smallestAngle(const std::array<Eigen::Vector3d, 3>& corners)
{
  double smallest = 180.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d u = corners[(i + 1) % 3] - corners[i],
                          v = corners[(i + 2) % 3] - corners[i];
    smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)) * degrees);
  }
  return smallest;
}

double
WorkingMesh::agreementOf(const Triangle& triangle) const
{
  const Eigen::Vector3d normal = normalOf(triangle);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t vertex : triangle)
    mean += vertices[vertex].foot.normal;
  const double lengths = normal.norm() * mean.norm();
  return lengths > 0.0 ? normal.dot(mean) / lengths : -1.0;
}

void
WorkingMesh::dropUnused()
{
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(vertices.size(), unused);
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t vertex : triangle)
      place[vertex] = 0;
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (place[i] != unused) {
      place[i] = count;
      vertices[count++] = vertices[i];
    }
  vertices.resize(count);
  for (Triangle& triangle : triangles)
    for (std::uint32_t& vertex : triangle)
      vertex = place[vertex];
}

} // namespace pcl_uvol::detail
