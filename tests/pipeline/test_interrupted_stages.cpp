// SPDX-License-Identifier: BSD-3-Clause
// What a progress callback throws at any step ends a run and leaves the stage fit for
// the next one; many runs take no more memory than a few.
#include "support/clouds.h"
#include "support/environment.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <malloc.h>
#include <set>
#include <stdexcept>

namespace {

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

class Interrupted : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** Interrupts a run at every step that it tells, at the step's first and last call. */
void
interruptEveryStep(const IsosurfacePipelineParameters& parameters,
                   const Samples& samples)
{
  IsosurfacePipeline pipeline;
  pipeline.setInput(samples.dataset);
  pipeline.setParameters(parameters);
  std::set<std::string> steps;
  pipeline.setProgressCallback(
      [&steps](const std::string& step, double) { steps.insert(step); });
  const auto whole = pipeline.run();
  EXPECT_LE(2u, steps.size());
  for (const std::string& step : steps)
    for (const double least : {0.0, 1.0}) {
      SCOPED_TRACE(step);
      pipeline.setInput(samples.dataset); // nothing is kept from the run before
      pipeline.setProgressCallback([&](const std::string& told, double done) {
        if (told == step && done >= least)
          throw Interrupted(step);
      });
      EXPECT_THROW(pipeline.run(), Interrupted);
      pipeline.setProgressCallback(nullptr);
      const auto again = pipeline.run();
      EXPECT_EQ(whole.surface.cloud.data, again.surface.cloud.data);
      EXPECT_EQ(whole.triangles.size(), again.triangles.size());
    }
}

TEST(InterruptedStages, EveryStepOfAnExtraction)
{
  const Samples samples(3000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  interruptEveryStep(parameters, samples);
}

TEST(InterruptedStages, EveryStepOfALevelSet)
{
  const Samples samples(3000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  parameters.smooth = true;
  parameters.level_set.mu = 0.5;
  parameters.level_set.max_steps = 10;
  interruptEveryStep(parameters, samples);
}

TEST(InterruptedStages, EveryStepOfAMesh)
{
  const Samples samples(3000);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {samples.isovalue};
  parameters.mesh.emplace();
  interruptEveryStep(parameters, samples);
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

} // namespace
