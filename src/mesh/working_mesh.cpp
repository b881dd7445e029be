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
WorkingMesh::agreementOf(const Triangle& triangle, MeshRegion region) const
{
  const Eigen::Vector3d normal = normalOf(triangle);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t vertex : triangle)
    if (vertices[vertex].is_on_surface == (region == surface_region))
      mean += vertices[vertex].foot.normal;
  const double lengths = normal.norm() * mean.norm();
  return lengths > 0.0 ? normal.dot(mean) / lengths : -1.0;
}

bool
WorkingMesh::isWithinBox(const Eigen::Vector3d& place) const
{
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<std::size_t>(2 * axis);
    if (place[axis] < sides[low] || place[axis] > sides[low + 1])
      return false;
  }
  return true;
}

Eigen::Vector3d
WorkingMesh::keepInBox(const WorkingVertex& vertex, const Eigen::Vector3d& place) const
{
  constexpr double least_distance = 0.05; // of the local length
  Eigen::Vector3d kept = place;
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<std::size_t>(2 * axis);
    const double margin =
        std::min(least_distance * vertex.size, 0.5 * (sides[low + 1] - sides[low]));
    if (!isBound(vertex.sides, axis))
      kept[axis] = std::clamp(kept[axis], sides[low] + margin, sides[low + 1] - margin);
  }
  return kept;
}

Foot
WorkingMesh::footBelow(const WorkingVertex& vertex,
                       const Eigen::Vector3d& place,
                       const std::vector<Foot>& feet) const
{
  Foot foot = blendFeet(feet, place, vertex.size, vertex.sides);
  if (vertex.sides == 0)
    return foot;
  // Back and forth between the surface and the box until the place is on both.
  constexpr int rounds = 5;
  for (int round = 0; round < rounds; ++round) {
    const Eigen::Vector3d kept = keepInBox(vertex, foot.place);
    if (kept == foot.place)
      break;
    foot = blendFeet(feet, kept, vertex.size, vertex.sides);
  }
  foot.place = keepInBox(vertex, foot.place);
  return foot;
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
