// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/measured_mesh.h"

#include "common/scalar_names.h"
#include "mesh/half_edges.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

namespace pcl_uvol::detail {

namespace {

/** Leaves out triangles that name a vertex twice, gives every fan of triangles a vertex
 * of its own, and finds the pieces. \param sources one per vertex, and then one per
 * copy \throws InvalidArgument */
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
    throw InvalidArgument(
        "At " + std::to_string(defects.edges) +
        " edges triangles of the surface disagree about which side is outside: it has "
        "no volume as it is, repair the mesh.");
  return findPieces(triangles, sources.size());
}

/** Unit normals of the vertices: their own; without, means of the triangles'. */
std::vector<Eigen::Vector3d>
readNormals(const CloudView& vertices,
            const std::vector<Triangle>& triangles,
            bool& has_normals)
{
  std::vector<Eigen::Vector3d> normals;
  std::array<std::optional<ScalarField>, 3> parts = {findScalar(vertices, "normal_x"),
                                                     findScalar(vertices, "normal_y"),
                                                     findScalar(vertices, "normal_z")};
  has_normals = parts[0] && parts[1] && parts[2];
  if (has_normals) {
    for (std::size_t i = 0; i < vertices.count; ++i) {
      const std::uint8_t* const point = vertices.point(i);
      const Eigen::Vector3d normal(
          parts[0]->read(point), parts[1]->read(point), parts[2]->read(point));
      normals.push_back(normal.allFinite() ? normal.stableNormalized()
                                           : Eigen::Vector3d::Zero());
    }
    return normals;
  }
  Mesh mesh;
  for (std::size_t i = 0; i < vertices.count; ++i)
    mesh.vertices.push_back(
        {vertices.xyz(i)[0], vertices.xyz(i)[1], vertices.xyz(i)[2]});
  mesh.triangles = triangles;
  for (const auto& normal : computeVertexNormals(mesh))
    normals.emplace_back(normal[0], normal[1], normal[2]);
  return normals;
}

} // namespace

void
checkTriangles(const CloudView& vertices, const std::vector<Triangle>& triangles)
{
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t vertex : triangle) {
      if (vertex >= vertices.count)
        throw InvalidArgument("A triangle names vertex " + std::to_string(vertex) +
                              ", but there are " + std::to_string(vertices.count) +
                              ".");
      const float* const place = vertices.xyz(vertex);
      if (!std::isfinite(place[0]) || !std::isfinite(place[1]) ||
          !std::isfinite(place[2]))
        throw InvalidArgument("Vertex " + std::to_string(vertex) +
                              " of the surface is not finite.");
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

std::vector<std::string>
listMeasuredFields(const std::vector<pcl::PCLPointField>& fields)
{
  static const std::array<std::string, 8> others = {"isovalue",
                                                    "edge_length",
                                                    "support",
                                                    "method",
                                                    "orientation",
                                                    "piece",
                                                    "cap",
                                                    "area"};
  std::vector<std::string> names = listScalars(fields);
  names.erase(std::remove_if(names.begin(),
                             names.end(),
                             [](const std::string& name) {
                               return std::find(others.begin(), others.end(), name) !=
                                      others.end();
                             }),
              names.end());
  return names;
}

MeasuredMesh::MeasuredMesh(const CloudView& vertices,
                           const std::vector<Triangle>& triangles)
    : triangles_(triangles)
    , sources_(vertices.count)
{
  if (triangles.empty())
    throw InvalidArgument(
        "The surface has no triangles: areas and volumes are those of a mesh.");
  checkTriangles(vertices, triangles);
  std::iota(sources_.begin(), sources_.end(), 0u);
  list_ = findManifoldPieces(triangles_, sources_);
  const std::vector<Eigen::Vector3d> normals =
      readNormals(vertices, triangles, has_normals_);
  const std::optional<ScalarField> cap = findScalar(vertices, "cap");
  for (const std::uint32_t source : sources_) {
    const float* const place = vertices.xyz(source);
    corners_.push_back({Eigen::Vector3d(place[0], place[1], place[2]),
                        normals[source],
                        cap && cap->read(vertices.point(source)) != 0.0});
  }
  bounds_.resize(list_.pieces.size());
  for (std::size_t i = 0; i < corners_.size(); ++i)
    if (list_.of_vertex[i] >= 0)
      bounds_[static_cast<std::size_t>(list_.of_vertex[i])].extend(corners_[i].place);
}

std::vector<SurfaceIntegrals>
MeasuredMesh::integrate(bool curved, std::vector<double>& shares) const
{
  std::vector<SurfaceIntegrals> integrals(list_.pieces.size());
  shares.assign(corners_.size(), 0.0);
  for (const Triangle& triangle : triangles_) {
    const auto piece = static_cast<std::size_t>(list_.of_vertex[triangle[0]]);
    const CurvedTriangle bent(
        {corners_[triangle[0]], corners_[triangle[1]], corners_[triangle[2]]},
        bounds_[piece].center());
    std::array<double, 3> own;
    integrals[piece].add(curved ? bent.integrate(own) : bent.integrateFlat(own));
    for (std::size_t i = 0; i < 3; ++i)
      shares[triangle[i]] += own[i];
  }
  return integrals;
}

} // namespace pcl_uvol::detail
