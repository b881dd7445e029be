// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/number_range.h"
#include "common/parameter_json.h"
#include "common/scalar_field.h"
#include "isosurface/iso_edges.h"
#include "isosurface/isopoints.h"
#include "isosurface/piece_isopoints.h"
#include "isosurface/spike_test.h"
#include "mesh/band_surface.h"
#include "mesh/memory_need.h"
#include "mesh/mesh_vertices.h"
#include "mesh/remeshing.h"
#include "mesh/surface_pieces.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/mesh/surface_mesh.h>

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

std::string
SurfaceMeshParameters::toJson() const
{
  return writeJson(*this);
}

SurfaceMeshParameters
SurfaceMeshParameters::fromJson(const std::string& text)
{
  return readJson<SurfaceMeshParameters>(text);
}

void
checkParameters(const SurfaceMeshParameters& parameters)
{
  checkParameters(parameters.isosurface);
  const double length = parameters.meshing.edge_length;
  if (!(length >= 0.0) || !std::isfinite(length))
    throw InvalidArgument("edge_length_not_allowed", {{"length", length}});
  if (parameters.isosurface.interpolation == Interpolation::Linear)
    throw InvalidArgument("mesh_of_linear_interpolation", {});
  if (parameters.isosurface.neighbors != NeighborSource::KdTree)
    throw InvalidArgument("mesh_of_voronoi_neighbors", {});
}

void
SurfaceTriangles::append(const SurfaceTriangles& other)
{
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const auto first_piece = static_cast<std::int32_t>(pieces.size());
  const auto join = [](const auto& from, auto& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  join(other.vertices, vertices);
  join(other.edges, edges);
  for (const auto& [a, b, c] : other.triangles)
    triangles.push_back({a + first, b + first, c + first});
  for (const std::int32_t piece : other.piece_of)
    piece_of.push_back(piece + first_piece);
  join(other.is_on_cap, is_on_cap);
  join(other.pieces, pieces);
  smallest_angle = std::min(smallest_angle, other.smallest_angle);
  cap_part = std::max(cap_part, other.cap_part);
  folds += other.folds;
  slivers += other.slivers;
  tally.add(other.tally);
}

namespace detail {

namespace {

/** A cap that closes more of a surface than this may be on the wrong side of it. */
constexpr double large_cap = 0.1;

/** Share of the triangles: smooth fields have none that is folded or a sliver. */
constexpr double many_folds = 0.01;

/** Samples in a tree of compact cells, and their values. */
struct MeshSamples {
  SampleSet::ConstPtr samples;
  ValueFrame frame;
  SampleValues values;
  NodeRanges ranges;
};

MeshSamples
readSamples(const CloudView& cloud,
            const pcl::Indices& indices,
            const IsosurfaceParameters& parameters,
            unsigned threads,
            Report& report)
{
  const ScalarField field(cloud.fields, parameters.field);
  MeshSamples read;
  read.frame = findValueRange(cloud, field, threads).findFrame();
  const std::vector<float> values = readValues(cloud, field, read.frame, threads);
  const std::vector<std::uint32_t> use = pointsWithValue(values, indices, field);
  read.samples = SampleSet::build(cloud.xyz(0),
                                  cloud.stride(),
                                  use,
                                  toPosition(parameters.scale),
                                  threads,
                                  report,
                                  SplitRule::LongestSide);
  report.countSamples("no_value", indices.size() - use.size());
  report.countSamples("samples", read.samples->size());
  const StepTimer step(report, "ranges");
  read.values = gatherValues(*read.samples, values, threads, report);
  read.ranges = read.samples->getTree().computeRanges(read.values.values, threads);
  return read;
}

/** Leave the surface open where it reaches the box. */
void
openCaps(WorkingMesh& mesh)
{
  mesh.dropTriangles([&](std::size_t i) { return mesh.regions[i] != surface_region; });
  std::vector<std::uint32_t> source_of;
  splitPinchedVertices(mesh.triangles, mesh.vertices.size(), source_of);
  for (const std::uint32_t source : source_of)
    mesh.vertices.push_back(mesh.vertices[source]);
}

void
dropSmallPieces(WorkingMesh& mesh, std::size_t least, Report& report)
{
  if (least == 0)
    return;
  const PieceList list = findPieces(mesh.triangles, mesh.vertices.size());
  mesh.dropTriangles([&](std::size_t i) {
    const auto piece = static_cast<std::size_t>(list.of_vertex[mesh.triangles[i][0]]);
    return list.pieces[piece].triangles < least;
  });
  report.count("dropped_pieces",
               static_cast<std::uint64_t>(std::count_if(
                   list.pieces.begin(), list.pieces.end(), [&](const auto& piece) {
                     return piece.triangles < least;
                   })));
}

void
warnOfCaps(const SurfaceTriangles& surface,
           double isovalue,
           Outside outside,
           Report& report)
{
  if (surface.cap_part > large_cap)
    report.warn("large_caps",
                {{"isovalue", describeNumbers({isovalue})[0]},
                 {"percent", std::lround(100.0 * surface.cap_part)},
                 {"is_lower_outside", outside == Outside::Lower}});
}

/** \param is_even whether triangles were made even, so that slivers are a defect */
void
warnOfFolds(const SurfaceTriangles& mesh, bool is_even, Report& report)
{
  const std::uint64_t slivers = is_even ? mesh.slivers : 0;
  if (static_cast<double>(mesh.folds + slivers) >
      many_folds * static_cast<double>(mesh.triangles.size()))
    report.warn("folds",
                {{"triangles", mesh.triangles.size()},
                 {"folds", mesh.folds},
                 {"is_even", is_even},
                 {"slivers", slivers}});
}

} // namespace

SurfaceTriangles
makeSurfaceMesh(const CloudView& cloud,
                const pcl::Indices& indices,
                const SurfaceMeshParameters& parameters,
                const std::vector<double>& shown_isovalues,
                unsigned threads,
                Report& report)
{
  checkParameters(parameters);
  checkIndices(indices, cloud.count, "SurfaceMesh");
  const IsosurfaceParameters& isosurface = parameters.isosurface;
  const MeshSamples read = readSamples(cloud, indices, isosurface, threads, report);
  const TouchingCells candidates(*read.samples);
  const IsopointInput input{*read.samples,
                            read.values.values,
                            read.ranges,
                            candidates,
                            isosurface.criterion,
                            isosurface.outside,
                            isosurface.interpolation,
                            threads,
                            isosurface.errors_only};
  const NodeRanges::Range range = read.ranges[read.samples->getTree().getRoot()];
  SurfaceTriangles all;
  for (std::size_t i = 0; i < isosurface.isovalues.size(); ++i) {
    const double isovalue = isosurface.isovalues[i], shown = shown_isovalues[i];
    const auto rounded = static_cast<float>(read.frame.apply(isovalue));
    if (!(range.min < rounded && rounded <= range.max)) {
      warnIfOutside(isovalue, isosurface.field, range, read.frame, report);
      continue;
    }
    const auto crossing = candidates.findCrossing(read.ranges, rounded, threads);
    checkMemoryOf("A mesh beside samples",
                  crossing.size(),
                  meshBytes(static_cast<double>(crossing.size())));
    report.count("crossing_samples", crossing.size());
    all.tally.crossing += crossing.size();
    countSpikes(input, crossing, rounded, all.tally, report);
    WorkingMesh mesh = makeBandSurface(input, rounded, report);
    if (parameters.meshing.remesh == Remeshing::Even)
      remesh(mesh, parameters.meshing.edge_length, threads, report);
    if (parameters.meshing.open)
      openCaps(mesh);
    dropSmallPieces(mesh, parameters.meshing.drop_pieces, report);
    SurfaceTriangles surface =
        finishMesh(input, rounded, std::move(mesh), read.values.sources, report);
    warnOfCaps(surface, shown, isosurface.outside, report);
    for (PointIso& vertex : surface.vertices)
      vertex.isovalue = static_cast<float>(shown);
    for (SurfacePiece& piece : surface.pieces)
      piece.isovalue = shown;
    all.append(surface);
  }
  report.setCount("vertices", all.vertices.size());
  report.setCount("triangles", all.triangles.size());
  warnOfFolds(all, parameters.meshing.remesh == Remeshing::Even, report);
  return all;
}

} // namespace detail

pcl::PolygonMesh
toPolygonMesh(const SurfaceTriangles& surface,
              const CloudView& samples,
              unsigned threads,
              Report& report)
{
  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2(surface.vertices, mesh.cloud);
  warnOfReplacedFields(samples.fields, mesh.cloud.fields, report);
  interpolateFields(samples, surface.edges, mesh.cloud, threads);
  mesh.header = mesh.cloud.header;
  mesh.polygons.resize(surface.triangles.size());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    mesh.polygons[i].vertices.assign(surface.triangles[i].begin(),
                                     surface.triangles[i].end());
  return mesh;
}

} // namespace pcl_uvol
