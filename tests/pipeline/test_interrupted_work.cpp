// SPDX-License-Identifier: BSD-3-Clause
// What a progress callback throws ends everything besides extractions that may take
// long, and leaves the objects fit for the next run.
#include "interpolation/outer_layer.h"
#include "interpolation/sph_density.h"
#include "pipeline/dataset_info.h"
#include "support/clouds.h"
#include "support/interruption.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/derivatives/gradient_estimation.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/interpolation/field_interpolation.h>
#include <pcl_uvol/mesh/surface_measures.h>
#include <pcl_uvol/multivariate/cluster_membership.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace test_interrupted_work {

using namespace pcl_uvol;
using uvol_test::interruptEveryStep;
using Cloud = pcl::PCLPointCloud2;

constexpr unsigned threads = 2;

/** Samples of the radial test and their sphere. */
struct Ball {
  std::shared_ptr<Dataset> samples = std::make_shared<Dataset>();
  std::shared_ptr<Dataset> surface = std::make_shared<Dataset>();
  std::vector<Triangle> triangles;
  Cloud::ConstPtr cloud, isopoints;

  /** \param isovalues parts of the radius of the test */
  explicit Ball(const std::vector<double>& isovalues = {1.0}, bool is_mesh = false)
  {
    const auto radial = uvol_test::makeRadialCloud(3000, 1);
    pcl::toPCLPointCloud2(*radial.cloud, samples->cloud);
    cloud = Cloud::ConstPtr(samples, &samples->cloud);
    IsosurfacePipelineParameters parameters;
    for (const double isovalue : isovalues)
      parameters.isosurface.isovalues.push_back(isovalue * radial.radius);
    parameters.isosurface.outside = Outside::Higher;
    if (is_mesh)
      parameters.mesh.emplace();
    IsosurfacePipeline pipeline;
    pipeline.setInput(samples);
    pipeline.setParameters(parameters);
    IsosurfaceResult result = pipeline.run();
    *surface = std::move(result.surface);
    triangles = std::move(result.triangles);
    isopoints = Cloud::ConstPtr(surface, &surface->cloud);
  }
};

TEST(InterruptedWork, PicturesInImageSpace)
{
  const Ball ball;
  ImageSpaceRenderer<Cloud> renderer;
  renderer.setSize(150, 130);
  renderer.setSupersampling(2);
  renderer.setNumberOfThreads(threads);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        renderer.setInputCloud(ball.isopoints); // is read anew
        renderer.setProgressCallback(progress);
        Image image;
        renderer.render(image);
        return image.color;
      },
      6);
}

TEST(InterruptedWork, PicturesWithoutNormals)
{
  const Ball ball;
  pcl::PointCloud<pcl::PointXYZ> bare;
  pcl::fromPCLPointCloud2(*ball.isopoints, bare);
  const auto cloud = std::make_shared<Cloud>();
  pcl::toPCLPointCloud2(bare, *cloud);
  ImageSpaceRenderer<Cloud> renderer;
  renderer.setSize(64, 64);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        renderer.setInputCloud(cloud);
        renderer.setProgressCallback(progress);
        Image image;
        renderer.render(image);
        return image.color;
      },
      8);
}

TEST(InterruptedWork, TransparentSurfaces)
{
  const Ball ball({0.6, 1.0});
  ImageSpaceRenderer<Cloud> renderer;
  renderer.setSize(64, 64);
  renderer.setOpacities({0.5, 0.3});
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        renderer.setInputCloud(ball.isopoints);
        renderer.setProgressCallback(progress);
        Image image;
        renderer.render(image);
        return image.color;
      },
      6);
}

TEST(InterruptedWork, RaysKeepTheirScene)
{
  const Ball ball;
  pcl::PointCloud<PointSplat> splats;
  SplatGeneration<Cloud> generation;
  generation.setInputCloud(ball.isopoints);
  generation.compute(splats);
  Scene scene;
  scene.splats.emplace_back();
  scene.splats[0].splats = pcl::make_shared<pcl::PointCloud<PointSplat>>(splats);
  RayTracer tracer;
  tracer.setSize(40, 40);
  bool is_set = false;
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        tracer.setProgressCallback(progress);
        if (progress || !is_set) // after an interruption it is not set again
          tracer.setScene(scene);
        is_set = true;
        Image image;
        tracer.render(image);
        return image.color;
      },
      2);
}

TEST(InterruptedWork, SplatsAndNormals)
{
  const Ball ball;
  SplatGeneration<Cloud> generation;
  generation.setInputCloud(ball.isopoints);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        generation.setProgressCallback(progress);
        pcl::PointCloud<PointSplat> splats;
        generation.compute(splats);
        std::vector<float> fields; // what follows the last one means nothing
        for (const PointSplat& splat : splats) {
          const auto* const first = reinterpret_cast<const float*>(&splat);
          fields.insert(fields.end(),
                        first,
                        first + offsetof(PointSplat, slope_v) / sizeof(float) + 1);
        }
        return fields;
      },
      3);
  SurfaceNormalEstimation<Cloud, pcl::PointNormal> estimation;
  estimation.setInputCloud(ball.isopoints);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        estimation.setProgressCallback(progress);
        pcl::PointCloud<pcl::PointNormal> points;
        estimation.compute(points);
        Cloud bytes;
        pcl::toPCLPointCloud2(points, bytes);
        return bytes.data;
      },
      3);
}

TEST(InterruptedWork, Measures)
{
  const Ball ball({1.0}, true);
  SurfaceMeasures measures;
  SurfaceMeasuresParameters parameters;
  parameters.find_intersections = true;
  measures.setParameters(parameters);
  measures.setInputSurface(ball.surface, ball.triangles);
  measures.setInputSamples(ball.samples);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        measures.setProgressCallback(progress);
        const SurfaceFigures figures = measures.compute();
        return std::pair(figures.isovalues[0].volume.value, figures.vertex_areas);
      },
      3);
}

TEST(InterruptedWork, ModelsAndTheirAnswers)
{
  const Ball ball;
  const CloudView view = viewOf(ball.samples->cloud);
  pcl::Indices all(view.count);
  std::iota(all.begin(), all.end(), 0);
  const auto places = detail::readPlaces(viewOf(ball.surface->cloud));
  for (const auto model : {InterpolationModel::Fit,
                           InterpolationModel::Sibson,
                           InterpolationModel::Kriging,
                           InterpolationModel::Sph,
                           InterpolationModel::Nearest}) {
    InterpolationParameters parameters;
    parameters.model = model;
    parameters.extrapolate = true;
    interruptEveryStep(
        [&](const ProgressCallback& progress) {
          Report report;
          report.progress = progress;
          const detail::FieldInterpolator interpolator(
              view, all, parameters, threads, report);
          return interpolator.interpolate(places, threads, report).values;
        },
        model == InterpolationModel::Sph ? 3 : 2);
  }
}

TEST(InterruptedWork, CrossValidation)
{
  const Ball ball;
  const CloudView view = viewOf(ball.samples->cloud);
  pcl::Indices all(view.count);
  std::iota(all.begin(), all.end(), 0);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        Report report;
        report.progress = progress;
        return crossValidate(
                   view, all, {}, Folds::byRandom(view.count, 3), 0, threads, report)[0]
            .rms;
      },
      2);
}

TEST(InterruptedWork, FurtherSamplesAndFields)
{
  const Ball ball;
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        Report report;
        report.progress = progress;
        return computeSphDensity(
            viewOf(ball.samples->cloud), {}, {0.0, 1.0}, threads, report);
      },
      2);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        Report report;
        report.progress = progress;
        Dataset dataset = *ball.samples;
        addOuterLayer(dataset, nullptr, "intensity", 0.0, threads, report);
        return dataset.cloud.data;
      },
      2);
}

TEST(InterruptedWork, Statistics)
{
  const Ball ball;
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        return describePositions(*ball.samples, {}, threads, progress).spacing_median;
      },
      2);
}

TEST(InterruptedWork, ClustersAndVoronoiDiagrams)
{
  const Ball ball;
  DensityClustering<Cloud> clustering;
  clustering.setInputCloud(ball.cloud);
  ClusteringParameters parameters;
  parameters.attributes = {"x", "intensity"};
  clustering.setParameters(parameters);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        clustering.setProgressCallback(progress);
        std::vector<int> labels;
        clustering.compute(labels);
        return labels;
      },
      2);
  VoronoiDiagram<Cloud> diagram;
  diagram.setInputCloud(ball.cloud);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        diagram.setProgressCallback(progress);
        return diagram.compute()->getNearest();
      },
      1);
}

TEST(InterruptedWork, NeighborsFromEverySource)
{
  const Ball ball;
  NaturalNeighbors<Cloud> neighbors;
  neighbors.setInputCloud(ball.cloud);
  for (const auto source :
       {NeighborSource::KdTree, NeighborSource::Voronoi, NeighborSource::Exact}) {
    neighbors.setNeighborSource(source);
    interruptEveryStep(
        [&](const ProgressCallback& progress) {
          neighbors.setProgressCallback(progress);
          NeighborGraph graph;
          neighbors.compute(graph);
          return std::pair(graph.offsets, graph.indices);
        },
        2);
  }
}

TEST(InterruptedWork, Gradients)
{
  GradientEstimation<pcl::PointXYZI> estimation;
  estimation.setInputCloud(uvol_test::makeRadialCloud(3000, 1).cloud);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        estimation.setProgressCallback(progress);
        pcl::PointCloud<PointGradient> gradients;
        estimation.compute(gradients);
        Cloud bytes;
        pcl::toPCLPointCloud2(gradients, bytes);
        return bytes.data;
      },
      2);
}

TEST(InterruptedWork, Memberships)
{
  const Ball ball;
  std::vector<int> labels(viewOf(*ball.cloud).count);
  std::fill(labels.begin(), labels.begin() + 1000, 1);
  ClusterMembership<Cloud> membership;
  membership.setInputCloud(ball.cloud);
  membership.setLabels(labels);
  MembershipParameters parameters;
  parameters.smoothing_length = "intensity";
  membership.setParameters(parameters);
  interruptEveryStep(
      [&](const ProgressCallback& progress) {
        membership.setProgressCallback(progress);
        std::vector<float> values;
        membership.compute(values);
        return values;
      },
      1);
}

} // namespace test_interrupted_work
