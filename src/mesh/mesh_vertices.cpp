// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_vertices.h"

#include "common/parallel.h"
#include "isosurface/smooth_roots.h"
#include "mesh/surface_pieces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t normal_block = 1u << 12;

/** Share of the local length: a fit that moves a vertex farther tells of another sheet.
 */
constexpr double farthest_move = 0.5;

/** Cosine of 60 degrees, which no triangle may exceed by the last move. */
constexpr double least_agreement = 0.5;

/** The samples that a vertex lies between, and where the values between them are the
 * isovalue; where both are on one side, by the fits, the end that is nearer to it. */
IsoEdge
edgeOf(const IsopointInput& input, const WorkingVertex& vertex, float isovalue)
{
  if (!vertex.is_on_surface)
    return {vertex.pair.lower, vertex.pair.lower, 0.0f};
  const auto [a, b] = vertex.pair;
  const double at_a = static_cast<double>(input.values[a]) - isovalue,
               at_b = static_cast<double>(input.values[b]) - isovalue;
  const double t = at_a == at_b ? 0.0 : at_a / (at_a - at_b);
  return {a, b, static_cast<float>(std::clamp(t, 0.0, 1.0))};
}

PointIso
makePoint(const IsopointInput& input, const WorkingVertex& vertex)
{
  const double side = input.outside == Outside::Lower ? 1.0 : -1.0;
  PointIso point;
  double sq_length = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    point.data[axis] = static_cast<float>(vertex.foot.place[axis]);
    point.data_n[axis] = static_cast<float>(side * vertex.foot.normal[axis]);
    if (!vertex.is_on_surface)
      continue;
    const auto& positions = input.samples.getPositions();
    const double along = (static_cast<double>(positions[vertex.pair.lower][axis]) -
                          positions[vertex.pair.higher][axis]) /
                         input.samples.getScale()[axis];
    sq_length += along * along;
  }
  point.edge_length = static_cast<float>(std::sqrt(sq_length));
  if (!vertex.is_on_surface)
    point.support = static_cast<std::uint8_t>(IsoSupport::Rim);
  return point;
}

/** Vertices on fits, which go back where that would turn triangles over. */
class VertexFits {
public:
  VertexFits(const IsopointInput& input, float isovalue, WorkingMesh& mesh)
      : input_(input)
      , isovalue_(isovalue)
      , mesh_(mesh)
  {
  }

  void
  run(Report& report)
  {
    IsoEdges fitted_edges;
    std::vector<PointIso> fitted;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t i = 0; i < mesh_.vertices.size(); ++i) {
      const WorkingVertex& vertex = mesh_.vertices[i];
      points.push_back(makePoint(input_, vertex));
      edges.push_back(edgeOf(input_, vertex, isovalue_));
      if (!vertex.is_on_surface)
        continue;
      vertices.push_back(i);
      fitted.push_back(points.back());
      fitted_edges.push_back(edges.back());
    }
    StepTimer step(report, "smooth_roots", fitted.size());
    std::vector<RootOutcome> outcomes;
    std::vector<std::uint8_t> supports;
    for (const RootFit& fit : fitRoots(input_, isovalue_, fitted_edges, fitted, step))
      outcomes.push_back(fit.outcome);
    for (const PointIso& point : fitted)
      supports.push_back(point.support);
    countRoots(outcomes, supports, input_.errors_only, report);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      points[vertices[i]] = fitted[i];
    settle(vertices);
  }

  IsoEdges edges;
  std::vector<PointIso> points;

private:
  static Eigen::Vector3d
  placeOf(const PointIso& point)
  {
    return point.getVector3fMap().cast<double>();
  }

  bool
  agrees(std::size_t triangle) const
  {
    return mesh_.agreementOf(mesh_.triangles[triangle], mesh_.regions[triangle]) >=
           least_agreement;
  }

  /** Where a vertex that stays on sides of the box meets the surface that a fit tells.
   * A small angle between them makes the place less certain. */
  Eigen::Vector3d
  placeWithinSides(const WorkingVertex& vertex, PointIso& fitted) const
  {
    const Eigen::Vector3d& normal = vertex.foot.normal;
    const double height = normal.dot(vertex.foot.place - placeOf(fitted));
    const Eigen::Vector3d way = wayDown(height, normal, vertex.sides);
    const double slope = keepWithin(vertex.sides, normal).norm();
    const bool is_found = !way.isZero(0.0) && way.norm() <= farthest_move * vertex.size;
    const Eigen::Vector3d met = is_found ? vertex.foot.place + way : vertex.foot.place,
                          place = mesh_.keepInBox(vertex, met);
    const double off = normal.dot(place - placeOf(fitted));
    fitted.error =
        (is_found ? fitted.error / static_cast<float>(slope) : fitted.error) +
        static_cast<float>(std::abs(off));
    return place;
  }

  /** Take the places of the fits where these are near and turn no triangle over. */
  void
  settle(const std::vector<std::uint32_t>& vertices)
  {
    const double side = input_.outside == Outside::Lower ? 1.0 : -1.0;
    std::vector<Foot> before;
    for (const WorkingVertex& vertex : mesh_.vertices)
      before.push_back(vertex.foot);
    std::vector<std::uint8_t> agreed(mesh_.triangles.size());
    parallelBlocks(
        agreed.size(), normal_block, input_.threads, [&](auto begin, auto end) {
          for (std::size_t i = begin; i < end; ++i)
            agreed[i] = agrees(i);
        });
    for (const std::uint32_t i : vertices) {
      WorkingVertex& vertex = mesh_.vertices[i];
      vertex.foot.normal = side * points[i].getNormalVector3fMap().cast<double>();
      const Eigen::Vector3d place =
          vertex.sides == 0 ? placeOf(points[i]) : placeWithinSides(vertex, points[i]);
      if ((place - vertex.foot.place).norm() <= farthest_move * vertex.size)
        vertex.foot.place = place;
    }
    for (std::size_t i = 0; i < agreed.size(); ++i)
      if (agreed[i] && !agrees(i))
        for (const std::uint32_t vertex : mesh_.triangles[i])
          mesh_.vertices[vertex].foot.place = before[vertex].place;
    for (const std::uint32_t i : vertices)
      points[i].getVector3fMap() = mesh_.vertices[i].foot.place.cast<float>();
  }

  const IsopointInput& input_;
  float isovalue_;
  WorkingMesh& mesh_;
};

/** In degrees: no triangle of a smooth surface has an angle as small. */
constexpr double sliver_angle = 5.0;

/** In degrees; 0 for a triangle without area. */
double
smallestAngleOf(const WorkingMesh& mesh, const Triangle& triangle)
{
  return smallestAngle({{mesh.vertices[triangle[0]].foot.place,
                         mesh.vertices[triangle[1]].foot.place,
                         mesh.vertices[triangle[2]].foot.place}});
}

/** What is told of a triangle. */
struct TriangleShape {
  double area, angle;
  bool is_folded;
};

void
measure(const WorkingMesh& mesh,
        unsigned threads,
        SurfaceTriangles& surface,
        Report& report)
{
  std::vector<TriangleShape> shapes(mesh.triangles.size());
  parallelBlocks(shapes.size(), normal_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& triangle = mesh.triangles[i];
      shapes[i] = {mesh.normalOf(triangle).norm(),
                   smallestAngleOf(mesh, triangle),
                   mesh.agreementOf(triangle, mesh.regions[i]) <= 0.0};
    }
  });
  double area = 0.0, on_caps = 0.0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const TriangleShape& shape = shapes[i];
    area += shape.area;
    on_caps += mesh.regions[i] == surface_region ? 0.0 : shape.area;
    surface.folds += shape.is_folded;
    surface.slivers += shape.angle < sliver_angle;
    surface.smallest_angle = std::min(surface.smallest_angle, shape.angle);
  }
  surface.cap_part = area > 0.0 ? on_caps / area : 0.0;
  report.count("folds", surface.folds);
  report.count("slivers", surface.slivers);
  report.count("cap_vertices",
               static_cast<std::uint64_t>(
                   std::count(surface.is_on_cap.begin(), surface.is_on_cap.end(), 1)));
}

} // namespace

SurfaceTriangles
finishMesh(const IsopointInput& input,
           float isovalue,
           WorkingMesh&& mesh,
           const std::vector<std::uint32_t>& sources,
           Report& report)
{
  VertexFits fits(input, isovalue, mesh);
  fits.run(report);
  SurfaceTriangles surface;
  surface.vertices.assign(fits.points.begin(), fits.points.end());
  for (const IsoEdge& edge : fits.edges)
    surface.edges.push_back({sources[edge.first], sources[edge.second], edge.t});
  for (const WorkingVertex& vertex : mesh.vertices)
    surface.is_on_cap.push_back(!vertex.is_on_surface);
  const StepTimer step(report, "checks");
  PieceList list = findPieces(mesh.triangles, mesh.vertices.size());
  measure(mesh, input.threads, surface, report);
  std::uint64_t handles = 0;
  for (const SurfacePiece& piece : list.pieces)
    handles += piece.genus;
  report.count("pieces", list.pieces.size());
  report.count("handles", handles);
  report.count("rim_edges", list.rim_edges);
  surface.piece_of = std::move(list.of_vertex);
  surface.pieces = std::move(list.pieces);
  surface.triangles = std::move(mesh.triangles);
  if (input.outside == Outside::Higher)
    for (Triangle& triangle : surface.triangles)
      std::swap(triangle[1], triangle[2]);
  return surface;
}

} // namespace pcl_uvol::detail
