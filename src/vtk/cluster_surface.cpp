// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/stretch_axes.h"
#include "multivariate/cluster_hull.h"
#include "multivariate/mesh_distance.h"
#include "multivariate/spanning_tree.h"
#include "vtk/contour.h"
#include <pcl_uvol/neighbors/voronoi_diagram.h>
#include <pcl_uvol/vtk/cluster_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

namespace pcl_uvol {

namespace {

/** Cells beyond the surface: it must not leave the grid. */
constexpr std::uint32_t margin = 2;

/** Distances below that, in cells, leave bubbles around each point. */
constexpr double smallest_distance = 1.5;

/** The finite points of a cluster, in the stretched space. */
struct Members {
  std::vector<Position> positions;
  std::vector<std::uint32_t> points; ///< index in the cloud
};

Members
finiteMembers(const CloudView& cloud,
              const pcl::Indices& members,
              const Eigen::Array3f& scale)
{
  Members finite;
  for (const auto member : members) {
    const float* const p = cloud.xyz(static_cast<std::size_t>(member));
    const Position position{{scale[0] * p[0], scale[1] * p[1], scale[2] * p[2]}};
    if (!std::isfinite(position[0]) || !std::isfinite(position[1]) ||
        !std::isfinite(position[2]))
      continue;
    finite.positions.push_back(position);
    finite.points.push_back(static_cast<std::uint32_t>(member));
  }
  return finite;
}

/** A grid over everything within a distance of points. */
GridShape
shapeAround(const std::vector<Position>& positions,
            double distance,
            std::uint32_t cells)
{
  std::array<double, 3> low{{1e300, 1e300, 1e300}}, high{{-1e300, -1e300, -1e300}};
  for (const Position& position : positions)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], position.x[axis] - distance);
      high[axis] = std::max(high[axis], position.x[axis] + distance);
    }
  return GridShape::cubes(low, high, cells, margin);
}

/** The distance to use: beyond the longest edge of the spanning tree unless given. */
double
chooseDistance(const std::vector<Position>& positions,
               const ClusterSurfaceParameters& parameters,
               unsigned threads,
               Report& report)
{
  if (!(parameters.distance >= 0.0) || !std::isfinite(parameters.distance))
    throw InvalidArgument("cluster_distance_not_allowed", {});
  const double longest = longestSpanningEdge(positions, threads, report);
  if (parameters.distance > 0.0) {
    if (parameters.distance < 0.5 * longest)
      report.warn("short_distance", {{"edge", longest}});
    return parameters.distance;
  }
  if (longest == 0.0)
    throw InvalidArgument("cluster_at_one_place", {});
  // One cell more: the field is known between the centres of cells only.
  const double cell = shapeAround(positions, longest, parameters.cells).spacing[0];
  // The grid grows with the distance. None is large enough for 3 cells.
  const double extent = cell * parameters.cells - 2.0 * longest;
  const double cells_left = parameters.cells - 2.0 * smallest_distance;
  const double least = cells_left > 0.0 ? smallest_distance * extent / cells_left : 0.0;
  return std::max(longest + cell, 1.0001 * least);
}

/** The site whose cell is nearest to every vertex: one of those of the cells around. */
std::vector<std::uint32_t>
findRegions(const std::vector<std::array<float, 3>>& vertices, const VoronoiGrid& grid)
{
  const GridShape& shape = grid.getShape();
  std::vector<std::uint32_t> regions;
  regions.reserve(vertices.size());
  for (const auto& vertex : vertices) {
    std::uint32_t region = no_site;
    double least = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
      std::array<double, 3> place{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] = vertex[axis] + ((corner >> axis & 1) - 0.5) * shape.spacing[axis];
      const std::uint32_t site = grid.getNearest()[shape.indexOf(shape.cellAt(place))];
      const auto center = shape.centerOf(grid.getSites()[site]);
      const double distance = std::hypot(
          center[0] - vertex[0], center[1] - vertex[1], center[2] - vertex[2]);
      if (distance < least || (distance == least && site < region)) {
        least = distance;
        region = site;
      }
    }
    regions.push_back(region);
  }
  return regions;
}

/** The member that lies farthest from the middle. */
struct Outlier {
  std::uint32_t point = 0; ///< index in the cloud
  double ratio = 0.0;      ///< its distance by that of the median member
};

Position
findMiddle(const std::vector<Position>& positions)
{
  Position middle{};
  std::vector<float> sorted(positions.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::transform(positions.begin(),
                   positions.end(),
                   sorted.begin(),
                   [&](const Position& position) { return position.x[axis]; });
    const auto half = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), half, sorted.end());
    middle.x[axis] = *half;
  }
  return middle;
}

/** \return none where no member lies far out */
std::optional<Outlier>
findOutlier(const Members& members)
{
  constexpr double far_out = 5.0;
  const Position middle = findMiddle(members.positions);
  std::vector<double> distances;
  for (const Position& position : members.positions)
    distances.push_back(std::hypot(position.x[0] - middle.x[0],
                                   position.x[1] - middle.x[1],
                                   position.x[2] - middle.x[2]));
  const auto farthest = std::max_element(distances.begin(), distances.end());
  const std::uint32_t point =
      members.points[static_cast<std::size_t>(farthest - distances.begin())];
  const double largest = *farthest;
  const auto half =
      distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), half, distances.end());
  if (!(largest > far_out * *half))
    return std::nullopt;
  return Outlier{point, largest / *half};
}

/** A hull has one corner per cell at most: it tells little of points that share them.
 * Distances from cells are about those from points, unless a few far out make the cells
 * large. */
void
warnOfSharedCells(const Members& members,
                  ClusterSurfaceKind kind,
                  std::size_t filled_cells,
                  Report& report)
{
  if (2 * filled_cells >= members.positions.size())
    return;
  const auto outlier = findOutlier(members);
  const bool is_distance = kind == ClusterSurfaceKind::Distance;
  if (is_distance && !outlier)
    return;
  report.warn("shared_cells",
              {{"points", members.positions.size()},
               {"cells", filled_cells},
               {"is_distance", is_distance},
               {"has_outlier", outlier.has_value()},
               {"point", outlier ? outlier->point : 0},
               {"ratio", outlier ? std::nearbyint(outlier->ratio) : 0.0}});
}

/** Turns a surface at a distance into the hull. */
void
shrinkToHull(const Members& members,
             const VoronoiGrid& grid,
             ClusterSurface& surface,
             Report& report)
{
  const StepTimer timer(report, "hull");
  const ClusterHull hull =
      makeClusterHull(surface.mesh.triangles, findRegions(surface.mesh.vertices, grid));
  if (hull.triangles.empty()) {
    const auto outlier = findOutlier(members);
    throw InvalidArgument("no_hull",
                          {{"has_outlier", outlier.has_value()},
                           {"point", outlier ? outlier->point : 0},
                           {"ratio", outlier ? std::nearbyint(outlier->ratio) : 0.0}});
  }
  surface.mesh.vertices.clear();
  for (const std::uint32_t site : hull.regions) {
    const std::uint32_t member = *grid.getMembers()[site].begin();
    const Position& position = members.positions[member];
    surface.points.push_back(members.points[member]);
    surface.mesh.vertices.push_back({{position[0], position[1], position[2]}});
  }
  surface.mesh.triangles = hull.triangles;
  report.count("split_pieces", hull.split_pieces);
}

/** Vertices and distances between them are floats. */
void
checkExtent(const GridShape& shape)
{
  double farthest = 0.0, sq_diagonal = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = shape.spacing[axis] * shape.cells[axis];
    farthest = std::max({farthest,
                         std::abs(shape.origin[axis]),
                         std::abs(shape.origin[axis] + extent)});
    sq_diagonal += extent * extent;
  }
  if (std::max(farthest, std::sqrt(sq_diagonal)) > std::numeric_limits<float>::max())
    throw InvalidArgument("cluster_too_large", {});
}

void
checkScale(const Eigen::Array3f& scale)
{
  for (const float factor : scale)
    if (!(factor > 0.0f) || !std::isfinite(factor))
      throw InvalidArgument("scale_not_positive", {{"scale", factor}});
}

} // namespace

ClusterSurface
detail::encloseCluster(const CloudView& cloud,
                       const pcl::Indices& members,
                       const ClusterSurfaceParameters& parameters,
                       unsigned threads,
                       Report& report)
{
  const ClusterSurfaceKind kind = parameters.kind;
  checkScale(parameters.scale);
  const StretchAxes axes(parameters.rotation);
  const Members finite = finiteMembers(axes.turn(cloud), members, parameters.scale);
  const std::vector<Position>& positions = finite.positions;
  report.count("non_finite", members.size() - positions.size());
  if (positions.empty())
    throw InvalidArgument("cluster_without_positions", {});
  report.count("members", positions.size());
  if (kind != ClusterSurfaceKind::Distance && positions.size() < 3)
    throw InvalidArgument("few_points_for_hull", {{"points", positions.size()}});
  ClusterSurface surface;
  surface.distance = chooseDistance(positions, parameters, threads, report);
  const GridShape shape = shapeAround(positions, surface.distance, parameters.cells);
  checkExtent(shape);
  if (surface.distance < smallest_distance * shape.spacing[0])
    throw InvalidArgument("small_cluster_distance",
                          {{"distance", surface.distance}, {"cell", shape.spacing[0]}});
  std::vector<std::uint32_t> all(positions.size());
  std::iota(all.begin(), all.end(), 0u);
  FeatureTransform way;
  const VoronoiGrid grid(shape,
                         positions[0].x,
                         sizeof(Position) / sizeof(float),
                         all,
                         way,
                         threads,
                         report);
  const auto contour = [&](const std::vector<float>& distances) {
    const StepTimer timer(report, "contour");
    surface.mesh = contourGrid(shape, distances, surface.distance);
  };
  warnOfSharedCells(finite, kind, grid.getSites().size(), report);
  contour(grid.computeDistances(threads));
  if (kind != ClusterSurfaceKind::Distance)
    shrinkToHull(finite, grid, surface, report);
  if (kind == ClusterSurfaceKind::HullDistance) {
    contour(distanceToMesh(shape, surface.mesh, threads, report));
    surface.points.clear();
  }
  const Eigen::Matrix3d back = axes.getRows().transpose();
  for (auto& vertex : surface.mesh.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      vertex[axis] /= parameters.scale[static_cast<Eigen::Index>(axis)];
    if (axes.areTurned()) {
      Eigen::Map<Eigen::Vector3f> place(vertex.data());
      place = (back * place.cast<double>()).cast<float>();
    }
  }
  // Exactly the points, whatever the scale.
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    std::copy_n(cloud.xyz(surface.points[i]), 3, surface.mesh.vertices[i].begin());
  report.count("vertices", surface.mesh.vertices.size());
  report.count("triangles", surface.mesh.triangles.size());
  return surface;
}

std::string
ClusterSurfaceParameters::toJson() const
{
  return writeJson(*this);
}

ClusterSurfaceParameters
ClusterSurfaceParameters::fromJson(const std::string& text)
{
  return readJson<ClusterSurfaceParameters>(text);
}

} // namespace pcl_uvol
