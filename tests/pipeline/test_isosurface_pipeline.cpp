// SPDX-License-Identifier: BSD-3-Clause
// The pipeline gives what its stages give one by one, in every combination.
#include "common/scalar_field.h"
#include "pipeline/memory_need.h"
#include "pipeline/noisy_ball.h"
#include "pipeline/run_pipeline.h"
#include "support/clouds.h"
#include "support/messages.h"
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_isosurface_pipeline {

using pcl_uvol::Dataset;
using pcl_uvol::Interpolation;
using pcl_uvol::InvalidArgument;
using pcl_uvol::IsosurfacePipeline;
using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::IsosurfaceResult;
using pcl_uvol::NormalMethod;
using uvol_test::makeParameters;
using uvol_test::makeSamples;
using uvol_test::readColumn;
using uvol_test::readField;

TEST(IsosurfacePipeline, CarriesFieldsOriginAndReport)
{
  const auto samples = makeSamples();
  const IsosurfaceResult result = uvol_test::runPipeline(samples, makeParameters());
  ASSERT_GT(result.surface.cloud.width, 300u);
  EXPECT_EQ(result.surface.cloud.width, result.edges.size());
  EXPECT_EQ(result.surface.cloud.width, result.report.getCount("isopoints"));
  EXPECT_EQ("intensity", result.field);
  EXPECT_EQ(samples->origin, result.surface.origin);
  EXPECT_TRUE(result.surface.double_coordinates);
  ASSERT_TRUE(result.errors);
  EXPECT_LE(result.errors->median, result.errors->percentile_95);
  EXPECT_LE(result.errors->percentile_95, result.errors->largest);
  for (std::size_t i = 0; i < result.edges.size(); i += 17) {
    const auto& edge = result.edges[i];
    const float a = readField(*samples, edge.first, "second"),
                b = readField(*samples, edge.second, "second");
    EXPECT_NEAR((1.0f - edge.t) * a + edge.t * b,
                readField(result.surface, i, "second"),
                1e-5f);
    EXPECT_EQ(0.0f, readField(result.surface, i, "isovalue"));
  }
}

TEST(IsosurfacePipeline, IsTheExtractionWithAllFields)
{
  const auto samples = makeSamples();
  pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(pcl::PCLPointCloud2::ConstPtr(samples, &samples->cloud));
  extraction.setIsoValue(0.0);
  pcl::PCLPointCloud2 alone;
  extraction.extract(alone);
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.normals = NormalMethod::Edge;
  parameters.isosurface.interpolation = Interpolation::Fit;
  const IsosurfaceResult result = uvol_test::runPipeline(samples, parameters);
  ASSERT_EQ(alone.fields.size(), result.surface.cloud.fields.size());
  EXPECT_EQ(alone.data, result.surface.cloud.data);
}

TEST(IsosurfacePipeline, OrientsAsTheParametersSay)
{
  const auto samples = makeSamples();
  for (const auto interpolation : {Interpolation::Linear, Interpolation::Fit}) {
    IsosurfacePipelineParameters parameters = makeParameters();
    parameters.isosurface.interpolation = interpolation;
    const auto normals = [&](NormalMethod method) {
      parameters.normals = method;
      return readColumn(uvol_test::runPipeline(samples, parameters).surface,
                        "normal_x");
    };
    const auto by_default = normals(NormalMethod::Auto);
    const auto pca = normals(NormalMethod::Pca), edge = normals(NormalMethod::Edge);
    EXPECT_NE(pca, edge);
    if (interpolation == Interpolation::Linear)
      EXPECT_EQ(pca, by_default);
    else
      EXPECT_EQ(normals(NormalMethod::Fit), by_default);
  }
}

/** Isopoints whose error is no more than half of their edge. */
std::size_t
countKnown(const IsosurfaceResult& result)
{
  const auto errors = readColumn(result.surface, "error");
  const auto edges = readColumn(result.surface, "edge_length");
  std::size_t known = 0;
  for (std::size_t i = 0; i < errors.size(); ++i)
    known += errors[i] <= 0.5f * edges[i];
  return known;
}

TEST(IsosurfacePipeline, DropsIsopointsWhoseErrorExceedsHalfTheirEdge)
{
  const auto samples = makeSamples();
  IsosurfacePipelineParameters parameters = makeParameters();
  for (const bool smooth : {false, true}) {
    parameters.smooth = smooth;
    parameters.automatic_max_error = false;
    const IsosurfaceResult all = uvol_test::runPipeline(samples, parameters);
    parameters.automatic_max_error = true;
    const IsosurfaceResult known = uvol_test::runPipeline(samples, parameters);
    EXPECT_EQ(countKnown(all), known.surface.cloud.width);
    EXPECT_EQ(all.surface.cloud.width - known.surface.cloud.width,
              known.report.getCount("removed_by_error"));
    EXPECT_GT(known.surface.cloud.width, 0.9 * all.surface.cloud.width);
  }
  // Isopoints on their edges have the errors that fits tell.
  parameters.smooth = false;
  parameters.isosurface.interpolation = Interpolation::Linear;
  const IsosurfaceResult linear = uvol_test::runPipeline(samples, parameters);
  EXPECT_GT(linear.surface.cloud.width, 0u);
  EXPECT_EQ(countKnown(linear), linear.surface.cloud.width);
  for (const auto& [count, value] : linear.report.counts)
    EXPECT_TRUE(count.find("_roots") == std::string::npos &&
                count.find("linear_") == std::string::npos)
        << count << " counts " << value << " fits that only told errors";
}

TEST(IsosurfacePipeline, LeavesOutWhatIsNotWanted)
{
  const auto samples = makeSamples();
  IsosurfacePipelineParameters parameters = makeParameters();
  const IsosurfaceResult all = uvol_test::runPipeline(samples, parameters);
  parameters.max_error = all.errors->median;
  const IsosurfaceResult some = uvol_test::runPipeline(samples, parameters);
  EXPECT_GT(some.surface.cloud.width, all.surface.cloud.width / 3);
  EXPECT_EQ(all.surface.cloud.width,
            some.surface.cloud.width + some.report.getCount("removed_by_error"));
  EXPECT_LE(some.errors->largest, static_cast<float>(*parameters.max_error));
  parameters.max_error.reset();
  parameters.automatic_max_error = true;
  EXPECT_EQ(countKnown(all),
            uvol_test::runPipeline(samples, parameters).surface.cloud.width);
  parameters.automatic_max_error = false;
  parameters.drop_bridged = true;
  const IsosurfaceResult measured = uvol_test::runPipeline(samples, parameters);
  EXPECT_EQ(all.report.getCount("bridged"),
            measured.report.getCount("removed_bridged"));
  for (const float support : readColumn(measured.surface, "support"))
    EXPECT_NE(2.0f, support);
}

TEST(IsosurfacePipeline, CountsTheSupportOfWhatIsLeft)
{
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.automatic_max_error = parameters.drop_bridged = true;
  const IsosurfaceResult left = uvol_test::runPipeline(makeSamples(), parameters);
  const std::vector<float> supports = readColumn(left.surface, "support");
  EXPECT_EQ(0u, left.report.getCount("bridged"));
  EXPECT_EQ(
      static_cast<std::uint64_t>(std::count(supports.begin(), supports.end(), 3.0f)),
      left.report.getCount("rim"));
}

TEST(IsosurfacePipeline, SaysWhereLittleIsLeft)
{
  IsosurfacePipelineParameters parameters = makeParameters();
  const auto samples = makeSamples();
  const IsosurfaceResult all = uvol_test::runPipeline(samples, parameters);
  std::vector<float> errors = readColumn(all.surface, "error");
  std::sort(errors.begin(), errors.end());
  const auto findWarning = [&](double share) {
    parameters.max_error =
        errors[static_cast<std::size_t>(share * static_cast<double>(errors.size()))];
    return uvol_test::findWarning(uvol_test::runPipeline(samples, parameters),
                                  "few_isopoints_left");
  };
  const auto told = findWarning(0.05);
  ASSERT_TRUE(told);
  EXPECT_EQ(1.0, uvol_test::numberOf(*told, "by_error"));
  EXPECT_LT(uvol_test::numberOf(*told, "left"),
            0.1 * uvol_test::numberOf(*told, "isopoints"));
  EXPECT_FALSE(findWarning(0.2));
}

TEST(IsosurfacePipeline, SmoothsAsTheLevelSetAlone)
{
  const auto samples = makeSamples();
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.isosurface.isovalues = {0.0, 0.1};
  parameters.smooth = true;
  parameters.level_set.mu = 0.5;
  parameters.level_set.max_steps = 20;
  const IsosurfaceResult result = uvol_test::runPipeline(samples, parameters);
  ASSERT_EQ(2u, result.level_sets.size());
  EXPECT_GE(20u, result.level_sets[1].steps.size());
  const auto isovalues = readColumn(result.surface, "isovalue");
  EXPECT_EQ(0.0f, isovalues.front());
  EXPECT_EQ(0.1f, isovalues.back());

  pcl_uvol::LevelSetEvolution<pcl::PCLPointCloud2> evolution;
  evolution.setInputCloud(pcl::PCLPointCloud2::ConstPtr(samples, &samples->cloud));
  evolution.setIsoValue(0.1);
  evolution.setMu(0.5);
  evolution.setMaximumSteps(20);
  auto with_phi = std::make_shared<Dataset>();
  evolution.evolve(with_phi->cloud);
  IsosurfacePipelineParameters of_phi = makeParameters();
  of_phi.isosurface.field = "phi";
  of_phi.isosurface.interpolation = Interpolation::Fit; // as with a level set
  const auto second = readColumn(uvol_test::runPipeline(with_phi, of_phi).surface, "x");
  const auto both = readColumn(result.surface, "x");
  ASSERT_LT(second.size(), both.size());
  EXPECT_EQ(second,
            std::vector<float>(both.end() - static_cast<std::ptrdiff_t>(second.size()),
                               both.end()));
}

TEST(IsosurfacePipeline, ReportsItsInput)
{
  IsosurfacePipeline pipeline;
  EXPECT_EQ(nullptr, pipeline.getInput());
  EXPECT_EQ(nullptr, pipeline.getIndices());
  const auto samples = makeSamples();
  const auto indices = std::make_shared<pcl::Indices>(10, 0);
  pipeline.setInput(samples);
  pipeline.setIndices(indices);
  EXPECT_EQ(samples, pipeline.getInput());
  EXPECT_EQ(indices, pipeline.getIndices());
}

TEST(IsosurfacePipeline, ReusesTheTreeForFurtherIsovalues)
{
  const auto samples = makeSamples();
  IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  for (const double isovalue : {0.0, 0.2}) {
    pipeline.setParameters(makeParameters(isovalue));
    const IsosurfaceResult again = pipeline.run();
    EXPECT_EQ(
        uvol_test::runPipeline(samples, makeParameters(isovalue)).surface.cloud.data,
        again.surface.cloud.data);
    const auto& steps = again.report.milliseconds;
    EXPECT_EQ(isovalue == 0.0,
              std::any_of(steps.begin(), steps.end(), [](const auto& step) {
                return step.first == "tree";
              }));
  }
}

TEST(IsosurfacePipeline, KeepsIsovaluesThatFloatDoesNotHold)
{
  for (const double unit : {3e50, 3e-60}) {
    const auto samples = std::make_shared<Dataset>(*makeSamples());
    std::vector<double> values;
    for (const float value : readColumn(*samples, "intensity"))
      values.push_back(unit * (2.0 + value));
    pcl_uvol::setField(*samples, "intensity", values);
    IsosurfacePipelineParameters parameters = makeParameters(2.0 * unit);
    const IsosurfaceResult one = uvol_test::runPipeline(samples, parameters);
    EXPECT_TRUE(one.report.warnings.empty());
    const pcl_uvol::CloudView view = pcl_uvol::viewOf(one.surface.cloud);
    const pcl_uvol::ScalarField isovalue(view.fields, "isovalue");
    ASSERT_GT(view.count, 300u);
    for (std::size_t i = 0; i < view.count; ++i)
      EXPECT_EQ(2.0 * unit, isovalue.read(view.point(i)));
    // Two that float takes for one.
    parameters.isosurface.isovalues = {2.0 * unit, 2.1 * unit};
    EXPECT_EQ(std::vector<std::string>{"equal_isovalues"},
              uvol_test::listCodes(
                  uvol_test::runPipeline(samples, parameters).report.warnings));
  }
}

TEST(IsosurfacePipeline, NoticesWhatWasChangedInPlace)
{
  const auto samples = std::make_shared<Dataset>(*makeSamples());
  for (const bool smooth : {false, true}) {
    IsosurfacePipelineParameters parameters = makeParameters();
    parameters.smooth = smooth;
    parameters.level_set.max_steps = 5;
    IsosurfacePipeline pipeline;
    pipeline.setInput(samples);
    pipeline.setParameters(parameters);
    const auto before = pipeline.run().surface.cloud.data;
    for (std::size_t i = 0; i < samples->cloud.width; i += 2)
      samples->cloud.data[i * samples->cloud.point_step + 3] ^= 0x80; // the sign of x
    const auto after = pipeline.run().surface.cloud.data;
    EXPECT_NE(before, after);
    EXPECT_EQ(uvol_test::runPipeline(samples, parameters).surface.cloud.data, after);
  }
}

TEST(IsosurfacePipeline, TakesTheIndices)
{
  const auto samples = makeSamples();
  const auto half = pcl::make_shared<pcl::Indices>();
  for (int i = 0; i < 4000; i += 2)
    half->push_back(i);
  for (const bool smooth : {false, true}) {
    IsosurfacePipelineParameters parameters = makeParameters();
    parameters.smooth = smooth;
    parameters.level_set.max_steps = 5;
    IsosurfacePipeline pipeline;
    pipeline.setInput(samples);
    pipeline.setIndices(half);
    pipeline.setParameters(parameters);
    const IsosurfaceResult result = pipeline.run();
    EXPECT_EQ(2000u, pipeline.getReport().getCount("samples"));
    for (const auto& edge : result.edges)
      EXPECT_EQ(0u, (edge.first | edge.second) % 2);
    pipeline.setIndices(nullptr);
    EXPECT_EQ(uvol_test::runPipeline(samples, parameters).surface.cloud.data,
              pipeline.run().surface.cloud.data);
  }
}

TEST(IsosurfacePipeline, DoesNotDependOnThreads)
{
  const auto samples = makeSamples();
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.smooth = true;
  parameters.level_set.max_steps = 10;
  const auto one = uvol_test::runPipeline(samples, parameters, 1).surface.cloud.data;
  for (const unsigned threads : {2u, 5u})
    EXPECT_EQ(one,
              uvol_test::runPipeline(samples, parameters, threads).surface.cloud.data);
}

TEST(IsosurfacePipeline, WarnsOfReplacedFields)
{
  const auto samples = makeSamples();
  pcl_uvol::setField(*samples, "error", std::vector<float>(4000, 1.0f));
  const auto result = uvol_test::runPipeline(samples, makeParameters());
  ASSERT_EQ(1u, result.report.warnings.size());
  EXPECT_EQ("replaced_field", result.report.warnings[0].code);
  EXPECT_EQ("error", uvol_test::wordOf(result.report.warnings[0], "field"));
}

TEST(IsosurfacePipeline, ForecastsItsMemory)
{
  IsosurfacePipeline pipeline;
  EXPECT_THROW(pipeline.estimateMemory(), InvalidArgument); // without an input
  pipeline.setInput(makeSamples());
  pipeline.setParameters(makeParameters());
  const double plain = pipeline.estimateMemory();
  EXPECT_GT(plain, 50.0 * 4000);
  EXPECT_LT(plain, 1000.0 * 4000);
  using Parameters = IsosurfacePipelineParameters;
  const auto expect_more = [&](const std::string& name, auto change) {
    Parameters parameters = makeParameters();
    change(parameters);
    pipeline.setParameters(parameters);
    EXPECT_GT(pipeline.estimateMemory(), 1.05 * plain) << name;
  };
  expect_more("smooth", [](Parameters& p) { p.smooth = true; });
  expect_more("mesh", [](Parameters& p) { p.mesh.emplace(); });
  expect_more("periodic", [](Parameters& p) { p.periodic = {1.0, 1.0, 1.0}; });
  expect_more("gaps", [](Parameters& p) { p.fill_gaps = true; });
  expect_more("turned", [](Parameters& p) { p.rotation = {0.1, 0.0, 0.0}; });
  expect_more("folds", [](Parameters& p) { p.validation.folds = 5; });
  expect_more("isovalues", [](Parameters& p) { p.isosurface.isovalues = {0.1, 0.2}; });
  expect_more("exact", [](Parameters& p) {
    p.isosurface.neighbors = pcl_uvol::NeighborSource::Exact;
  });
}

TEST(IsosurfacePipeline, RefusesWhatItCannotDo)
{
  const auto samples = makeSamples(100);
  EXPECT_THROW(uvol_test::runPipeline(nullptr, makeParameters()), InvalidArgument);
  EXPECT_THROW(uvol_test::runPipeline(samples, IsosurfacePipelineParameters()),
               InvalidArgument);
  const auto expect_bad = [&](auto change) {
    IsosurfacePipelineParameters parameters = makeParameters();
    change(parameters);
    EXPECT_THROW(uvol_test::runPipeline(samples, parameters), InvalidArgument);
  };
  using Parameters = IsosurfacePipelineParameters;
  expect_bad([](Parameters& p) { p.isosurface.field = "nothing"; });
  expect_bad([](Parameters& p) { p.isosurface.scale = {1.0f, 0.0f, 1.0f}; });
  expect_bad([](Parameters& p) { p.normal_neighbors = 1; });
  expect_bad([](Parameters& p) { p.max_error = -1.0; });
  expect_bad([](Parameters& p) { p.max_error = std::nan(""); });
  expect_bad([](Parameters& p) {
    p.max_error = 1.0;
    p.automatic_max_error = true;
  });
  expect_bad([](Parameters& p) {
    p.isosurface.interpolation = Interpolation::Linear;
    p.normals = NormalMethod::Fit;
  });
}

/** What a callback throws ends the run, and the next one is whole. */
TEST(IsosurfacePipeline, IsEndedByItsProgress)
{
  const auto samples = makeSamples();
  IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(makeParameters());
  pipeline.setProgressCallback(
      [](const std::string&, double) { throw std::runtime_error("enough"); });
  EXPECT_THROW(pipeline.run(), std::runtime_error);
  pipeline.setProgressCallback(nullptr);
  EXPECT_EQ(uvol_test::runPipeline(samples, makeParameters()).surface.cloud.data,
            pipeline.run().surface.cloud.data);
}

} // namespace test_isosurface_pipeline
