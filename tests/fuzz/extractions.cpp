// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of any samples: isopoints, meshes, filled gaps and boxes that repeat.
#include "meshes.h"
#include "promises.h"
#include "random_cloud.h"
#include "targets.h"
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace uvol_fuzz {

namespace {

using Cloud = pcl::PCLPointCloud2;
using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::IsosurfaceResult;

pcl_uvol::IsosurfaceParameters
takeIsosurface(Bytes& bytes)
{
  pcl_uvol::IsosurfaceParameters parameters;
  parameters.interpolation = chooseOne(bytes, listWords(pcl_uvol::Interpolation()));
  parameters.outside = chooseOne(bytes, listWords(pcl_uvol::Outside()));
  parameters.criterion = chooseOne(bytes, listWords(pcl_uvol::AngleCriterion()));
  parameters.neighbors = chooseOne(bytes, listWords(pcl_uvol::NeighborSource()));
  parameters.voronoi_cells = 16;
  parameters.scale = takeScale(bytes);
  parameters.isovalues = {bytes.flip() ? bytes.take<float>()
                                       : 0.5 * bytes.take<std::int8_t>()};
  return parameters;
}

IsosurfacePipelineParameters
takePipeline(Bytes& bytes)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface = takeIsosurface(bytes);
  parameters.drop_bridged = bytes.flip();
  parameters.normals = chooseOne(bytes, listWords(pcl_uvol::NormalMethod()));
  return parameters;
}

/** The coordinate of a point whose first fields are x, y and z. */
float
coordinateOf(const Cloud& cloud, std::size_t point, std::size_t axis)
{
  float coordinate;
  std::memcpy(&coordinate,
              &cloud.data[point * cloud.point_step + axis * sizeof(float)],
              sizeof(float));
  return coordinate;
}

double
extentOf(const Cloud& cloud, std::size_t axis)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low = infinity, high = -infinity;
  for (std::size_t i = 0; i < cloud.width; ++i)
    if (const double at = coordinateOf(cloud, i, axis); std::isfinite(at)) {
      low = std::min(low, at);
      high = std::max(high, at);
    }
  return high - low;
}

void
requireEdges(const pcl_uvol::IsoEdges& edges, std::size_t samples)
{
  for (const auto& edge : edges) {
    require(edge.first < samples && edge.second < samples, "edges have samples");
    require(edge.t >= 0.0f && edge.t <= 1.0f, "isopoints lie between their samples");
  }
}

/** Runs the pipeline, which may refuse. */
template <typename Promises>
void
extract(const Cloud::ConstPtr& cloud,
        const IsosurfacePipelineParameters& parameters,
        const Promises& promises)
{
  const auto samples = std::make_shared<pcl_uvol::Dataset>();
  samples->cloud = *cloud;
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(parameters);
  pipeline.setNumberOfThreads(1);
  refusalOf([&] {
    const IsosurfaceResult result = pipeline.run();
    require(result.surface.cloud.width == result.edges.size(), "isopoints have edges");
    for (std::size_t i = 0; i < result.surface.cloud.width; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        require(std::isfinite(coordinateOf(result.surface.cloud, i, axis)),
                "positions are finite");
    requireSentences(result.report.warnings);
    promises(result);
  });
}

} // namespace

void
extractIsosurface(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  const IsosurfacePipelineParameters parameters = takePipeline(input);
  const auto cloud = takeCloud(input, sample_fields);
  extract(cloud, parameters, [&](const IsosurfaceResult& result) {
    requireEdges(result.edges, cloud->width);
  });
}

void
fillGaps(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  IsosurfacePipelineParameters parameters = takePipeline(input);
  parameters.fill_gaps = true;
  const auto cloud = takeCloud(input, sample_fields);
  extract(cloud, parameters, [&](const IsosurfaceResult& result) {
    require(result.gaps && result.gaps->sources.size() == result.gaps->predicted,
            "predicted samples have a measured one beside them");
    for (const std::uint32_t source : result.gaps->sources)
      require(source < cloud->width, "it is one of the input");
    requireEdges(result.edges, cloud->width + result.gaps->predicted);
  });
}

void
extractInBox(const std::uint8_t* bytes, std::size_t size)
{
  // Parts of the extent of the samples.
  constexpr std::array<double, 8> sides{
      0.0, 1.0, 1.125, 3.0, 1e-3, 1e30, -1.0, std::numeric_limits<double>::infinity()};
  Bytes input(bytes, size);
  IsosurfacePipelineParameters parameters = takePipeline(input);
  if (input.flip()) {
    parameters.mesh.emplace();
    parameters.mesh->remesh = chooseOne(input, listWords(pcl_uvol::Remeshing()));
    parameters.periodic_mesh = chooseOne(input, listWords(pcl_uvol::PeriodicMesh()));
  }
  for (double& side : parameters.periodic)
    side = sides[input.choose(sides.size())];
  const auto cloud = takeCloud(input, sample_fields);
  for (std::size_t axis = 0; axis < 3; ++axis)
    parameters.periodic[static_cast<Eigen::Index>(axis)] *= extentOf(*cloud, axis);
  extract(cloud, parameters, [&](const IsosurfaceResult& result) {
    requireEdges(result.edges, cloud->width);
    for (const auto& triangle : result.triangles)
      for (const std::uint32_t vertex : triangle)
        require(vertex < result.surface.cloud.width, "triangles have vertices");
  });
}

void
meshSurface(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::SurfaceMeshParameters parameters;
  parameters.isosurface = takeIsosurface(input);
  parameters.meshing.remesh = chooseOne(input, listWords(pcl_uvol::Remeshing()));
  pcl_uvol::SurfaceMesh<Cloud> mesh;
  mesh.setInputCloud(takeCloud(input, sample_fields));
  mesh.setParameters(parameters);
  mesh.setNumberOfThreads(1);
  refusalOf([&] {
    pcl_uvol::SurfaceTriangles surface;
    mesh.extract(surface);
    requireFinite(surface.vertices);
    requireClosed(surface.triangles, surface.vertices.size());
  });
}

} // namespace uvol_fuzz
