// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/creases.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {

namespace {

/** A point of a line that is farther, in local lengths, from the middle of an edge
 * across it belongs to another one. Cells are told apart by their centres, and a
 * surface that leaves the box at a small angle does so some cells away. */
constexpr double farthest_point = 5.0;

MeshRegion
regionOf(const WorkingVertex& vertex)
{
  if (vertex.is_on_surface)
    return surface_region;
  MeshRegion side = 0;
  while ((vertex.sides >> side & 1) == 0)
    ++side;
  return side;
}

/** The place of a vertex on the surface goes down to it. */
void
putOnSurface(const WorkingMesh& mesh,
             const std::vector<Foot>& feet,
             WorkingVertex& vertex)
{
  const Foot foot = mesh.footBelow(vertex, vertex.foot.place, feet);
  if ((foot.place - vertex.foot.place).norm() <= farthest_point * vertex.size)
    vertex.foot.place = foot.place;
  vertex.foot.normal = foot.normal;
  vertex.foot.mean_curvature = foot.mean_curvature;
}

/** Splits triangle after triangle. */
class CreaseSplitter {
public:
  explicit CreaseSplitter(WorkingMesh& mesh)
      : mesh_(mesh)
      , count_(static_cast<std::uint32_t>(mesh.vertices.size()))
  {
    for (const WorkingVertex& vertex : mesh.vertices)
      region_of_.push_back(regionOf(vertex));
    for (const Triangle& triangle : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
        if (a < b && region_of_[a] != region_of_[b])
          crossed_.push_back({a, b});
      }
    std::sort(crossed_.begin(), crossed_.end());
    for (const CellPair& edge : crossed_)
      mesh_.vertices.push_back(
          meet({mesh_.vertices[edge.lower], mesh_.vertices[edge.higher]}));
  }

  void
  run()
  {
    const std::vector<Triangle> triangles = std::move(mesh_.triangles);
    mesh_.triangles.clear();
    mesh_.regions.clear();
    for (const Triangle& triangle : triangles)
      split(triangle);
  }

private:
  /** The vertex where the regions of some others meet: on the sides of those on caps,
   * and on the surface if one of them is. */
  WorkingVertex
  meet(const std::vector<WorkingVertex>& corners) const
  {
    WorkingVertex vertex;
    vertex.is_on_surface = false;
    vertex.size = 0.0;
    vertex.foot = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
    vertex.pair = corners.front().pair;
    std::vector<Foot> feet;
    const auto count = static_cast<double>(corners.size());
    for (const WorkingVertex& corner : corners) {
      vertex.size += corner.size / count;
      vertex.foot.place += corner.foot.place / count;
      vertex.foot.normal += corner.foot.normal;
      if (corner.is_on_surface) {
        vertex.is_on_surface = true;
        vertex.pair = corner.pair;
        feet.push_back(corner.foot);
      }
    }
    for (const WorkingVertex& corner : corners)
      if (!corner.is_on_surface) {
        vertex.sides |= corner.sides;
        const Eigen::Vector3d across = corner.foot.place - vertex.foot.place;
        vertex.foot.place += across - keepWithin(corner.sides, across);
      }
    vertex.foot.normal = vertex.foot.normal.stableNormalized();
    if (vertex.is_on_surface)
      putOnSurface(mesh_, feet, vertex);
    return vertex;
  }

  std::uint32_t
  vertexAt(std::uint32_t a, std::uint32_t b) const
  {
    const auto at = std::lower_bound(
        crossed_.begin(), crossed_.end(), CellPair{std::min(a, b), std::max(a, b)});
    return count_ + static_cast<std::uint32_t>(at - crossed_.begin());
  }

  void
  add(const Triangle& triangle, MeshRegion region)
  {
    mesh_.triangles.push_back(triangle);
    mesh_.regions.push_back(region);
  }

  void
  split(const Triangle& triangle)
  {
    const auto regionAt = [&](std::size_t i) { return region_of_[triangle[i % 3]]; };
    if (regionAt(0) == regionAt(1) && regionAt(1) == regionAt(2))
      return add(triangle, regionAt(0));
    for (std::size_t i = 0; i < 3; ++i)
      if (regionAt(i + 1) == regionAt(i + 2))
        return cutTip({triangle[i], triangle[(i + 1) % 3], triangle[(i + 2) % 3]});
    cutIntoThree(triangle);
  }

  /** The first corner is alone in its region. */
  void
  cutTip(const Triangle& triangle)
  {
    const auto [tip, a, b] = triangle;
    const std::uint32_t at_a = vertexAt(tip, a), at_b = vertexAt(tip, b);
    const auto distance = [&](std::uint32_t i, std::uint32_t k) {
      return (mesh_.vertices[i].foot.place - mesh_.vertices[k].foot.place)
          .squaredNorm();
    };
    const MeshRegion other = region_of_[a];
    add({tip, at_a, at_b}, region_of_[tip]);
    if (distance(a, at_b) <= distance(at_a, b)) {
      add({at_a, a, at_b}, other);
      add({a, b, at_b}, other);
    }
    else {
      add({at_a, a, b}, other);
      add({at_a, b, at_b}, other);
    }
  }

  void
  cutIntoThree(const Triangle& triangle)
  {
    const auto [a, b, c] = triangle;
    const auto center = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(
        meet({mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]}));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = triangle[i];
      const std::uint32_t after = vertexAt(corner, triangle[(i + 1) % 3]),
                          before = vertexAt(corner, triangle[(i + 2) % 3]);
      add({corner, after, center}, region_of_[corner]);
      add({corner, center, before}, region_of_[corner]);
    }
  }

  WorkingMesh& mesh_;
  std::uint32_t count_;               // vertices that were there before
  std::vector<MeshRegion> region_of_; // by these
  std::vector<CellPair> crossed_;     // edges across lines, ascending
};

} // namespace

void
splitCreases(WorkingMesh& mesh)
{
  CreaseSplitter(mesh).run();
}

} // namespace pcl_uvol::detail
