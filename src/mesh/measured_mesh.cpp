// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/measured_mesh.h"

#include "mesh/half_edges.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

namespace pcl_uvol::detail {

namespace {

Eigen::Vector3d
placeOf(const CloudView& vertices, std::size_t vertex)
{
  return Eigen::Map<const Eigen::Vector3f>(vertices.xyz(vertex)).cast<double>();
}

/** Leaves out triangles that name a vertex twice, gives every fan of triangles a vertex
 * of its own, and finds the pieces.
 * \param sources one per vertex, and then one per copy
 * \throws InvalidArgument */
PieceList
findManifoldPieces(std::vector<Triangle>& triangles,
                   std::vector<std::uint32_t>& sources)
{
  const auto is_line = [](const Triangle& triangle) {
    return triangle[0] == triangle[1] || triangle[1] == triangle[2] ||
           triangle[2] == triangle[0];
  };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_line),
                  triangles.end());
  splitPinchedVertices(triangles, sources.size(), sources);
  const ManifoldDefects defects = HalfEdges(triangles, sources.size()).getDefects();
  if (defects.edges > 0 || defects.vertices > 0)
    throw InvalidArgument("contrary_triangles", {{"edges", defects.edges}});
  return findPieces(triangles, sources.size());
}

/** Means of the normals of the triangles. */
void
addTriangleNormals(const std::vector<Triangle>& triangles,
                   std::vector<SurfaceCorner>& corners)
{
  Mesh mesh;
  for (const SurfaceCorner& corner : corners) {
    const Eigen::Vector3f place = corner.place.cast<float>();
    mesh.vertices.push_back({place[0], place[1], place[2]});
  }
  mesh.triangles = triangles;
  const auto normals = computeVertexNormals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i)
    corners[i].normal = Eigen::Vector3d(normals[i][0], normals[i][1], normals[i][2]);
}

/** Whether a triangle looks against the normals of its corners: for one of a cap only
 * those of the corners on the cap count. */
bool
isAgainstNormals(const std::array<SurfaceCorner, 3>& corners)
{
  const auto& [a, b, c] = corners;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const SurfaceCorner& corner : corners)
    if (corner.is_on_cap == isOnCap(corners))
      normal += corner.normal;
  return (b.place - a.place).cross(c.place - a.place).dot(normal) < 0.0;
}

/** Tells of triangles which close the box, and where these meet the surface. */
class CapEdges {
public:
  explicit CapEdges(MeasuredSurface& surface)
      : surface_(surface)
      , edges_(surface.triangles, surface.corners.size())
  {
  }

  std::array<SurfaceCorner, 3>
  cornersOf(std::size_t triangle) const
  {
    const auto& [a, b, c] = surface_.triangles[triangle];
    return {surface_.corners[a], surface_.corners[b], surface_.corners[c]};
  }

  /** For each edge, by the corner opposite of it, of the cap that meets the surface
   * there, or the side of a box that it ends at. */
  EdgePlanes
  findPlanes(std::size_t triangle) const
  {
    EdgePlanes planes = freeEdges();
    for (std::size_t i = 0; i < 3; ++i) {
      const HalfEdge twin = twinOf(triangle, i);
      if (twin == HalfEdges::none) {
        planes[i] = planeOfRim(triangle, i);
        continue;
      }
      if (isOnCap(cornersOf(triangle)) == isOnCap(cornersOf(twin / 3)))
        continue;
      const auto [a, b, c] =
          cornersOf(isOnCap(cornersOf(triangle)) ? triangle : twin / 3);
      planes[i] = (b.place - a.place).cross(c.place - a.place).stableNormalized();
    }
    return planes;
  }

  bool
  isAtRim(std::size_t triangle, std::size_t corner) const
  {
    return twinOf(triangle, corner) == HalfEdges::none;
  }

private:
  /** A surface that is cut along a side of a box has one coordinate there. */
  Eigen::Vector3d
  planeOfRim(std::size_t triangle, std::size_t corner) const
  {
    const auto corners = cornersOf(triangle);
    const Eigen::Vector3d &a = corners[(corner + 1) % 3].place,
                          &b = corners[(corner + 2) % 3].place;
    for (int axis = 0; axis < 3; ++axis)
      if (a[axis] == b[axis])
        return Eigen::Vector3d::Unit(axis);
    return Eigen::Vector3d::Zero();
  }

  /** The twin of the edge opposite of a corner. */
  HalfEdge
  twinOf(std::size_t triangle, std::size_t corner) const
  {
    return edges_.twinOf(static_cast<HalfEdge>(3 * triangle + (corner + 1) % 3));
  }

  const MeasuredSurface& surface_;
  HalfEdges edges_;
};

/** Joins the pieces whose vertices are images of one another, as in a welded mesh.
 * \param sources by vertex the one that `image_of` has a value for */
void
joinImages(const ScalarField& image_of,
           const CloudView& vertices,
           const std::vector<std::uint32_t>& sources,
           const std::vector<Triangle>& triangles,
           PieceList& list)
{
  std::vector<Triangle> joined = triangles;
  for (Triangle& triangle : joined)
    for (std::uint32_t& vertex : triangle) {
      const double image = image_of.read(vertices.point(sources[vertex]));
      const auto other = image >= 0.0 && image < static_cast<double>(vertices.count)
                             ? static_cast<std::uint32_t>(image)
                             : sources[vertex];
      // Copies of a vertex stay apart unless they are images.
      vertex = other == sources[vertex] ? vertex : other;
    }
  const std::size_t count = sources.size();
  if (HalfEdges(joined, count).getDefects().edges > 0)
    return; // the box is so small that triangles share more than an edge
  std::vector<std::uint32_t> copies;
  const std::size_t all = count + splitPinchedVertices(joined, count, copies);
  list = findPieces(joined, all);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      list.of_vertex[triangles[t][i]] = list.of_vertex[joined[t][i]];
  list.of_vertex.resize(count);
}

/** Counts the rims of pieces that do not run in the faces of the box. */
void
countOpenRims(const std::vector<bool>& is_in_face, MeasuredSurface& surface)
{
  const HalfEdges edges(surface.triangles, surface.corners.size());
  for (SurfacePiece& piece : surface.list.pieces)
    piece.rims = 0;
  std::vector<bool> is_met(is_in_face.size());
  for (HalfEdge start = 0; start < is_met.size(); ++start) {
    if (is_met[start] || edges.twinOf(start) != HalfEdges::none)
      continue;
    bool is_open = false;
    for (HalfEdge edge = start; !is_met[edge];
         edge = edges.firstOf(edges.targetOf(edge))) {
      is_met[edge] = true;
      is_open = is_open || !is_in_face[edge];
    }
    if (is_open)
      ++surface.list
            .pieces[static_cast<std::size_t>(
                surface.list.of_vertex[edges.originOf(start)])]
            .rims;
  }
}

/** Gives the pieces that were cut at the faces of a box the volume within the box.
 * \param is_in_face by half edge */
void
closeThroughBox(const std::vector<bool>& is_in_face, MeasuredSurface& surface)
{
  countOpenRims(is_in_face, surface);
  for (std::size_t i = 0; i < surface.integrals.size(); ++i) {
    SurfaceIntegrals& all = surface.integrals[i];
    if (!surface.closure->isCut(i))
      continue;
    const double center = surface.bounds[i].center()[2];
    all.volume =
        surface.closure->findVolume(i, all.below + center * all.flux, all.flux);
    all.is_solid = false;
  }
}

void
integrate(MeasuredSurface& surface, bool curved, const PeriodicBox& box)
{
  surface.integrals.resize(surface.list.pieces.size());
  surface.cap_areas.assign(surface.list.pieces.size(), 0.0);
  surface.shares.assign(surface.corners.size(), 0.0);
  surface.rim_lengths.assign(surface.corners.size(), 0.0);
  std::vector<double> against(surface.list.pieces.size()); // areas
  std::vector<bool> is_in_face(3 * surface.triangles.size());
  std::vector<Eigen::Vector3d> places;
  if (isPeriodic(box.sides)) {
    surface.closure.emplace(box, surface.list.pieces.size());
    for (const SurfaceCorner& corner : surface.corners)
      places.push_back(corner.place);
  }
  const CapEdges caps(surface);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    const auto piece = static_cast<std::size_t>(surface.list.of_vertex[triangle[0]]);
    const std::array<SurfaceCorner, 3> corners = caps.cornersOf(t);
    const EdgePlanes planes = caps.findPlanes(t);
    const CurvedTriangle bent(corners, surface.bounds[piece].center(), planes);
    std::array<double, 3> own;
    const SurfaceIntegrals added =
        curved ? bent.integrate(own) : bent.integrateFlat(own);
    surface.integrals[piece].add(added);
    if (isOnCap(corners))
      surface.cap_areas[piece] += added.area;
    if (isAgainstNormals(corners))
      against[piece] += added.area;
    for (std::size_t i = 0; i < 3; ++i) {
      surface.shares[triangle[i]] += own[i];
      if (planes[i].isZero(0.0) && !caps.isAtRim(t, i))
        continue;
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      if (surface.closure && caps.isAtRim(t, i) &&
          surface.closure->addRim(piece,
                                  places,
                                  triangle[a],
                                  triangle[b],
                                  curved ? bent.getBulge(i)
                                         : Eigen::Vector3d::Zero())) {
        is_in_face[3 * t + a] = true;
        continue;
      }
      const double length = (corners[b].place - corners[a].place).norm();
      surface.rim_lengths[triangle[a]] += 0.5 * length;
      surface.rim_lengths[triangle[b]] += 0.5 * length;
    }
  }
  // Where some triangles are folded over others, the surface is counted three times.
  for (std::size_t i = 0; i < against.size(); ++i) {
    SurfaceIntegrals& all = surface.integrals[i];
    all.area_error += 2.0 * std::min(against[i], all.area - against[i]);
  }
  if (surface.closure)
    closeThroughBox(is_in_face, surface);
}

} // namespace

void
checkTriangles(const CloudView& vertices, const std::vector<Triangle>& triangles)
{
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t vertex : triangle) {
      if (vertex >= vertices.count)
        throw InvalidArgument("triangle_beyond_vertices",
                              {{"vertex", vertex}, {"vertices", vertices.count}});
      const float* const place = vertices.xyz(vertex);
      if (!std::isfinite(place[0]) || !std::isfinite(place[1]) ||
          !std::isfinite(place[2]))
        throw InvalidArgument("vertex_not_finite", {{"vertex", vertex}});
    }
}

std::optional<ScalarField>
findScalar(const CloudView& vertices, const char* name)
{
  const auto* const field = findField(vertices.fields, name);
  if (field == nullptr || field->count != 1)
    return std::nullopt;
  return ScalarField(vertices.fields, name);
}

std::vector<NamedScalar>
listMeasuredFields(const std::vector<pcl::PCLPointField>& fields)
{
  static const std::array<std::string, 9> others = {"isovalue",
                                                    "edge_length",
                                                    "support",
                                                    "method",
                                                    "orientation",
                                                    "piece",
                                                    "cap",
                                                    "area",
                                                    "image_of"};
  std::vector<NamedScalar> scalars = listNamedScalars(fields);
  scalars.erase(std::remove_if(scalars.begin(),
                               scalars.end(),
                               [](const NamedScalar& scalar) {
                                 return std::find(others.begin(),
                                                  others.end(),
                                                  scalar.name) != others.end();
                               }),
                scalars.end());
  return scalars;
}

std::optional<std::vector<SurfaceCorner>>
readCorners(const CloudView& vertices)
{
  const std::array<std::optional<ScalarField>, 3> parts = {
      findScalar(vertices, "normal_x"),
      findScalar(vertices, "normal_y"),
      findScalar(vertices, "normal_z")};
  if (!parts[0] || !parts[1] || !parts[2])
    return std::nullopt;
  std::vector<SurfaceCorner> corners;
  for (std::size_t i = 0; i < vertices.count; ++i) {
    const std::uint8_t* const point = vertices.point(i);
    const Eigen::Vector3d normal(
        parts[0]->read(point), parts[1]->read(point), parts[2]->read(point));
    corners.push_back(
        {placeOf(vertices, i),
         normal.allFinite() ? normal.stableNormalized() : Eigen::Vector3d::Zero()});
  }
  return corners;
}

void
findBounds(MeasuredSurface& surface)
{
  surface.bounds.resize(surface.list.pieces.size());
  for (std::size_t i = 0; i < surface.corners.size(); ++i)
    if (const std::int32_t piece = surface.list.of_vertex[i]; piece >= 0)
      surface.bounds[static_cast<std::size_t>(piece)].extend(surface.corners[i].place);
}

MeasuredSurface
measureMesh(const CloudView& vertices,
            const std::vector<Triangle>& triangles,
            const PeriodicBox& box,
            bool curved)
{
  checkTriangles(vertices, triangles);
  MeasuredSurface surface;
  surface.triangles = triangles;
  surface.sources.resize(vertices.count);
  std::iota(surface.sources.begin(), surface.sources.end(), 0u);
  surface.list = findManifoldPieces(surface.triangles, surface.sources);
  const std::optional<ScalarField> image_of = findScalar(vertices, "image_of");
  if (isPeriodic(box.sides) && image_of)
    joinImages(*image_of, vertices, surface.sources, surface.triangles, surface.list);
  std::optional<std::vector<SurfaceCorner>> corners = readCorners(vertices);
  const bool has_normals = corners.has_value();
  if (!has_normals) {
    corners.emplace(vertices.count);
    for (std::size_t i = 0; i < vertices.count; ++i)
      (*corners)[i].place = placeOf(vertices, i);
    addTriangleNormals(triangles, *corners);
  }
  const std::optional<ScalarField> cap = findScalar(vertices, "cap");
  for (const std::uint32_t source : surface.sources) {
    surface.corners.push_back((*corners)[source]);
    surface.corners.back().is_on_cap = cap && cap->read(vertices.point(source)) != 0.0;
  }
  findBounds(surface);
  integrate(surface, curved && has_normals, box);
  return surface;
}

} // namespace pcl_uvol::detail
