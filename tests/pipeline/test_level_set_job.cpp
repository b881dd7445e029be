// SPDX-License-Identifier: BSD-3-Clause
// A level set from a data set: fields, scale, boxes and start shapes are found and
// warned of in one place, and phi is that of LevelSetEvolution.
#include "noisy_ball.h"
#include "pipeline/level_set_job.h"
#include "run_pipeline.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace test_level_set_job {

using namespace pcl_uvol;
using namespace uvol_test;

LevelSetRequest
makeRequest()
{
  LevelSetRequest request;
  request.level_set.isovalue = 0.0;
  request.level_set.mu = 0.5;
  request.level_set.max_steps = 10;
  return request;
}

SmoothedSamples
run(const std::shared_ptr<const Dataset>& samples,
    const LevelSetRequest& request,
    const SurfaceCallback& show_surface = {})
{
  return runLevelSet(samples, nullptr, request, show_surface, 2, {});
}

TEST(LevelSetJob, GivesThePhiOfTheEvolution)
{
  const auto samples = makeSamples();
  LevelSetRequest request = makeRequest();
  request.level_set.field.clear(); // intensity
  const SmoothedSamples smoothed = run(samples, request);
  EXPECT_EQ("intensity", smoothed.taken.field);
  EXPECT_EQ(samples->origin, smoothed.samples.origin);
  LevelSetEvolution<pcl::PCLPointCloud2> evolution;
  evolution.setInputCloud({samples, &samples->cloud});
  evolution.setParameters(makeRequest().level_set);
  evolution.setNumberOfThreads(1);
  std::vector<float> phi;
  evolution.evolve(phi);
  EXPECT_EQ(phi, readColumn(smoothed.samples, "phi"));
  EXPECT_EQ(evolution.getSummary().noise, smoothed.summary.noise);
}

TEST(LevelSetJob, TakesPointsAndReportsSurfaces)
{
  const auto samples = makeSamples();
  LevelSetRequest request = makeRequest();
  request.snapshots = 4;
  std::vector<std::size_t> steps;
  const pcl::IndicesPtr half(new pcl::Indices(2000));
  std::iota(half->begin(), half->end(), 1000);
  const SmoothedSamples smoothed =
      runLevelSet(samples,
                  half,
                  request,
                  [&](std::size_t done, const Dataset& surface) {
                    steps.push_back(done);
                    EXPECT_GT(surface.cloud.width, 100u);
                  },
                  2,
                  {});
  EXPECT_EQ((std::vector<std::size_t>{4, 8}), steps);
  EXPECT_EQ(2000u, smoothed.samples.cloud.width);
  EXPECT_EQ(readField(*samples, 1000, "second"),
            readField(smoothed.samples, 0, "second"));
}

/** Coordinates of shapes are those that the origin counts in. */
TEST(LevelSetJob, ShiftsShapesToTheOrigin)
{
  const auto samples = makeSamples();
  LevelSetRequest request = makeRequest();
  request.level_set.outside = Outside::Lower;
  request.level_set.initial = InitialFunction::sphere({1000.0, 0.0, -5.0}, 0.8);
  const auto there = readColumn(run(samples, request).samples, "phi");
  const auto here = std::make_shared<Dataset>(*samples);
  here->origin = {};
  request.level_set.initial = InitialFunction::sphere({0.0, 0.0, 0.0}, 0.8);
  EXPECT_EQ(there, readColumn(run(here, request).samples, "phi"));
}

/** The isosurface pipeline smooths by a list of its own, in turned axes as well. */
TEST(LevelSetJob, ShapesOfThePipelineCountFromTheOriginToo)
{
  const auto samples = makeSamples(), here = std::make_shared<Dataset>(*samples);
  here->origin = {};
  const auto smooth = [](const std::shared_ptr<Dataset>& from,
                         const Eigen::Array3d& center,
                         const Eigen::Array3d& rotation) {
    IsosurfacePipelineParameters parameters;
    parameters.isosurface.isovalues = {0.0};
    parameters.smooth = true;
    parameters.level_set = makeRequest().level_set;
    parameters.level_set.initial = InitialFunction::sphere(center, 0.8);
    parameters.rotation = rotation;
    const auto found = runPipeline(from, parameters);
    EXPECT_GT(found.surface.cloud.width, 500u);
    return found.surface.cloud.data;
  };
  for (const Eigen::Array3d& rotation :
       {Eigen::Array3d(0.0, 0.0, 0.0), Eigen::Array3d(30.0, 40.0, 0.0)})
    EXPECT_TRUE(smooth(here, {0.0, 0.0, 0.0}, rotation) ==
                smooth(samples, {1000.0, 0.0, -5.0}, rotation));
}

TEST(LevelSetJob, FindsTheScale)
{
  LevelSetRequest request = makeRequest();
  request.automatic_scale = true;
  const SmoothedSamples smoothed = run(makeSamples(), request);
  ASSERT_TRUE(smoothed.scale_choice);
  EXPECT_TRUE((smoothed.scale_choice->scale == smoothed.taken.scale).all());
  EXPECT_FALSE(run(makeSamples(), makeRequest()).scale_choice);
}

TEST(LevelSetJob, LeavesOutImagesOfABox)
{
  const auto samples = makeSamples();
  LevelSetRequest request = makeRequest();
  request.periodic = {{2.0, 2.0, 0.0}};
  const SmoothedSamples smoothed = run(samples, request);
  EXPECT_EQ(samples->cloud.width, smoothed.samples.cloud.width);
  EXPECT_GT(smoothed.report.getCount("images"), 100u);
  ASSERT_TRUE(smoothed.box);
  EXPECT_EQ(request.periodic, smoothed.box->sides);
  request.level_set.rotation = {10.0, 0.0, 0.0};
  try {
    run(samples, request);
    FAIL() << "the sides of the box lie along the axes";
  }
  catch (const InvalidArgument& error) {
    EXPECT_EQ("turned_periodic_box", error.asMessage().code);
  }
}

TEST(LevelSetJob, RefusesNamesAndNothing)
{
  const auto samples = std::make_shared<Dataset>(*makeSamples());
  samples->labels["second"] = {"one", "two"};
  LevelSetRequest request = makeRequest();
  request.level_set.field = "second";
  EXPECT_THROW(run(samples, request), InvalidArgument);
  request = makeRequest();
  request.level_set.initial = InitialFunction::field("second");
  EXPECT_THROW(run(samples, request), InvalidArgument);
}

} // namespace test_level_set_job
