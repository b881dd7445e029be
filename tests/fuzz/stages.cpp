// SPDX-License-Identifier: BSD-3-Clause
// Points, values and parameters of any kind through the stages.
#include "promises.h"
#include "random_cloud.h"
#include "targets.h"
#include <pcl_uvol/interpolation/field_interpolation.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <cmath>
#include <set>
#include <utility>

namespace uvol_fuzz {

namespace {

using Cloud = pcl::PCLPointCloud2;
using pcl_uvol::Interpolation;

constexpr std::array<const char*, 4> sample_fields{"x", "y", "z", "intensity"};

template <typename T, std::size_t count>
T
chooseOne(Bytes& bytes, const std::array<pcl_uvol::EnumWord<T>, count>& words)
{
  return words[bytes.choose(count)].value;
}

Eigen::Array3f
takeScale(Bytes& bytes)
{
  constexpr std::array<float, 4> factors{1.0f, 1e-3f, 1e3f, 1e30f};
  const float x = factors[bytes.choose(factors.size())];
  return {x, 1.0f, factors[bytes.choose(factors.size())]};
}

pcl_uvol::IsosurfaceParameters
takeIsosurface(Bytes& bytes)
{
  pcl_uvol::IsosurfaceParameters parameters;
  parameters.interpolation = chooseOne(bytes, listWords(Interpolation()));
  parameters.outside = chooseOne(bytes, listWords(pcl_uvol::Outside()));
  parameters.criterion = chooseOne(bytes, listWords(pcl_uvol::AngleCriterion()));
  parameters.neighbors = chooseOne(bytes, listWords(pcl_uvol::NeighborSource()));
  parameters.voronoi_cells = 16;
  parameters.scale = takeScale(bytes);
  parameters.isovalues = {bytes.flip() ? bytes.take<float>()
                                       : 0.5 * bytes.take<std::int8_t>()};
  return parameters;
}

void
requireEdges(const pcl_uvol::IsoEdges& edges, std::size_t samples)
{
  for (const auto& edge : edges) {
    require(edge.first < samples && edge.second < samples, "edges have samples");
    require(edge.t >= 0.0f && edge.t <= 1.0f, "isopoints lie between their samples");
  }
}

template <typename Points>
void
requireFinite(const Points& points)
{
  for (const auto& point : points)
    require(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z),
            "positions are finite");
}

/** Every side of a triangle is, the other way round, one of one other triangle. */
void
requireClosed(const std::vector<pcl_uvol::Triangle>& triangles, std::size_t vertices)
{
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const auto& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      require(triangle[i] < vertices, "triangles have vertices");
      require(sides.emplace(triangle[i], triangle[(i + 1) % 3]).second,
              "no side is run through twice");
    }
  for (const auto& [from, to] : sides)
    require(sides.count({to, from}) == 1, "a mesh has no rim");
}

} // namespace

void
extractIsosurface(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::IsosurfacePipelineParameters parameters;
  parameters.isosurface = takeIsosurface(input);
  parameters.drop_bridged = input.flip();
  parameters.normals = chooseOne(input, listWords(pcl_uvol::NormalMethod()));
  const auto samples = std::make_shared<pcl_uvol::Dataset>();
  samples->cloud = *takeCloud(input, sample_fields);
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(parameters);
  pipeline.setNumberOfThreads(1);
  refusalOf([&] {
    const auto result = pipeline.run();
    require(result.surface.cloud.width == result.edges.size(), "isopoints have edges");
    requireEdges(result.edges, samples->cloud.width);
    for (const std::string& warning : result.report.warnings)
      requireSentence(warning);
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

void
evolveLevelSet(const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::size_t most_steps = 10; // for speed
  Bytes input(bytes, size);
  pcl_uvol::LevelSetParameters parameters;
  parameters.scheme = chooseOne(input, listWords(pcl_uvol::FitScheme()));
  parameters.flow = chooseOne(input, listWords(pcl_uvol::CurvatureFlow()));
  parameters.bound = chooseOne(input, listWords(pcl_uvol::StepBound()));
  parameters.integration = chooseOne(input, listWords(pcl_uvol::Integration()));
  parameters.reinitialization =
      chooseOne(input, listWords(pcl_uvol::Reinitialization()));
  parameters.max_steps = input.choose(most_steps);
  if (input.flip())
    parameters.mu = input.choose(11) / 10.0;
  parameters.band_width = input.flip() ? 0.0 : 4.0;
  parameters.scale = takeScale(input);
  parameters.isovalue = 0.5 * input.take<std::int8_t>();
  pcl_uvol::LevelSetEvolution<Cloud> evolution;
  const auto cloud = takeCloud(input, sample_fields);
  evolution.setInputCloud(cloud);
  evolution.setParameters(parameters);
  evolution.setNumberOfThreads(1);
  refusalOf([&] {
    std::vector<float> phi;
    evolution.evolve(phi);
    require(phi.size() == cloud->width, "phi has a value per point");
    for (const float value : phi)
      require(!std::isinf(value), "phi is finite or missing");
  });
}

void
interpolateFields(const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::size_t most_queries = 8;
  Bytes input(bytes, size);
  pcl_uvol::InterpolationParameters parameters;
  parameters.model = chooseOne(input, listWords(pcl_uvol::InterpolationModel()));
  parameters.extrapolate = input.flip();
  parameters.kriging.variogram = chooseOne(input, listWords(pcl_uvol::VariogramKind()));
  parameters.kriging.trend = static_cast<int>(input.choose(3));
  parameters.kriging.octants = input.flip();
  parameters.sph.kernel = chooseOne(input, listWords(pcl_uvol::SphKernel()));
  parameters.scale = takeScale(input);
  std::vector<std::array<double, 3>> queries(input.choose(most_queries));
  for (auto& query : queries)
    for (double& coordinate : query)
      coordinate = input.flip() ? input.take<float>() : input.take<std::int8_t>();
  pcl_uvol::FieldInterpolation<Cloud> interpolation;
  interpolation.setInputCloud(takeCloud(input, sample_fields));
  interpolation.setParameters(parameters);
  interpolation.setNumberOfThreads(1);
  refusalOf([&] {
    pcl_uvol::InterpolatedFields fields;
    interpolation.interpolateAt(queries, fields);
    require(fields.size == queries.size() && fields.support.size() == queries.size(),
            "every query is answered");
    for (const double error : fields.errors)
      require(!(error < 0.0), "standard errors are not negative");
  });
}

void
clusterAttributes(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::ClusteringParameters parameters;
  parameters.attributes = {"intensity", "x"};
  if (input.flip())
    parameters.attributes.emplace_back("y");
  parameters.is_standardized = input.flip();
  parameters.neighbors = input.choose(20);
  parameters.min_cluster_size = input.choose(6);
  parameters.allow_single_cluster = input.flip();
  parameters.cut_distance = input.flip() ? 0.25 * input.take<std::uint8_t>() : 0.0;
  pcl_uvol::DensityClustering<Cloud> clustering;
  const auto cloud = takeCloud(input, sample_fields);
  clustering.setInputCloud(cloud);
  clustering.setParameters(parameters);
  clustering.setNumberOfThreads(1);
  refusalOf([&] {
    std::vector<int> labels;
    clustering.compute(labels);
    require(labels.size() == cloud->width, "every point has a label");
    const auto& tree = clustering.getTree();
    for (std::size_t i = 0; i < tree.size(); ++i)
      require(tree[i].parent < static_cast<std::int32_t>(i),
              "parents stand before their children");
    for (const float probability : clustering.getProbabilities())
      require(probability >= 0.0f && probability <= 1.0f,
              "probabilities are between 0 and 1");
  });
}

void
makeSplats(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::SplatParameters parameters;
  parameters.delta = 0.001 * (1 + input.take<std::uint8_t>());
  parameters.delta_is_length = input.flip();
  parameters.lambda = input.choose(11) / 10.0;
  pcl_uvol::SplatGeneration<Cloud> generation;
  generation.setInputCloud(takeCloud(
      input,
      std::array<const char*, 6>{"x", "y", "z", "normal_x", "normal_y", "normal_z"}));
  generation.setParameters(parameters);
  generation.setNumberOfThreads(1);
  refusalOf([&] {
    pcl::PointCloud<pcl_uvol::PointSplat> splats;
    generation.compute(splats);
    requireFinite(splats);
    for (const auto& splat : splats)
      require(splat.radius > 0.0f && std::isfinite(splat.radius),
              "discs have a radius");
  });
}

} // namespace uvol_fuzz
