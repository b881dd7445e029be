// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/periodic_mesh.h"

#include "common/records.h"
#include "common/scalar_field.h"
#include "mesh/half_edges.h"
#include "mesh/plane_cut.h"
#include "mesh/rim_welding.h"
#include "mesh/surface_pieces.h"
#include "mesh/working_mesh.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {
namespace {

/** Parts of the distance of the samples that a vertex lies between: so near to a face
 * it glides into it along the surface, as slivers would be cut there; where the surface
 * hardly slopes towards the face, it is moved a little. */
constexpr double gliding = 0.1, near_face = 0.01;

/** Least squared sine of the angle between surface and face that vertices glide on. */
constexpr double least_slope = 0.25;

float
readFloat(const pcl::PCLPointCloud2& cloud, std::size_t point, std::size_t offset)
{
  float number;
  std::memcpy(&number, &cloud.data[point * cloud.point_step + offset], sizeof(number));
  return number;
}

Eigen::Vector3d
readVector(const pcl::PCLPointCloud2& cloud, std::size_t point, std::size_t offset)
{
  return {static_cast<double>(readFloat(cloud, point, offset)),
          static_cast<double>(readFloat(cloud, point, offset + sizeof(float))),
          static_cast<double>(readFloat(cloud, point, offset + 2 * sizeof(float)))};
}

void
putVector(const Eigen::Vector3d& vector, std::uint8_t* to)
{
  const Eigen::Vector3f rounded = vector.cast<float>();
  std::memcpy(to, rounded.data(), sizeof(rounded));
}

/** Bits of the faces that a place lies in, two per axis, of those that a mesh has been
 * cut at. */
unsigned
findFaces(const std::vector<OppositeFaces>& cut, const Eigen::Vector3d& place)
{
  unsigned bits = 0;
  for (const OppositeFaces& faces : cut) {
    const double coordinate = place[static_cast<int>(faces.axis)];
    bits |= (coordinate == faces.low    ? 1u
             : coordinate == faces.high ? 2u
                                        : 0u)
            << 2 * faces.axis;
  }
  return bits;
}

/** How a vertex moves per unit of its height towards a face, in the surface and in the
 * faces that it lies in already; zero where there is no such way, or a long one. */
Eigen::Vector3d
findWay(Eigen::Vector3d normal, unsigned faces, std::size_t axis)
{
  for (std::size_t other = 0; other < 3; ++other)
    if ((faces >> 2 * other & 3u) != 0)
      normal[static_cast<int>(other)] = 0.0;
  normal.normalize();
  const Eigen::Vector3d face = Eigen::Vector3d::Unit(static_cast<int>(axis));
  const Eigen::Vector3d way = face - face.dot(normal) * normal;
  const double slope = way.squaredNorm();
  return slope > least_slope ? Eigen::Vector3d(way / slope) : Eigen::Vector3d::Zero();
}

/** Makes the vertices of a result those that lie between vertices that it has. */
void
replaceVertices(const IsoEdges& vertices,
                std::vector<Triangle> triangles,
                IsosurfaceResult& result)
{
  pcl::PCLPointCloud2 cloud;
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(vertices.size());
  interpolateFields(result.surface.cloud, vertices, cloud);
  const std::size_t normal = findField(cloud.fields, "normal_x")->offset;
  IsoEdges edges;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const IsoEdge& vertex = vertices[i];
    edges.push_back(result.edges[vertex.t <= 0.5f ? vertex.first : vertex.second]);
    if (vertex.first != vertex.second)
      putVector(readVector(cloud, i, normal).normalized(),
                &cloud.data[i * cloud.point_step + normal]);
  }
  result.surface.cloud = std::move(cloud);
  result.edges = std::move(edges);
  result.triangles = std::move(triangles);
}

bool
isWithin(const std::vector<OppositeFaces>& cut, const Eigen::Vector3d& place)
{
  return std::all_of(cut.begin(), cut.end(), [&](const OppositeFaces& faces) {
    const double coordinate = place[static_cast<int>(faces.axis)];
    return faces.low <= coordinate && coordinate <= faces.high;
  });
}

/** Only the nearer one of two vertices beside one another on a rim may move into
 * another face: a rim crosses an edge of the box in one vertex.
 *
 * \param faces by vertex, as findFaces() */
std::vector<bool>
findNearest(const std::vector<double>& heights,
            const std::vector<unsigned>& faces,
            const std::vector<Triangle>& triangles)
{
  std::vector<bool> is_nearest(heights.size(), true);
  const auto compare = [&](std::uint32_t a, std::uint32_t b) {
    if ((faces[a] & faces[b]) == 0)
      return;
    const bool is_first = std::make_pair(std::abs(heights[a]), heights[a] < 0.0) <=
                          std::make_pair(std::abs(heights[b]), heights[b] < 0.0);
    is_nearest[is_first ? b : a] = false;
  };
  for (const auto& [a, b, c] : triangles) {
    compare(a, b);
    compare(b, c);
    compare(c, a);
  }
  return is_nearest;
}

/** Where a vertex near to a face comes to lie in it; none if it stays where it is. */
std::optional<Eigen::Vector3d>
findPlaceInFace(const std::vector<OppositeFaces>& cut,
                unsigned faces,
                std::size_t axis,
                double height,
                const pcl::PCLPointCloud2& cloud,
                std::size_t vertex)
{
  const auto length = static_cast<double>(
      readFloat(cloud, vertex, findField(cloud.fields, "edge_length")->offset));
  if (!(std::abs(height) < gliding * length))
    return std::nullopt;
  const Eigen::Vector3d place = readVector(cloud, vertex, 0);
  // Where the surface ends in a cap, it must not leave that.
  const bool is_rim = ScalarField(cloud.fields, "support")
                          .read(&cloud.data[vertex * cloud.point_step]) ==
                      static_cast<double>(IsoSupport::Rim);
  const Eigen::Vector3d way =
      is_rim ? Eigen::Vector3d::Zero()
             : findWay(readVector(
                           cloud, vertex, findField(cloud.fields, "normal_x")->offset),
                       faces,
                       axis);
  const Eigen::Vector3d moved = place - height * way;
  if (way.isZero() ? !(std::abs(height) < near_face * length) : !isWithin(cut, moved))
    return std::nullopt;
  return moved;
}

/** Heights of vertices above a face; those near to it are moved into it.
 *
 * \param sign 1: above the coordinate */
std::vector<double>
findHeights(const std::vector<OppositeFaces>& cut,
            std::size_t axis,
            double coordinate,
            double sign,
            IsosurfaceResult& result)
{
  pcl::PCLPointCloud2& cloud = result.surface.cloud;
  std::vector<double> heights;
  std::vector<unsigned> faces;
  for (std::size_t i = 0; i < cloud.width; ++i) {
    const Eigen::Vector3d place = readVector(cloud, i, 0);
    heights.push_back(sign * (place[static_cast<int>(axis)] - coordinate));
    faces.push_back(findFaces(cut, place));
  }
  const std::vector<bool> is_nearest = findNearest(heights, faces, result.triangles);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (!is_nearest[i])
      continue;
    const auto place =
        findPlaceInFace(cut, faces[i], axis, sign * heights[i], cloud, i);
    if (!place)
      continue;
    heights[i] = 0.0;
    std::uint8_t* const point = &cloud.data[i * cloud.point_step];
    putVector(*place, point);
    for (const OppositeFaces& other : cut) {
      const unsigned bits = faces[i] >> 2 * other.axis & 3u;
      if (bits != 0)
        putCoordinate(bits == 1 ? other.low : other.high, other.axis, point);
    }
    putCoordinate(coordinate, axis, point);
  }
  return heights;
}

/** Keep what lies on one side of a face.
 * \param sign 1: above the coordinate */
void
cutAtFace(const std::vector<OppositeFaces>& cut,
          std::size_t axis,
          double coordinate,
          double sign,
          IsosurfaceResult& result)
{
  const std::vector<double> heights = findHeights(cut, axis, coordinate, sign, result);
  PlaneCut kept = cutByPlane(heights, result.triangles);
  replaceVertices(kept.vertices, std::move(kept.triangles), result);
  pcl::PCLPointCloud2& cloud = result.surface.cloud;
  for (std::size_t i = 0; i < cloud.width; ++i)
    if (kept.vertices[i].first != kept.vertices[i].second)
      putCoordinate(coordinate, axis, &cloud.data[i * cloud.point_step]);
}

/** Copies of vertices where what is left of a mesh touches itself in a point. */
void
splitVertices(IsosurfaceResult& result)
{
  IsoEdges vertices;
  for (std::uint32_t i = 0; i < result.surface.cloud.width; ++i)
    vertices.push_back({i, i, 0.0f});
  std::vector<std::uint32_t> sources;
  if (splitPinchedVertices(result.triangles, result.surface.cloud.width, sources) == 0)
    return;
  for (const std::uint32_t source : sources)
    vertices.push_back({source, source, 0.0f});
  replaceVertices(vertices, std::move(result.triangles), result);
}

/** Gives the rims in two faces the same vertices.
 *
 * \param cut faces that were treated before */
void
matchFaces(const std::vector<OppositeFaces>& cut,
           const OppositeFaces& faces,
           IsosurfaceResult& result)
{
  splitVertices(result);
  const pcl::PCLPointCloud2& before = result.surface.cloud;
  const std::size_t length = findField(before.fields, "edge_length")->offset;
  const ScalarField isovalue(before.fields, "isovalue");
  std::vector<RimVertex> vertices;
  for (std::size_t i = 0; i < before.width; ++i) {
    const Eigen::Vector3d place = readVector(before, i, 0);
    vertices.push_back({place,
                        static_cast<double>(readFloat(before, i, length)),
                        isovalue.read(&before.data[i * before.point_step]),
                        findFaces(cut, place)});
  }
  MatchedRims matched = matchRims(vertices, faces, std::move(result.triangles));
  replaceVertices(matched.vertices, std::move(matched.triangles), result);
  pcl::PCLPointCloud2& cloud = result.surface.cloud;
  for (std::size_t i = vertices.size(); i < cloud.width; ++i)
    putCoordinate(faces.low, faces.axis, &cloud.data[i * cloud.point_step]);
  for (const auto& [vertex, image] : matched.images)
    putCoordinate(faces.high, faces.axis, &cloud.data[image * cloud.point_step]);
}

/** The vertices in low faces that those in high ones are images of; of others they
 * themselves. */
std::vector<std::int32_t>
findImages(const std::vector<OppositeFaces>& cut, const pcl::PCLPointCloud2& cloud)
{
  using Key =
      std::array<double, 4>; // where it is in the low faces, and of which isovalue
  const ScalarField isovalue(cloud.fields, "isovalue");
  std::map<Key, std::vector<std::int32_t>> classes;
  std::vector<std::int32_t> image_of(cloud.width);
  std::iota(image_of.begin(), image_of.end(), 0);
  for (std::size_t i = 0; i < cloud.width; ++i) {
    Eigen::Vector3d place = readVector(cloud, i, 0);
    if (findFaces(cut, place) == 0)
      continue;
    for (const OppositeFaces& faces : cut)
      if (double& x = place[static_cast<int>(faces.axis)]; x == faces.high)
        x = faces.low;
    classes[{place[0],
             place[1],
             place[2],
             isovalue.read(&cloud.data[i * cloud.point_step])}]
        .push_back(static_cast<std::int32_t>(i));
  }
  for (auto& [key, members] : classes) {
    std::map<unsigned, std::int32_t> by_faces;
    for (const std::int32_t member : members)
      by_faces.emplace(
          findFaces(cut, readVector(cloud, static_cast<std::size_t>(member), 0)),
          member);
    // Where the surface touches itself, images could not be told apart.
    if (by_faces.size() == members.size())
      for (const std::int32_t member : members)
        image_of[static_cast<std::size_t>(member)] = by_faces.begin()->second;
  }
  return image_of;
}

/** A mesh whose images are one vertex. */
struct JoinedMesh {
  std::vector<Triangle> triangles;
  std::size_t vertices;
};

/** \return none if triangles would share more than an edge: the box is too small for
 * them
 */
std::optional<JoinedMesh>
joinImages(const std::vector<std::int32_t>& image_of,
           const std::vector<Triangle>& triangles)
{
  JoinedMesh joined{triangles, image_of.size()};
  for (Triangle& triangle : joined.triangles)
    for (std::uint32_t& vertex : triangle)
      vertex = static_cast<std::uint32_t>(image_of[vertex]);
  if (HalfEdges(joined.triangles, joined.vertices).getDefects().edges > 0)
    return std::nullopt;
  std::vector<std::uint32_t> sources; // where a rim is left, it may touch itself
  joined.vertices += splitPinchedVertices(joined.triangles, joined.vertices, sources);
  return joined;
}

/** Edges of rims in the faces.
 *
 * \param joined the same triangles, with images joined or not */
std::size_t
countOpenEdges(const std::vector<OppositeFaces>& cut,
               const IsosurfaceResult& result,
               JoinedMesh joined)
{
  const HalfEdges edges(joined.triangles, joined.vertices);
  const auto findFacesOf = [&](HalfEdge edge) {
    return findFaces(
        cut, readVector(result.surface.cloud, result.triangles[edge / 3][edge % 3], 0));
  };
  std::size_t open = 0;
  for (HalfEdge edge = 0; edge < 3 * joined.triangles.size(); ++edge)
    open += edges.twinOf(edge) == HalfEdges::none &&
            (findFacesOf(edge) & findFacesOf(nextOf(edge))) != 0;
  return open;
}

/** Gives images all that their vertices have but the place: on edges of the box they
 * came from several faces. */
void
copyToImages(const std::vector<std::int32_t>& image_of, IsosurfaceResult& result)
{
  pcl::PCLPointCloud2& cloud = result.surface.cloud;
  for (std::size_t i = 0; i < image_of.size(); ++i) {
    const auto vertex = static_cast<std::size_t>(image_of[i]);
    const Eigen::Vector3d place = readVector(cloud, i, 0);
    std::copy_n(&cloud.data[vertex * cloud.point_step],
                cloud.point_step,
                &cloud.data[i * cloud.point_step]);
    putVector(place, &cloud.data[i * cloud.point_step]);
    result.edges[i] = result.edges[vertex];
  }
}

/** Adds the field image_of.
 * \return the mesh whose images are one vertex */
JoinedMesh
weldMesh(const std::vector<OppositeFaces>& cut, IsosurfaceResult& result)
{
  const std::vector<std::int32_t> image_of = findImages(cut, result.surface.cloud);
  copyToImages(image_of, result);
  const JoinedMesh apart{result.triangles, result.surface.cloud.width};
  JoinedMesh joined = joinImages(image_of, result.triangles).value_or(apart);
  const std::size_t left = countOpenEdges(cut, result, joined);
  if (left > 0)
    result.report.warn("edges_without_image",
                       {{"left", left}, {"edges", countOpenEdges(cut, result, apart)}});
  setField(result.surface, "image_of", image_of);
  return joined;
}

/** The pieces that are left, in the order that IsosurfaceResult has them in.
 *
 * \param joined the triangles of the result, with images joined or not
 *
 * \param isovalues of the result */
void
listPieces(const std::vector<double>& isovalues,
           JoinedMesh joined,
           IsosurfaceResult& result)
{
  const pcl::PCLPointCloud2& cloud = result.surface.cloud;
  const ScalarField old_piece(cloud.fields, "piece");
  PieceList list = findPieces(joined.triangles, joined.vertices);
  for (std::size_t i = 0; i < joined.triangles.size(); ++i)
    for (std::size_t corner = 0; corner < 3; ++corner) // of images as well
      list.of_vertex[result.triangles[i][corner]] =
          list.of_vertex[joined.triangles[i][corner]];
  for (std::size_t i = 0; i < cloud.width; ++i) {
    const auto old =
        static_cast<std::size_t>(old_piece.read(&cloud.data[i * cloud.point_step]));
    list.pieces[static_cast<std::size_t>(list.of_vertex[i])].isovalue =
        result.pieces[old].isovalue;
  }
  const auto place_of = [&](std::size_t piece) {
    return std::find(isovalues.begin(), isovalues.end(), list.pieces[piece].isovalue) -
           isovalues.begin();
  };
  std::vector<std::size_t> order(list.pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return place_of(a) < place_of(b);
  });
  std::vector<std::int32_t> number(order.size()), piece_of(cloud.width);
  std::vector<SurfacePiece> pieces;
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[order[i]] = static_cast<std::int32_t>(i);
    pieces.push_back(list.pieces[order[i]]);
  }
  for (std::size_t i = 0; i < piece_of.size(); ++i)
    piece_of[i] = number[static_cast<std::size_t>(list.of_vertex[i])];
  result.pieces = std::move(pieces);
  setField(result.surface, "piece", piece_of);
}

double
findSmallestAngle(const IsosurfaceResult& result)
{
  const CloudView cloud = viewOf(result.surface.cloud);
  double smallest = 180.0;
  for (const Triangle& triangle : result.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] =
          Eigen::Map<const Eigen::Vector3f>(cloud.xyz(triangle[i])).cast<double>();
    smallest = std::min(smallest, smallestAngle(corners));
  }
  return smallest;
}

} // namespace

void
cutAtFaces(const PeriodicBox& box, PeriodicMesh periodic_mesh, IsosurfaceResult& result)
{
  std::vector<double> isovalues;
  for (const SurfacePiece& piece : result.pieces)
    isovalues.push_back(piece.isovalue);
  std::vector<OppositeFaces> cut;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.sides[axis] > 0.0))
      continue;
    const OppositeFaces faces{
        axis, 0.0, static_cast<double>(static_cast<float>(box.sides[axis]))};
    cutAtFace(cut, axis, faces.low, 1.0, result);
    cutAtFace(cut, axis, faces.high, -1.0, result);
    if (periodic_mesh == PeriodicMesh::Weld)
      matchFaces(cut, faces, result);
    cut.push_back(faces);
  }
  splitVertices(result);
  listPieces(isovalues,
             periodic_mesh == PeriodicMesh::Weld
                 ? weldMesh(cut, result)
                 : JoinedMesh{result.triangles, result.surface.cloud.width},
             result);
  result.smallest_angle = findSmallestAngle(result);
  result.report.setCount("vertices", result.surface.cloud.width);
  result.report.setCount("isopoints", result.surface.cloud.width);
  result.report.setCount("triangles", result.triangles.size());
  result.report.setCount("pieces", result.pieces.size());
}

} // namespace pcl_uvol::detail
