// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/periodic_surface.h"

#include "common/records.h"
#include "common/scalar_field.h"
#include "mesh/plane_cut.h"
#include "mesh/surface_pieces.h"
#include "mesh/working_mesh.h"
#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace pcl_uvol {
namespace {

/** Spacings that images reach beyond the faces at least: fits take 2.5; a mesh ends in
 * caps there, and a level set knows less of the field where it ends. */
constexpr double reach_of_fits = 3.0, reach_of_meshes = 5.0, reach_of_level_sets = 8.0;

/** Part of the distance of the samples that a vertex lies between: so near to a face it
 * moves into it, as slivers would be cut there. */
constexpr float near_face = 0.01f;

float
readFloat(const pcl::PCLPointCloud2& cloud, std::size_t point, std::size_t offset)
{
  float number;
  std::memcpy(&number, &cloud.data[point * cloud.point_step + offset], sizeof(number));
  return number;
}

/** Puts cut vertices exactly into the plane, with normals of length 1. */
void
straighten(Dataset& surface,
           const IsoEdges& vertices,
           std::size_t axis,
           double coordinate)
{
  pcl::PCLPointCloud2& cloud = surface.cloud;
  const std::size_t normal = findField(cloud.fields, "normal_x")->offset;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].first == vertices[i].second)
      continue;
    std::uint8_t* const point = &cloud.data[i * cloud.point_step];
    putCoordinate(coordinate, axis, point);
    Eigen::Vector3f direction;
    std::memcpy(direction.data(), point + normal, sizeof(direction));
    direction.normalize();
    std::memcpy(point + normal, direction.data(), sizeof(direction));
  }
}

/** Keep what lies on one side of a face. \param sign 1: above the coordinate */
void
cutAtFace(std::size_t axis, double coordinate, double sign, IsosurfaceResult& result)
{
  pcl::PCLPointCloud2& cloud = result.surface.cloud;
  std::vector<double> heights(cloud.width);
  const std::size_t length = findField(cloud.fields, "edge_length")->offset;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const auto place = static_cast<double>(readFloat(cloud, i, axis * sizeof(float)));
    heights[i] = sign * (place - coordinate);
    if (std::abs(heights[i]) <
        static_cast<double>(near_face * readFloat(cloud, i, length))) {
      heights[i] = 0.0;
      putCoordinate(coordinate, axis, &cloud.data[i * cloud.point_step]);
    }
  }
  detail::PlaneCut cut = detail::cutByPlane(heights, result.triangles);
  pcl::PCLPointCloud2 vertices;
  vertices.height = 1;
  vertices.width = static_cast<pcl::uindex_t>(cut.vertices.size());
  interpolateFields(cloud, cut.vertices, vertices);
  cloud = std::move(vertices);
  straighten(result.surface, cut.vertices, axis, coordinate);
  IsoEdges edges;
  for (const IsoEdge& vertex : cut.vertices)
    edges.push_back(result.edges[vertex.t <= 0.5f ? vertex.first : vertex.second]);
  result.edges = std::move(edges);
  result.triangles = std::move(cut.triangles);
}

/** Copies of vertices where what is left of a mesh touches itself in a point. */
void
splitVertices(IsosurfaceResult& result)
{
  std::vector<std::uint32_t> source_of(result.surface.cloud.width);
  std::iota(source_of.begin(), source_of.end(), 0u);
  if (detail::splitPinchedVertices(
          result.triangles, result.surface.cloud.width, source_of) == 0)
    return;
  pcl::PCLPointCloud2 vertices;
  vertices.height = 1;
  vertices.width = static_cast<pcl::uindex_t>(source_of.size());
  copyFields(result.surface.cloud, source_of, vertices);
  result.surface.cloud = std::move(vertices);
  IsoEdges edges;
  for (const std::uint32_t source : source_of)
    edges.push_back(result.edges[source]);
  result.edges = std::move(edges);
}

/** The pieces that are left, in the order that IsosurfaceResult has them in. */
void
listPieces(const std::vector<double>& isovalues, IsosurfaceResult& result)
{
  const pcl::PCLPointCloud2& cloud = result.surface.cloud;
  const ScalarField old_piece(cloud.fields, "piece");
  detail::PieceList list = detail::findPieces(result.triangles, cloud.width);
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
    smallest = std::min(smallest, detail::smallestAngle(corners));
  }
  return smallest;
}

void
cutMesh(const PeriodicBox& box, IsosurfaceResult& result)
{
  std::vector<double> isovalues;
  for (const SurfacePiece& piece : result.pieces)
    isovalues.push_back(piece.isovalue);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.sides[axis] > 0.0) {
      cutAtFace(axis, 0.0, 1.0, result);
      cutAtFace(axis, box.sides[axis], -1.0, result);
    }
  splitVertices(result);
  listPieces(isovalues, result);
  result.smallest_angle = findSmallestAngle(result);
  result.report.setCount("vertices", result.surface.cloud.width);
  result.report.setCount("isopoints", result.surface.cloud.width);
  result.report.setCount("triangles", result.triangles.size());
  result.report.setCount("pieces", result.pieces.size());
}

/** From places counted from the corner of one box to coordinates within another. */
void
movePoints(const PeriodicSamples& images, const PeriodicBox& box, Dataset& surface)
{
  pcl::PCLPointCloud2& cloud = surface.cloud;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A mesh comes from the box itself, whose high face is not the low one.
    const bool is_same = images.box.low[axis] == box.low[axis];
    for (std::size_t i = 0; i < cloud.width; ++i) {
      const auto place = static_cast<double>(readFloat(cloud, i, axis * sizeof(float)));
      const double at = images.box.low[axis] + place;
      putCoordinate(is_same ? at : box.low[axis] + box.toBox(at, axis),
                    axis,
                    &cloud.data[i * cloud.point_step]);
    }
  }
}

/** Counts points in the box only. */
void
countSupport(IsosurfaceResult& result)
{
  const pcl::PCLPointCloud2& cloud = result.surface.cloud;
  const ScalarField field(cloud.fields, "support");
  std::array<std::uint64_t, 4> counts{};
  for (std::size_t i = 0; i < cloud.width; ++i)
    ++counts.at(
        static_cast<std::size_t>(field.read(&cloud.data[i * cloud.point_step])));
  for (const auto& [name, support] :
       {std::pair("bridged", IsoSupport::Bridged), std::pair("rim", IsoSupport::Rim)})
    if (result.report.getCount(name) > 0)
      result.report.setCount(name, counts.at(static_cast<std::size_t>(support)));
}

/** Samples with the images that the stages need.
 *
 * Isopoints come from a box whose faces lie in the widest gaps between the coordinates,
 * so that they do not depend on where the samples' box was put; meshes, which are cut
 * at its faces, from that box.
 *
 * \param use null: all samples
 *
 * \param parameters with the field and the scale that are taken */
PeriodicSamples
makeImages(const Dataset& samples,
           const pcl::IndicesPtr& use,
           const PeriodicBox& box,
           const IsosurfacePipelineParameters& parameters,
           unsigned threads,
           Report& report)
{
  const CloudView cloud = viewOf(samples.cloud);
  const ScalarField field(cloud.fields, parameters.isosurface.field);
  std::vector<std::uint32_t> with_value;
  const auto add = [&](std::size_t point) {
    if (std::isfinite(field.read(cloud.point(point))))
      with_value.push_back(static_cast<std::uint32_t>(point));
  };
  for (std::size_t i = 0; i < (use ? use->size() : cloud.count); ++i)
    add(use ? static_cast<std::size_t>((*use)[i]) : i);
  PeriodicReach reach;
  reach.scale = toPosition(parameters.isosurface.scale);
  reach.spacings = parameters.smooth ? reach_of_level_sets
                   : parameters.mesh ? reach_of_meshes
                                     : reach_of_fits;
  return addPeriodicImages(samples,
                           with_value,
                           parameters.mesh ? box
                                           : cutAtWidestGap(samples, box, threads),
                           reach,
                           threads,
                           report);
}

/** The samples to use among those with images. */
pcl::IndicesPtr
indicesWithImages(const PeriodicSamples& images, const pcl::IndicesPtr& use)
{
  if (!use)
    return nullptr;
  auto all = std::make_shared<pcl::Indices>(*use);
  for (std::size_t i = images.countOwn(); i < images.samples.cloud.width; ++i)
    all->push_back(static_cast<pcl::index_t>(i));
  return all;
}

/** Bring a surface back to the box of the samples: a mesh is cut at its faces, points
 * lie in it already; coordinates and edges become those of the samples. */
void
returnToBox(const Dataset& samples,
            const PeriodicSamples& images,
            const PeriodicBox& box,
            IsosurfaceResult& result)
{
  if (!result.triangles.empty())
    cutMesh(images.box, result);
  countSupport(result);
  movePoints(images, box, result.surface);
  result.surface.origin = samples.origin;
  for (IsoEdge& edge : result.edges) {
    edge.first = images.sourceOf(edge.first);
    edge.second = images.sourceOf(edge.second);
  }
}

} // namespace

IsosurfaceResult
IsosurfacePipeline::runInBox(IsosurfacePipelineParameters parameters)
{
  parameters.automatic_scale = false; // it is filled in
  const PeriodicBox box = findPeriodicBox(*samples_, sidesOf(parameters), report_);
  const auto images = std::make_shared<PeriodicSamples>(
      makeImages(*samples_, indices_, box, parameters, threads_, report_));
  // Images go beyond all faces: caps would close the surface where it is cut.
  if (parameters.mesh && (parameters.periodic > 0.0).all())
    parameters.mesh->open = true;
  IsosurfacePipeline inner;
  inner.setInput(std::shared_ptr<const Dataset>(images, &images->samples));
  inner.setIndices(indicesWithImages(*images, indices_));
  inner.setParameters(parameters);
  inner.setNumberOfThreads(threads_);
  inner.report_ = std::move(report_);
  IsosurfaceResult result = inner.runOnSamples(parameters);
  const std::size_t count = images->image_of.size();
  result.report.setCount("samples", result.report.getCount("samples") - count);
  result.report.setCount("images", count);
  returnToBox(*samples_, *images, box, result);
  for (std::size_t i = 0; parameters.mesh && i < result.isopoints.size(); ++i) {
    result.isopoints[i] = 0;
    for (const SurfacePiece& piece : result.pieces)
      if (piece.isovalue == parameters.isosurface.isovalues[i])
        result.isopoints[i] += piece.vertices;
  }
  report_ = result.report;
  return result;
}

} // namespace pcl_uvol
