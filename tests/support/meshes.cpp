// SPDX-License-Identifier: BSD-3-Clause
#include "support/meshes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace uvol_test {

using Eigen::Vector3d;
using pcl_uvol::Mesh;
using pcl_uvol::Triangle;

namespace {

double
distanceToSegment(const Vector3d& place, const Vector3d& a, const Vector3d& b)
{
  const double sq_length = (b - a).squaredNorm();
  const double along =
      sq_length > 0.0 ? std::clamp((place - a).dot(b - a) / sq_length, 0.0, 1.0) : 0.0;
  return (place - a - along * (b - a)).norm();
}

double
distanceToTriangle(const Vector3d& place,
                   const Vector3d& a,
                   const Vector3d& b,
                   const Vector3d& c)
{
  const Vector3d normal = (b - a).cross(c - a);
  const auto isLeft = [&](const Vector3d& from, const Vector3d& to) {
    return normal.dot((to - from).cross(place - from)) >= 0.0;
  };
  if (normal.norm() > 0.0 && isLeft(a, b) && isLeft(b, c) && isLeft(c, a))
    return std::abs(normal.normalized().dot(place - a));
  return std::min({distanceToSegment(place, a, b),
                   distanceToSegment(place, b, c),
                   distanceToSegment(place, c, a)});
}

} // namespace

Vector3d
vertexOf(const Mesh& mesh, std::uint32_t vertex)
{
  const auto& place = mesh.vertices[vertex];
  return Vector3d(place[0], place[1], place[2]) +
         Eigen::Map<const Vector3d>(mesh.origin.data());
}

bool
isClosed(const std::vector<Triangle>& triangles)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ++edges[{t[i], t[(i + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto opposite = edges.find({edge.first.second, edge.first.first});
    return opposite != edges.end() && opposite->second == edge.second &&
           edge.first.first != edge.first.second;
  });
}

double
signedVolume(const Mesh& mesh)
{
  const Vector3d start = vertexOf(mesh, 0);
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles)
    volume += (vertexOf(mesh, t[0]) - start)
                  .cross(vertexOf(mesh, t[1]) - start)
                  .dot(vertexOf(mesh, t[2]) - start) /
              6.0;
  return volume;
}

double
distanceToTriangles(const Mesh& mesh, const Vector3d& place)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles) {
    const Vector3d a = vertexOf(mesh, t[0]), b = vertexOf(mesh, t[1]),
                   c = vertexOf(mesh, t[2]);
    // No place of a triangle is farther from a corner than one of the other corners.
    const double extent =
        std::sqrt(std::max((b - a).squaredNorm(), (c - a).squaredNorm()));
    if ((place - a).norm() - extent < least)
      least = std::min(least, distanceToTriangle(place, a, b, c));
  }
  return least;
}

} // namespace uvol_test
