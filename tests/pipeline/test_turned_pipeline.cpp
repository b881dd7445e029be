// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of samples in a space stretched along turned axes: what comes out is what
// comes out of samples turned by hand, and normals stand on the surface.
#include "common/stretch_axes.h"
#include "pipeline/run_pipeline.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace test_turned_pipeline {

using namespace pcl_uvol;
using detail::StretchAxes;

const Eigen::Array3d angles(30.0, 40.0, 15.0);

/** Layers that are level along turned axes, a wave on them, twenty times as wide as
 * they are thick.
 * \param period of the values across the layers; 0: they only grow */
std::shared_ptr<Dataset>
makeLayers(double period = 0.0)
{
  const Eigen::Matrix3d back = StretchAxes(angles).getRows().transpose();
  uvol_test::Random random(6);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 6000; ++i) {
    const Eigen::Vector3d seen(
        20.0 * random.uniform(), 20.0 * random.uniform(), random.uniform());
    pcl::PointXYZI point;
    point.getVector3fMap() = (back * seen).cast<float>();
    const double height = seen[2] + 0.05 * std::sin(0.5 * seen[0]);
    point.intensity =
        static_cast<float>(period > 0.0 ? std::sin(6.3 / period * height) : height);
    cloud.push_back(point);
  }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  return samples;
}

IsosurfacePipelineParameters
makeParameters()
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {0.5};
  parameters.isosurface.scale = {1.0f, 1.0f, 20.0f};
  parameters.isosurface.outside = Outside::Higher;
  return parameters;
}

std::shared_ptr<Dataset>
turned(const Dataset& samples)
{
  auto copy = std::make_shared<Dataset>(samples);
  StretchAxes(angles).turn(copy->cloud);
  return copy;
}

void
expectSameSurface(IsosurfacePipelineParameters parameters)
{
  const auto samples = makeLayers();
  auto expected = uvol_test::runPipeline(turned(*samples), parameters);
  StretchAxes(angles).turnBack(expected.surface.cloud);
  parameters.rotation = angles;
  const auto result = uvol_test::runPipeline(samples, parameters);
  EXPECT_GT(result.surface.cloud.width, 500u);
  EXPECT_EQ(expected.surface.cloud.data, result.surface.cloud.data);
  EXPECT_EQ(expected.triangles, result.triangles);
}

TEST(TurnedPipeline, IsThatOfSamplesThatAreTurned)
{
  IsosurfacePipelineParameters parameters = makeParameters();
  expectSameSurface(parameters);
  parameters.normals = NormalMethod::Pca;
  expectSameSurface(parameters);
  parameters.normals = NormalMethod::Auto;
  parameters.mesh.emplace();
  expectSameSurface(parameters);
  parameters.mesh.reset();
  parameters.smooth = true;
  expectSameSurface(parameters);
}

TEST(TurnedPipeline, NormalsStandOnTheLayer)
{
  const Eigen::Vector3d up = StretchAxes(angles).getRows().row(2);
  for (const NormalMethod normals :
       {NormalMethod::Auto, NormalMethod::Pca, NormalMethod::Edge}) {
    for (const Interpolation interpolation :
         {Interpolation::Auto, Interpolation::Linear}) {
      IsosurfacePipelineParameters parameters = makeParameters();
      parameters.rotation = angles;
      parameters.normals = normals;
      parameters.isosurface.interpolation = interpolation;
      const auto result = uvol_test::runPipeline(makeLayers(), parameters);
      double sum = 0.0;
      std::size_t steep = 0;
      const auto points = uvol_test::toIsopoints(result);
      for (const PointIso& point : points) {
        const double along = point.getNormalVector3fMap().cast<double>().dot(up);
        sum += along;
        steep += along < 0.7;
      }
      EXPECT_GT(sum, 0.94 * static_cast<double>(points.size()));
      EXPECT_LT(steep, points.size() / 20);
    }
  }
}

TEST(TurnedStages, LevelSetsAreThoseOfSamplesThatAreTurned)
{
  const auto samples = makeLayers();
  LevelSetEvolution<pcl::PCLPointCloud2> evolution;
  LevelSetParameters parameters;
  parameters.isovalue = 0.5;
  parameters.scale = {1.0f, 1.0f, 20.0f};
  parameters.max_steps = 5;
  const auto evolve = [&](const Dataset& dataset) {
    evolution.setInputCloud(
        pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
    evolution.setParameters(parameters);
    std::vector<float> phi;
    evolution.evolve(phi);
    return phi;
  };
  const auto seen = turned(*samples);
  const Eigen::Matrix3d rows = StretchAxes(angles).getRows();
  const Eigen::Vector3d middle(10.0, 10.0, 0.5), up(0.0, 0.0, 1.0);
  const std::pair<InitialFunction, InitialFunction> starts[] = {
      {{}, {}},
      {InitialFunction::sphere(middle, 0.4),
       InitialFunction::sphere(rows.transpose() * middle, 0.4)},
      {InitialFunction::plane(middle, up),
       InitialFunction::plane(rows.transpose() * middle, rows.transpose() * up)}};
  for (const auto& [along_axes, in_space] : starts) {
    parameters.rotation.setZero();
    parameters.initial = along_axes;
    const auto expected = evolve(*seen);
    parameters.rotation = angles;
    parameters.initial = in_space;
    const auto phi = evolve(*samples);
    ASSERT_EQ(expected.size(), phi.size());
    for (std::size_t i = 0; i < phi.size(); ++i)
      ASSERT_NEAR(expected[i], phi[i], 1e-4f * (1.0f + std::abs(expected[i])));
  }
  parameters.initial = InitialFunction::box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  EXPECT_THROW(evolve(*samples), InvalidArgument);
}

TEST(TurnedStages, NormalsAreThoseOfPointsThatAreTurned)
{
  // A tilted plane of points, wide and thin noise across: far from where they are seen.
  uvol_test::Random random(8);
  pcl::PointCloud<pcl::PointXYZ> points;
  const Eigen::Matrix3d back = StretchAxes(angles).getRows().transpose();
  for (int i = 0; i < 500; ++i)
    points.emplace_back();
  for (auto& point : points)
    point.getVector3fMap() =
        (back *
         Eigen::Vector3d(random.uniform(), random.uniform(), 0.02 * random.uniform()))
            .cast<float>();
  SurfaceNormalEstimation<pcl::PointXYZ, pcl::PointNormal> estimation;
  SurfaceNormalParameters parameters;
  parameters.scale = {1.0f, 3.0f, 2.0f};
  parameters.rotation = angles;
  const Eigen::Vector3d seen_from = back * Eigen::Vector3d(0.5, 0.5, 9.0);
  parameters.view_point = seen_from.array();
  estimation.setInputCloud(pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(points));
  estimation.setParameters(parameters);
  pcl::PointCloud<pcl::PointNormal> normals;
  estimation.compute(normals);
  for (const auto& normal : normals)
    EXPECT_GT(normal.getNormalVector3fMap().cast<double>().dot(back.col(2)), 0.99);
}

TEST(TurnedPipeline, FindsTheScaleAlongTheAxes)
{
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.rotation = angles;
  parameters.automatic_scale = true;
  const auto result = uvol_test::runPipeline(makeLayers(0.4), parameters);
  ASSERT_TRUE(result.scale_choice);
  EXPECT_TRUE((result.scale == result.scale_choice->scale).all());
  EXPECT_GT(result.scale[2], 5.0f);
  parameters.automatic_scale = false;
  EXPECT_FALSE(uvol_test::runPipeline(makeLayers(0.4), parameters).scale_choice);
}

TEST(TurnedPipeline, NeedsSamples)
{
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.rotation = angles;
  IsosurfacePipeline pipeline;
  pipeline.setParameters(parameters);
  EXPECT_THROW(pipeline.run(), InvalidArgument);
}

TEST(TurnedPipeline, RefusesABoxThatRepeatsAndBadAngles)
{
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.rotation = {0.0, 30.0, 31.0};
  EXPECT_THROW(uvol_test::runPipeline(makeLayers(0.4), parameters), InvalidArgument);
  parameters.rotation = angles;
  parameters.periodic = {20.0, 0.0, 0.0};
  EXPECT_THROW(uvol_test::runPipeline(makeLayers(0.4), parameters), InvalidArgument);
}

} // namespace test_turned_pipeline
