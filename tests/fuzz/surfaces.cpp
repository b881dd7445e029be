// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of any points and triangles: normals, splats and measures.
#include "meshes.h"
#include "promises.h"
#include "random_cloud.h"
#include "targets.h"
#include <pcl_uvol/mesh/surface_measures.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <cmath>

namespace uvol_fuzz {

namespace {

using Cloud = pcl::PCLPointCloud2;

constexpr std::array<const char*, 6> surface_fields{
    "x", "y", "z", "normal_x", "normal_y", "normal_z"};

/** All of them are NaN, or it is a unit vector with a surface variation. */
void
requireNormal(const pcl::Normal& normal)
{
  constexpr float tolerance = 1e-3f;
  const float length = normal.getNormalVector3fMap().norm();
  require(std::isnan(length) == std::isnan(normal.curvature),
          "points without a place, and only these, have no normal");
  require(std::isnan(length) || std::abs(length - 1.0f) < tolerance || length == 0.0f,
          "normals are unit vectors");
  require(std::isnan(length) ||
              (normal.curvature >= 0.0f && normal.curvature <= 1.0f / 3.0f + tolerance),
          "surface variations are from 0 to 1/3");
}

void
requireFigures(const pcl_uvol::SurfaceFigures& figures, const ClosedMesh& mesh)
{
  std::size_t triangles = 0, genus = 0;
  for (const auto& piece : figures.pieces) {
    triangles += piece.triangles;
    require(piece.rims == 0 && piece.genus, "pieces of a closed mesh are closed");
    genus += *piece.genus;
  }
  require(triangles == mesh.triangles.size() && genus == mesh.genus,
          "pieces have the triangles and the handles of the mesh");
}

} // namespace

void
estimateNormals(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::SurfaceNormalParameters parameters;
  parameters.k = input.choose(40);
  parameters.scale = takeScale(input);
  if (input.flip())
    parameters.rotation = {5.0 * input.take<std::int8_t>(), 0.0, 30.0};
  if (input.flip())
    parameters.view_point = Eigen::Array3d(input.take<float>(), 1.0, 0.0);
  pcl_uvol::SurfaceNormalEstimation<Cloud> estimation;
  const auto cloud = takeCloud(input, surface_fields);
  estimation.setInputCloud(cloud);
  estimation.setParameters(parameters);
  estimation.setNumberOfThreads(1);
  refusalOf([&] {
    pcl::PointCloud<pcl::Normal> normals;
    estimation.compute(normals);
    require(normals.size() == cloud->width, "every point has a normal");
    for (const auto& normal : normals)
      requireNormal(normal);
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
  generation.setInputCloud(takeCloud(input, surface_fields));
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

void
measureSurface(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::SurfaceMeasuresParameters parameters;
  parameters.curved = input.flip();
  parameters.find_intersections = input.flip();
  const bool has_triangles = input.flip(), has_samples = input.flip();
  const ClosedMesh mesh = takeMesh(input);
  const auto surface = std::make_shared<pcl_uvol::Dataset>();
  surface->cloud = *takeCloud(
      input,
      std::array<const char*, 9>{
          "x", "y", "z", "normal_x", "normal_y", "normal_z", "error", "cap", "value"});
  pcl_uvol::SurfaceMeasures measures;
  measures.setInputSurface(
      surface, has_triangles ? mesh.triangles : std::vector<pcl_uvol::Triangle>());
  if (has_samples)
    measures.setInputSamples(surface);
  measures.setParameters(parameters);
  measures.setNumberOfThreads(1);
  refusalOf([&] {
    const auto figures = measures.compute();
    require(figures.vertex_areas.size() == surface->cloud.width &&
                figures.piece_of.size() == surface->cloud.width,
            "vertices have a share in the area and a piece");
    for (const std::int32_t piece : figures.piece_of)
      require(piece >= -1 && piece < static_cast<std::int32_t>(figures.pieces.size()),
              "it is one of the pieces");
    if (has_triangles)
      requireFigures(figures, mesh);
    requireSentences(measures.getReport().warnings);
  });
}

} // namespace uvol_fuzz
