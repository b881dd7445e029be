// SPDX-License-Identifier: BSD-3-Clause
// What a progress callback throws at any step ends a run and leaves the stage fit for
// the next one; many runs take no more memory than a few.
#include "support/clouds.h"
#include "support/environment.h"
#include "support/interruption.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <malloc.h>
#include <utility>

namespace test_interrupted_stages {

using pcl_uvol::IsosurfacePipeline;
using pcl_uvol::IsosurfacePipelineParameters;

/** Samples of the radial test, and the isovalue of its sphere. */
struct Samples {
  std::shared_ptr<pcl_uvol::Dataset> dataset = std::make_shared<pcl_uvol::Dataset>();
  double isovalue;

  explicit Samples(std::size_t count)
  {
    const auto radial = uvol_test::makeRadialCloud(count, 1);
    pcl::toPCLPointCloud2(*radial.cloud, dataset->cloud);
    isovalue = radial.radius;
  }
};

void
interruptPipeline(const IsosurfacePipelineParameters& parameters,
                  const Samples& samples)
{
  IsosurfacePipeline pipeline;
  pipeline.setParameters(parameters);
  uvol_test::interruptEveryStep(
      [&](const pcl_uvol::ProgressCallback& progress) {
        pipeline.setInput(samples.dataset); // nothing is kept from the run before
        pipeline.setProgressCallback(progress);
        const auto result = pipeline.run();
        return std::pair(result.surface.cloud.data, result.triangles.size());
      },
      2);
}

TEST(InterruptedStages, EveryStepOfAnExtraction)
{
  const Samples samples(3000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  interruptPipeline(parameters, samples);
}

TEST(InterruptedStages, EveryStepOfALevelSet)
{
  const Samples samples(3000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  parameters.smooth = true;
  parameters.level_set.mu = 0.5;
  parameters.level_set.max_steps = 10;
  interruptPipeline(parameters, samples);
}

TEST(InterruptedStages, EveryStepOfAMesh)
{
  const Samples samples(3000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  parameters.mesh.emplace();
  interruptPipeline(parameters, samples);
}

TEST(InterruptedStages, EveryStepOfAValidation)
{
  const Samples samples(2000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  parameters.validation.folds = 2;
  interruptPipeline(parameters, samples);
}

TEST(InterruptedStages, EveryStepOfFilledGaps)
{
  const Samples samples(2000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  parameters.fill_gaps = true;
  parameters.automatic_scale = false;
  interruptPipeline(parameters, samples);
}

TEST(InterruptedStages, EveryStepInABoxThatRepeats)
{
  const Samples samples(2000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  parameters.periodic.setConstant(20.0);
  interruptPipeline(parameters, samples);
}

TEST(ManyExtractions, LeaveMemoryWhereItWas)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "a sanitizer keeps what is freed";
  const Samples samples(500);
  const auto extract = [&samples](std::size_t runs) {
    for (std::size_t i = 0; i < runs; ++i) {
      pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
      extraction.setInputCloud(
          pcl::PCLPointCloud2::ConstPtr(samples.dataset, &samples.dataset->cloud));
      extraction.setIsoValue(samples.isovalue);
      pcl::PointCloud<pcl_uvol::PointIso> isopoints;
      extraction.extract(isopoints);
      ASSERT_LT(0u, isopoints.size());
    }
  };
  const auto used = [] {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  extract(50); // threads and tables that stay
  const std::size_t before = used();
  extract(1000);
  constexpr std::size_t room = 64 << 10; // less than 65 bytes per run
  EXPECT_LT(used(), before + room);
}

} // namespace test_interrupted_stages
