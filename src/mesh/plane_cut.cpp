// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/plane_cut.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace pcl_uvol::detail {
namespace {

/** Numbers the vertices of a cut mesh as they are met. */
class CutVertices {
public:
  explicit CutVertices(const std::vector<double>& heights)
      : heights_(heights)
      , kept_(heights.size(), none)
  {
  }

  bool
  isAbove(std::uint32_t vertex) const
  {
    return heights_[vertex] >= 0.0;
  }

  std::uint32_t
  keep(std::uint32_t vertex)
  {
    if (kept_[vertex] == none)
      kept_[vertex] = append({vertex, vertex, 0.0f});
    return kept_[vertex];
  }

  /** \brief The vertex in the plane, on an edge from above to below. */
  std::uint32_t
  cut(std::uint32_t above, std::uint32_t below)
  {
    if (heights_[above] == 0.0)
      return keep(above);
    const auto found = on_edges_.find({above, below});
    if (found != on_edges_.end())
      return found->second;
    const double t = heights_[above] / (heights_[above] - heights_[below]);
    const std::uint32_t vertex = append({above, below, static_cast<float>(t)});
    on_edges_.emplace(std::pair(above, below), vertex);
    return vertex;
  }

  IsoEdges
  take() &&
  {
    return std::move(vertices_);
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t
  append(const IsoEdge& vertex)
  {
    vertices_.push_back(vertex);
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  const std::vector<double>& heights_;
  std::vector<std::uint32_t> kept_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> on_edges_;
  IsoEdges vertices_;
};

void
appendPolygon(const std::vector<std::uint32_t>& corners,
              std::vector<Triangle>& triangles)
{
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

} // namespace

PlaneCut
cutByPlane(const std::vector<double>& heights, const std::vector<Triangle>& triangles)
{
  CutVertices vertices(heights);
  PlaneCut result;
  std::vector<std::uint32_t> corners;
  for (const Triangle& triangle : triangles) {
    // One that only touches the plane from below would leave a point or an edge.
    if (std::none_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
          return heights[vertex] > 0.0;
        }))
      continue;
    corners.clear();
    const auto add = [&](std::uint32_t corner) {
      if (corners.empty() || (corners.back() != corner && corners.front() != corner))
        corners.push_back(corner);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      if (vertices.isAbove(from))
        add(vertices.keep(from));
      if (vertices.isAbove(from) != vertices.isAbove(to))
        add(vertices.isAbove(from) ? vertices.cut(from, to) : vertices.cut(to, from));
    }
    appendPolygon(corners, result.triangles);
  }
  result.vertices = std::move(vertices).take();
  return result;
}

} // namespace pcl_uvol::detail
