// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/mesh_distance.h"

#include "neighbors/site_distances.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

using Place = std::array<double, 3>;

/** Marks the cells that a mesh goes through. */
class Rasterizer {
public:
  Rasterizer(const GridShape& shape, std::vector<std::uint8_t>& marks)
      : shape_(shape)
      , marks_(marks)
  {
  }

  /** Where a line through the centres of cells, along any axis, meets the triangle: no
   * step from a cell to the next one then goes through the mesh unseen. */
  void
  mark(const Place& a, const Place& b, const Place& c)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
      markAlong(axis, toCells(a), toCells(b), toCells(c));
    // Thin triangles may lie between all these lines.
    markEdge(a, b);
    markEdge(b, c);
    markEdge(c, a);
  }

  void
  mark(const Place& place)
  {
    marks_[shape_.indexOf(shape_.cellAt(place))] = 1;
  }

private:
  /** The cells of places on an edge, half a cell apart at most. */
  void
  markEdge(const Place& a, const Place& b)
  {
    double length = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      length = std::max(length, std::abs(b[axis] - a[axis]) / shape_.spacing[axis]);
    const auto steps = static_cast<std::int64_t>(std::ceil(2.0 * length));
    for (std::int64_t step = 1; step < steps; ++step) {
      const double part = static_cast<double>(step) / static_cast<double>(steps);
      Place place{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] = a[axis] + part * (b[axis] - a[axis]);
      mark(place);
    }
  }

  /** In units of cells, whole numbers at their centres. */
  Place
  toCells(const Place& place) const
  {
    Place result{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] = (place[axis] - shape_.origin[axis]) / shape_.spacing[axis] - 0.5;
    return result;
  }

  void
  markAlong(std::size_t axis, const Place& a, const Place& b, const Place& c)
  {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double area = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    if (area == 0.0)
      return;
    const auto first = [](double x, double y, double z) {
      return static_cast<int>(
          std::clamp(std::ceil(std::min({x, y, z})), 0.0, double{most_cells}));
    };
    const auto last = [](double x, double y, double z, std::uint32_t cells) {
      return static_cast<int>(
          std::clamp(std::floor(std::max({x, y, z})), -1.0, cells - 1.0));
    };
    const int last_u = last(a[u], b[u], c[u], shape_.cells[u]);
    const int last_v = last(a[v], b[v], c[v], shape_.cells[v]);
    for (int row = first(a[v], b[v], c[v]); row <= last_v; ++row)
      for (int column = first(a[u], b[u], c[u]); column <= last_u; ++column) {
        const double of_b =
            ((column - a[u]) * (c[v] - a[v]) - (row - a[v]) * (c[u] - a[u])) / area;
        const double of_c =
            ((b[u] - a[u]) * (row - a[v]) - (b[v] - a[v]) * (column - a[u])) / area;
        if (!(of_b >= -tolerance && of_c >= -tolerance &&
              of_b + of_c <= 1.0 + tolerance))
          continue;
        const double depth =
            a[axis] + of_b * (b[axis] - a[axis]) + of_c * (c[axis] - a[axis]);
        GridCell cell{};
        cell[u] = static_cast<std::uint16_t>(column);
        cell[v] = static_cast<std::uint16_t>(row);
        cell[axis] = static_cast<std::uint16_t>(
            std::clamp(std::round(depth), 0.0, shape_.cells[axis] - 1.0));
        marks_[shape_.indexOf(cell)] = 1;
      }
  }

  /** The slack of barycentric coordinates: no line slips through between two triangles.
   */
  static constexpr double tolerance = 1e-9;
  static constexpr int most_cells = GridShape::largest_side;

  const GridShape& shape_;
  std::vector<std::uint8_t>& marks_;
};

std::vector<std::uint8_t>
rasterize(const GridShape& shape, const Mesh& mesh, Report& report)
{
  const StepTimer timer(report, "mesh_cells");
  std::vector<std::uint8_t> marks(shape.size(), 0);
  Rasterizer rasterizer(shape, marks);
  const auto placeOf = [&](std::uint32_t vertex) {
    const auto& place = mesh.vertices[vertex];
    return Place{{place[0] + mesh.origin[0],
                  place[1] + mesh.origin[1],
                  place[2] + mesh.origin[2]}};
  };
  for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex)
    rasterizer.mark(placeOf(vertex));
  for (const Triangle& triangle : mesh.triangles)
    rasterizer.mark(placeOf(triangle[0]), placeOf(triangle[1]), placeOf(triangle[2]));
  return marks;
}

/** Calls visit(index) for the cells that share a face with one. */
template <typename Visit>
void
forFaceNeighbors(const GridShape& shape, std::uint64_t index, const Visit& visit)
{
  std::uint64_t rest = index, stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint64_t place = rest % shape.cells[axis];
    rest /= shape.cells[axis];
    if (place > 0)
      visit(index - stride);
    if (place + 1 < shape.cells[axis])
      visit(index + stride);
    stride *= shape.cells[axis];
  }
}

/** Marks what can be reached from the border of the grid without passing the mesh. */
std::vector<std::uint8_t>
findOutside(const GridShape& shape, const std::vector<std::uint8_t>& mesh)
{
  std::vector<std::uint8_t> outside(mesh.size(), 0);
  std::vector<std::uint64_t> open;
  const auto visit = [&](std::uint64_t cell) {
    if (outside[cell] == 0 && mesh[cell] == 0) {
      outside[cell] = 1;
      open.push_back(cell);
    }
  };
  for (std::uint64_t cell = 0; cell < mesh.size(); ++cell) {
    std::size_t faces = 0;
    forFaceNeighbors(shape, cell, [&](std::uint64_t) { ++faces; });
    if (faces < 6)
      visit(cell);
  }
  while (!open.empty()) {
    const std::uint64_t cell = open.back();
    open.pop_back();
    forFaceNeighbors(shape, cell, visit);
  }
  return outside;
}

} // namespace

std::vector<float>
distanceToMesh(const GridShape& shape,
               const Mesh& mesh,
               unsigned threads,
               Report& report)
{
  if (mesh.vertices.empty())
    throw InvalidArgument("distance_to_empty_mesh", {});
  const std::vector<std::uint8_t> marks = rasterize(shape, mesh, report);
  std::vector<GridCell> sites;
  for (std::uint64_t cell = 0; cell < marks.size(); ++cell)
    if (marks[cell] != 0)
      sites.push_back(shape.cellOf(cell));
  FeatureTransform transform;
  auto distances = computeSiteDistances(
      shape, sites, transform.find(shape, sites, threads, report), threads);
  const StepTimer timer(report, "outside");
  const std::vector<std::uint8_t> outside = findOutside(shape, marks);
  for (std::uint64_t cell = 0; cell < distances.size(); ++cell)
    if (outside[cell] == 0)
      distances[cell] = 0.0f;
  return distances;
}

} // namespace pcl_uvol
