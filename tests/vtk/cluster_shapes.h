// SPDX-License-Identifier: BSD-3-Clause
// Clusters of known shape, and what is true of surfaces around them.
#pragma once

#include "common/random.h"
#include "multivariate/cluster_hull.h"
#include "multivariate/spanning_tree.h"
#include "support/meshes.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/vtk/cluster_surface.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace uvol_test {

using Eigen::Vector3d;
using pcl_uvol::ClusterSurface;
using pcl_uvol::ClusterSurfaceKind;
using pcl_uvol::ClusterSurfaceParameters;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Mesh;
using pcl_uvol::Report;
using pcl_uvol::Triangle;
using pcl_uvol::uniformAt;

constexpr double pi = 3.14159265358979323846;
constexpr std::uint32_t cells = 96;
using Points = std::vector<Vector3d>;

inline ClusterSurfaceParameters
settingsOf(double distance)
{
  ClusterSurfaceParameters settings;
  settings.cells = cells;
  settings.distance = distance;
  return settings;
}

/** A cloud with something before and after the coordinates. */
class Cluster {
public:
  explicit Cluster(const Points& points)
      : members_(points.size())
  {
    for (const Vector3d& point : points) {
      const Eigen::Vector3f p = point.cast<float>();
      floats_.insert(floats_.end(), {-7.0f, p[0], p[1], p[2], 1e9f});
    }
    std::iota(members_.begin(), members_.end(), 0u);
  }

  ClusterSurface
  enclose(ClusterSurfaceKind kind,
          const ClusterSurfaceParameters& settings,
          Report& report,
          unsigned threads = 0) const
  {
    ClusterSurfaceParameters parameters = settings;
    parameters.kind = kind;
    pcl_uvol::CloudView view;
    view.data = reinterpret_cast<const std::uint8_t*>(floats_.data());
    view.count = floats_.size() / 5;
    view.point_step = 5 * sizeof(float);
    view.xyz_offset = sizeof(float);
    return pcl_uvol::detail::encloseCluster(
        view,
        pcl::Indices(members_.begin(), members_.end()),
        parameters,
        threads,
        report);
  }

  ClusterSurface
  enclose(ClusterSurfaceKind kind,
          double distance,
          std::uint32_t along = cells,
          unsigned threads = 0) const
  {
    ClusterSurfaceParameters settings = settingsOf(distance);
    settings.cells = along;
    Report report;
    return enclose(kind, settings, report, threads);
  }

  Vector3d
  operator[](std::size_t i) const
  {
    return {floats_[5 * i + 1], floats_[5 * i + 2], floats_[5 * i + 3]};
  }

  const std::vector<std::uint32_t>&
  members() const
  {
    return members_;
  }

  void
  setMembers(std::vector<std::uint32_t> members)
  {
    members_ = std::move(members);
  }

  /** Side of a cell, by the definition of the settings. */
  double
  voxel(double distance, std::uint32_t along = cells) const
  {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t member : members_)
      box.extend((*this)[member]);
    return (box.sizes().maxCoeff() + 2.0 * distance) / along;
  }

  double
  longestEdge() const
  {
    std::vector<pcl_uvol::Position> positions;
    for (const std::uint32_t member : members_) {
      const Eigen::Vector3f p = (*this)[member].cast<float>();
      positions.push_back({{p[0], p[1], p[2]}});
    }
    Report report;
    return pcl_uvol::longestSpanningEdge(positions, 0, report);
  }

private:
  std::vector<float> floats_;
  std::vector<std::uint32_t> members_;
};

/** Random places in [-2.5, 2.5]^3 that belong to a solid. */
inline Points
pointsIn(std::size_t number,
         std::uint64_t seed,
         const std::function<bool(const Vector3d&)>& contains)
{
  Points points;
  for (std::uint64_t i = 0; points.size() < number; ++i) {
    const Vector3d place =
        5.0 *
        (Vector3d(uniformAt(seed, i, 0), uniformAt(seed, i, 1), uniformAt(seed, i, 2)) -
         Vector3d::Constant(0.5));
    if (contains(place))
      points.push_back(place);
  }
  return points;
}

/** Negative inside; the ring lies in the plane of x and y. */
inline double
distanceToTorus(const Vector3d& place, double radius)
{
  return std::hypot(std::hypot(place.x(), place.y()) - 1.0, place.z()) - radius;
}

inline Points
ballOf(std::size_t number, std::uint64_t seed)
{
  return pointsIn(
      number, seed, [](const Vector3d& place) { return place.norm() <= 1.0; });
}

inline Points
torusOf(std::size_t number, std::uint64_t seed)
{
  return pointsIn(number, seed, [](const Vector3d& place) {
    return distanceToTorus(place, 0.4) <= 0.0;
  });
}

/** The second one goes through the hole of the first one. */
inline Points
linkedTubesOf(std::size_t number, std::uint64_t seed)
{
  return pointsIn(number, seed, [](const Vector3d& place) {
    const Vector3d turned(place.x() - 1.0, place.z(), place.y());
    return std::min(distanceToTorus(place, 0.25), distanceToTorus(turned, 0.25)) <= 0.0;
  });
}

inline Points
bentSheetOf(std::size_t number, std::uint64_t seed)
{
  Points points;
  for (std::uint64_t i = 0; i < number; ++i) {
    const double x = 2.0 * uniformAt(seed, i, 0) - 1.0;
    points.emplace_back(x, 2.0 * uniformAt(seed, i, 1) - 1.0, 0.4 * std::sin(2.0 * x));
  }
  return points;
}

/** Each edge is walked as often in one direction as in the other one; where nothing
 * coincides, the triangles around a vertex are one ring.
 * \return the part of the vertices that nothing coincides at */
inline double
expectClosed(const Mesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::vector<std::map<std::uint32_t, std::uint32_t>> rings(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[{t[i], t[(i + 1) % 3]}];
      rings[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3];
    }
  std::size_t unmatched = 0, torn = 0, apart = 0;
  std::vector<bool> coincides(mesh.vertices.size(), false);
  for (const auto& edge : edges) {
    const auto opposite = edges.find({edge.first.second, edge.first.first});
    unmatched += opposite == edges.end() || opposite->second != edge.second ||
                 edge.first.first == edge.first.second;
    if (edge.second > 1)
      coincides[edge.first.first] = coincides[edge.first.second] = true;
  }
  EXPECT_EQ(0u, unmatched) << "of " << edges.size() << " edges";
  for (std::size_t vertex = 0; vertex < rings.size() && unmatched == 0; ++vertex)
    if (!coincides[vertex]) {
      const auto& ring = rings[vertex];
      std::size_t length = 0;
      std::uint32_t at = ring.empty() ? 0 : ring.begin()->first;
      do
        at = ring.empty() ? 0 : ring.at(at);
      while (++length < ring.size() && at != ring.begin()->first);
      torn += length != ring.size();
      ++apart;
    }
  EXPECT_EQ(0u, torn) << "of " << apart << " vertices";
  return static_cast<double>(apart) / static_cast<double>(rings.size());
}

/** Genus of each component, ascending. */
inline std::vector<long>
generaOf(const Mesh& mesh)
{
  std::vector<std::uint32_t> parents(mesh.vertices.size());
  std::iota(parents.begin(), parents.end(), 0u);
  const auto rootOf = [&](std::uint32_t vertex) {
    while (parents[vertex] != vertex)
      vertex = parents[vertex] = parents[parents[vertex]];
    return vertex;
  };
  for (const Triangle& t : mesh.triangles) {
    parents[rootOf(t[0])] = rootOf(t[1]);
    parents[rootOf(t[1])] = rootOf(t[2]);
  }
  std::map<std::uint32_t, long> twice_euler;
  for (std::uint32_t vertex = 0; vertex < parents.size(); ++vertex)
    twice_euler[rootOf(vertex)] += 2;
  for (const Triangle& t : mesh.triangles)
    --twice_euler[rootOf(t[0])];
  std::vector<long> genera;
  for (const auto& component : twice_euler) {
    EXPECT_EQ(0, component.second % 4);
    genera.push_back(1 - component.second / 4);
  }
  std::sort(genera.begin(), genera.end());
  return genera;
}

/** How often the mesh winds around a place: the solid angles of its triangles (van
 * Oosterom and Strackee 1983). */
inline double
windingNumber(const Mesh& mesh, const Vector3d& place)
{
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d a = vertexOf(mesh, t[0]) - place, b = vertexOf(mesh, t[1]) - place,
                   c = vertexOf(mesh, t[2]) - place;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)),
                      la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2.0 * pi);
}

} // namespace uvol_test
