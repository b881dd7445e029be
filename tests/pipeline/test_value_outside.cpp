// SPDX-License-Identifier: BSD-3-Clause
// A field that ends outside of its samples: the pipeline closes its surface there.
#include "interpolation/outer_layer.h"
#include "pipeline/noisy_ball.h"
#include "pipeline/run_pipeline.h"
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace test_value_outside {

using pcl_uvol::Dataset;
using pcl_uvol::Interpolation;
using pcl_uvol::InvalidArgument;
using pcl_uvol::IsosurfacePipeline;
using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::IsosurfaceResult;
using uvol_test::findWarning;
using uvol_test::makeSamples;
using uvol_test::runPipeline;

/** A liquid of density 1 that fills a cube, from `first` on of the samples. */
std::shared_ptr<Dataset>
makeLiquid(std::size_t first = 0)
{
  auto samples = makeSamples();
  std::vector<float> density(samples->cloud.width, 1.0f);
  std::fill_n(density.begin(), first, 7.0f);
  setField(*samples, "density", density);
  return samples;
}

IsosurfacePipelineParameters
makeParameters()
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = "density";
  parameters.isosurface.isovalues = {0.5};
  parameters.outside_value = 0.0;
  return parameters;
}

TEST(ValueOutside, ClosesTheSurfaceAsTheLayerDoes)
{
  const auto samples = makeLiquid();
  IsosurfacePipelineParameters parameters = makeParameters();
  const IsosurfaceResult found = runPipeline(samples, parameters);
  EXPECT_EQ(Interpolation::Linear, found.interpolation);
  EXPECT_FALSE(findWarning(found, "fits_oscillate"));
  EXPECT_EQ(found.report.getCount("outer_samples") + samples->cloud.width,
            found.report.getCount("samples"));

  const auto closed = std::make_shared<Dataset>(*samples);
  pcl_uvol::Report report;
  addOuterLayer(*closed, nullptr, "density", 0.0, 1, report);
  parameters.outside_value.reset();
  parameters.isosurface.interpolation = Interpolation::Linear;
  const IsosurfaceResult expected = runPipeline(closed, parameters);
  EXPECT_GT(found.surface.cloud.width, 1000u);
  EXPECT_TRUE(expected.surface.cloud.data == found.surface.cloud.data);
}

/** Its points alone count, and tell where the samples end. */
TEST(ValueOutside, OfSomePoints)
{
  constexpr int first = 1500;
  const auto all = makeLiquid(first);
  IsosurfacePipeline pipeline;
  pipeline.setInput(all);
  const auto use = pcl::make_shared<pcl::Indices>();
  for (int i = first; i < static_cast<int>(all->cloud.width); ++i)
    use->push_back(i);
  pipeline.setIndices(use);
  pipeline.setParameters(makeParameters());
  const IsosurfaceResult found = pipeline.run();

  const auto some = std::make_shared<Dataset>(*all);
  auto& cloud = some->cloud;
  cloud.data.erase(cloud.data.begin(),
                   cloud.data.begin() +
                       static_cast<std::ptrdiff_t>(first) * cloud.point_step);
  cloud.width -= first;
  cloud.row_step = cloud.width * cloud.point_step;
  const IsosurfaceResult expected = runPipeline(some, makeParameters());
  EXPECT_GT(found.surface.cloud.width, 500u);
  EXPECT_TRUE(expected.surface.cloud.data == found.surface.cloud.data);
}

TEST(ValueOutside, FitsOscillateAtTheJump)
{
  const auto samples = makeLiquid();
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.isosurface.interpolation = Interpolation::Fit;
  EXPECT_TRUE(findWarning(runPipeline(samples, parameters), "fits_oscillate"));
  parameters = makeParameters();
  parameters.mesh.emplace();
  const IsosurfaceResult mesh = runPipeline(samples, parameters);
  EXPECT_TRUE(findWarning(mesh, "fits_oscillate"));
  EXPECT_EQ(Interpolation::Auto, mesh.interpolation);
  EXPECT_FALSE(mesh.triangles.empty());
}

/** Folds are parts of the closed samples, and get no layer of their own. */
TEST(ValueOutside, HoldOutTestsAreThoseOfTheClosedSamples)
{
  const auto samples = makeLiquid(), closed = std::make_shared<Dataset>(*samples);
  pcl_uvol::Report report;
  addOuterLayer(*closed, nullptr, "density", 0.0, 1, report);
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.validation.folds = 3;
  const auto found = runPipeline(samples, parameters).validation;
  parameters.outside_value.reset();
  parameters.isosurface.interpolation = Interpolation::Linear;
  const auto expected = runPipeline(closed, parameters).validation;
  ASSERT_EQ(1u, found.size());
  ASSERT_EQ(1u, expected.size());
  EXPECT_EQ(closed->cloud.width, found[0].tested);
  EXPECT_EQ(expected[0].tested, found[0].tested);
  EXPECT_EQ(expected[0].covered, found[0].covered);
  EXPECT_EQ(expected[0].side.predicted, found[0].side.predicted);
  EXPECT_EQ(expected[0].field.predicted, found[0].field.predicted);
}

TEST(ValueOutside, WhatGoesWithWhat)
{
  using Change = std::function<void(IsosurfacePipelineParameters&)>;
  for (const auto& [code, change] : std::vector<std::pair<std::string, Change>>{
           {"value_outside_not_finite", [](auto& p) { p.outside_value = INFINITY; }},
           {"gaps_beside_value_outside", [](auto& p) { p.fill_gaps = true; }},
           {"value_outside_of_periodic_box", [](auto& p) { p.periodic.fill(2.0); }},
           {"linear_with_fitted_normals",
            [](auto& p) { p.normals = pcl_uvol::NormalMethod::Fit; }}}) {
    IsosurfacePipelineParameters wrong = makeParameters();
    change(wrong);
    try {
      checkParameters(wrong);
      ADD_FAILURE() << code;
    }
    catch (const InvalidArgument& error) {
      EXPECT_EQ(code, error.asMessage().code);
    }
  }
  const IsosurfacePipelineParameters good = makeParameters();
  EXPECT_NO_THROW(checkParameters(good));
  EXPECT_EQ(good, IsosurfacePipelineParameters::fromJson(good.toJson()));
}

} // namespace test_value_outside
