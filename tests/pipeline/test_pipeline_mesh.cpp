// SPDX-License-Identifier: BSD-3-Clause
// Meshes in the pipeline: those of SurfaceMesh, with fields; after level sets too.
#include "common/scalar_field.h"
#include "mesh/mesh_fields.h"
#include "pipeline/run_pipeline.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>
#include <functional>

namespace test_pipeline_mesh {

using namespace pcl_uvol;
using namespace uvol_test;

std::shared_ptr<Dataset>
makeSamples(double noise = 0.0)
{
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(*sampleField(sphereField(7.0), 3, noise), samples->cloud);
  return samples;
}

IsosurfacePipelineParameters
makeParameters(const std::vector<double>& isovalues)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = isovalues;
  parameters.mesh.emplace();
  return parameters;
}

std::vector<double>
valuesOf(const Dataset& dataset, const std::string& name)
{
  const CloudView view = viewOf(dataset.cloud);
  const ScalarField field(view.fields, name);
  std::vector<double> values;
  for (std::size_t i = 0; i < view.count; ++i)
    values.push_back(field.read(view.point(i)));
  return values;
}

TEST(PipelineMesh, IsThatOfSurfaceMesh)
{
  const auto samples = makeSamples();
  const IsosurfaceResult result =
      runPipeline(samples, makeParameters({0.0, 2.0, 1000.0}));
  const MeshRun alone =
      runMesh(sampleField(sphereField(7.0), 3), {}, {0.0, 2.0, 1000.0});
  EXPECT_EQ(alone.mesh.triangles, result.triangles);
  EXPECT_EQ(alone.mesh.smallest_angle, result.smallest_angle);
  ASSERT_EQ(2u, result.pieces.size());
  EXPECT_EQ(2.0, result.pieces[1].isovalue);
  ASSERT_EQ(3u, result.isopoints.size());
  EXPECT_EQ(result.pieces[0].vertices, result.isopoints[0]);
  EXPECT_EQ(0u, result.isopoints[2]);
  const CloudView view = viewOf(result.surface.cloud);
  ASSERT_EQ(alone.mesh.vertices.size(), view.count);
  const auto pieces = valuesOf(result.surface, "piece"),
             caps = valuesOf(result.surface, "cap"),
             intensities = valuesOf(result.surface, "intensity"),
             isovalues = valuesOf(result.surface, "isovalue");
  for (std::size_t i = 0; i < view.count; ++i) {
    const PointIso& vertex = alone.mesh.vertices[i];
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(vertex.data[axis], view.xyz(i)[axis]);
    ASSERT_EQ(alone.mesh.piece_of[i], pieces[i]);
    ASSERT_EQ(0.0, caps[i]);
    ASSERT_NEAR(isovalues[i], intensities[i], 1.0);
  }
  EXPECT_EQ(1u, result.report.warnings.size()); // of the last isovalue
}

/** Mean distance of vertices to the sphere. */
double
deviationOf(const IsosurfaceResult& result)
{
  const MeshField sphere = sphereField(7.0);
  const CloudView view = viewOf(result.surface.cloud);
  double sum = 0.0;
  for (std::size_t i = 0; i < view.count; ++i)
    sum += std::abs(
        sphere.value(Eigen::Map<const Eigen::Vector3f>(view.xyz(i)).cast<double>()));
  return sum / static_cast<double>(view.count);
}

TEST(PipelineMesh, SmoothFieldsHaveSmoothMeshes)
{
  IsosurfacePipelineParameters parameters = makeParameters({0.0});
  const auto noisy = makeSamples(0.84);
  const IsosurfaceResult rough = runPipeline(noisy, parameters);
  parameters.smooth = true;
  const IsosurfaceResult smooth = runPipeline(noisy, parameters);
  EXPECT_LT(deviationOf(smooth), 0.7 * deviationOf(rough));
  ASSERT_EQ(1u, smooth.pieces.size());
  EXPECT_EQ(0u, smooth.pieces[0].genus);
  EXPECT_EQ(0u, smooth.pieces[0].rims);
  // The isovalue is that of the field, not of the level-set function.
  EXPECT_EQ(0.0, valuesOf(smooth.surface, "isovalue").front());
}

TEST(PipelineMesh, ReportsTheSampling)
{
  auto parameters = makeParameters({0.0});
  const auto of = [&] {
    const auto sampling = runPipeline(makeSamples(), parameters).sampling;
    return sampling ? std::pair(sampling->most, sampling->along)
                    : std::pair(LocalDimension::Isolated, 0.0f);
  };
  const auto of_mesh = of();
  EXPECT_EQ(LocalDimension::Volume, of_mesh.first);
  parameters.mesh.reset();
  EXPECT_EQ(of(), of_mesh);
  parameters.smooth = true;
  EXPECT_EQ(of(), of_mesh);
}

TEST(PipelineMesh, NoSurfaceIsNoMesh)
{
  const IsosurfaceResult result = runPipeline(makeSamples(), makeParameters({1000.0}));
  EXPECT_TRUE(result.triangles.empty());
  EXPECT_TRUE(result.pieces.empty());
  EXPECT_EQ(0u, result.surface.cloud.width);
}

TEST(PipelineMesh, ParametersAreChecked)
{
  const std::vector<std::function<void(IsosurfacePipelineParameters&)>> changes = {
      [](auto& p) { p.max_error = 1.0; },
      [](auto& p) { p.automatic_max_error = true; },
      [](auto& p) { p.drop_bridged = true; },
      [](auto& p) { p.normals = NormalMethod::Pca; },
      [](auto& p) { p.isosurface.interpolation = Interpolation::Linear; },
      [](auto& p) { p.isosurface.neighbors = NeighborSource::Voronoi; },
      [](auto& p) { p.mesh->edge_length = -1.0; },
      [](auto& p) { p.mesh->edge_length = std::nan(""); }};
  const IsosurfacePipelineParameters good = makeParameters({0.0});
  EXPECT_NO_THROW(checkParameters(good));
  for (const auto& change : changes) {
    IsosurfacePipelineParameters bad = good;
    change(bad);
    EXPECT_THROW(checkParameters(bad), InvalidArgument);
  }
  EXPECT_EQ(good, IsosurfacePipelineParameters::fromJson(good.toJson()));
}

} // namespace test_pipeline_mesh
