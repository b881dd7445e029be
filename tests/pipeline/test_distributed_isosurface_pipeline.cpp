// SPDX-License-Identifier: BSD-3-Clause
// The pipeline of several ranks gives what that of one process gives.
#include "common/memory.h"
#include "common/records.h"
#include "distributed/merge_reports.h"
#include "distributed/run_stage.h"
#include "pipeline/run_pipeline.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/messages.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <atomic>
#include <mutex>
#include <set>
#include <string>

namespace test_distributed_isosurface_pipeline {

using pcl_uvol::Dataset;
using pcl_uvol::DistributedIsosurfacePipeline;
using pcl_uvol::InvalidArgument;
using pcl_uvol::IsosurfacePipelineParameters;

/** Samples from first to last. */
std::shared_ptr<Dataset>
takePart(const pcl::PointCloud<pcl::PointXYZI>& cloud,
         std::size_t first,
         std::size_t last)
{
  pcl::PointCloud<pcl::PointXYZI> part;
  for (std::size_t i = first; i < last; ++i)
    part.push_back(cloud[i]);
  auto dataset = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(part, dataset->cloud);
  return dataset;
}

IsosurfacePipelineParameters
makeParameters()
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = "intensity";
  parameters.isosurface.isovalues = {0.4, 0.5};
  parameters.isosurface.interpolation = pcl_uvol::Interpolation::Fit; // that of ranks
  return parameters;
}

TEST(DistributedIsosurfacePipeline, GathersTheSurfaceOfOneProcess)
{
  const auto cloud = uvol_test::makeCloud("uniform", 3000, 4);
  IsosurfacePipelineParameters alone = makeParameters();
  alone.normals = pcl_uvol::NormalMethod::Edge;
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(takePart(*cloud, 0, cloud->size()));
  pipeline.setParameters(alone);
  const auto expected = pipeline.run();
  ASSERT_GT(expected.surface.cloud.width, 100u);

  for (const std::size_t ranks : {1u, 3u}) {
    std::mutex mutex;
    std::size_t isopoints = 0;
    uvol_test::runRanks(ranks, [&](pcl_uvol::Communicator& communicator) {
      const std::size_t rank = communicator.rank(), size = cloud->size();
      DistributedIsosurfacePipeline distributed(communicator);
      distributed.setInput(
          takePart(*cloud, rank * size / ranks, (rank + 1) * size / ranks));
      distributed.setParameters(makeParameters());
      distributed.setGathered(true);
      const auto found = distributed.run();
      distributed.setGathered(false);
      const auto part = distributed.run();
      const std::lock_guard lock(mutex);
      isopoints += part.surface.cloud.width;
      if (rank == 0)
        EXPECT_EQ(found.surface.cloud.data, expected.surface.cloud.data);
      else
        EXPECT_EQ(found.surface.cloud.width, 0u);
    });
    EXPECT_EQ(isopoints, expected.surface.cloud.width) << ranks;
  }
}

/** Ranks with more and fewer spikes than others say one sentence, that of one process.
 */
TEST(DistributedIsosurfacePipeline, WarnsOfWhatAllCountTogether)
{
  const auto cloud = uvol_test::makeCloud("uniform", 3000, 4);
  for (std::size_t i = 0; i < cloud->size(); i += i < 1500 ? 20 : 100)
    (*cloud)[i].intensity = 1e6f;
  IsosurfacePipelineParameters parameters = makeParameters();
  parameters.max_error = 1e-30f;
  const auto warningsOf = [&](std::size_t ranks) {
    std::mutex mutex;
    std::set<std::string> warnings;
    uvol_test::runRanks(ranks, [&](pcl_uvol::Communicator& communicator) {
      const std::size_t rank = communicator.rank(), size = cloud->size();
      DistributedIsosurfacePipeline distributed(communicator);
      distributed.setInput(
          takePart(*cloud, rank * size / ranks, (rank + 1) * size / ranks));
      distributed.setParameters(parameters);
      const auto found = distributed.run();
      const std::lock_guard lock(mutex);
      for (const pcl_uvol::Message& warning : found.report.warnings)
        if (warning.code == "spikes" || warning.code == "no_isopoints_left")
          warnings.insert(warning.text());
    });
    return warnings;
  };
  const auto expected = warningsOf(1);
  EXPECT_EQ(2u, expected.size());
  EXPECT_EQ(expected, warningsOf(3));
}

/** Lines of 200 samples through a cube, at random. */
pcl::PointCloud<pcl::PointXYZI>
makeLines(std::size_t count)
{
  uvol_test::Random random(11);
  const auto choosePlace = [&] {
    const auto x = static_cast<float>(random.uniform()),
               y = static_cast<float>(random.uniform()),
               z = static_cast<float>(random.uniform());
    return Eigen::Array3f(x, y, z);
  };
  pcl::PointCloud<pcl::PointXYZI> lines;
  for (std::size_t line = 0; line < count; ++line) {
    const Eigen::Array3f begin = choosePlace(), end = choosePlace();
    for (int i = 0; i < 200; ++i) {
      const Eigen::Array3f at = begin + (end - begin) * static_cast<float>(i) / 200.0f;
      lines.push_back({at[0], at[1], at[2], (9.0f * at).sin().sum()});
    }
  }
  return lines;
}

/** Ranks whose parts of the surface lie between more and between fewer lines say what
 * one process says of all of it. */
TEST(DistributedIsosurfacePipeline, ReportsWeakSupportAsOneProcessDoes)
{
  const auto lines = makeLines(120);
  for (const bool is_linear : {true, false}) {
    IsosurfacePipelineParameters parameters = makeParameters();
    parameters.isosurface.isovalues = {0.0, 0.3};
    if (is_linear)
      parameters.isosurface.interpolation = pcl_uvol::Interpolation::Linear;
    parameters.normals = pcl_uvol::NormalMethod::Edge;
    const auto expected =
        uvol_test::runPipeline(takePart(lines, 0, lines.size()), parameters).report;
    EXPECT_EQ(is_linear ? 2048u : 0u, expected.getCount("examined"));
    ASSERT_EQ(1u, expected.warnings.size());
    EXPECT_EQ("unconstrained_isopoints", expected.warnings[0].code);
    EXPECT_GE(uvol_test::numberOf(expected.warnings[0], "percent"), 50.0);
    uvol_test::runRanks(3, [&](pcl_uvol::Communicator& communicator) {
      const std::size_t rank = communicator.rank(), size = lines.size();
      DistributedIsosurfacePipeline pipeline(communicator);
      pipeline.setInput(takePart(lines, rank * size / 3, (rank + 1) * size / 3));
      pipeline.setParameters(parameters);
      pipeline.setGathered(is_linear);
      const auto found = pcl_uvol::mergeReports(pipeline.run().report, communicator);
      EXPECT_EQ(expected.warnings, found.warnings);
      for (const char* const name :
           {"examined", "examined_bridged", "examined_rim", "bridged", "rim"})
        EXPECT_EQ(expected.getCount(name), found.getCount(name)) << name;
    });
  }
}

TEST(DistributedIsosurfacePipeline, RefusesWhatNeedsAllSamples)
{
  const auto cloud = uvol_test::makeCloud("uniform", 300, 4);
  uvol_test::runRanks(1, [&](pcl_uvol::Communicator& communicator) {
    DistributedIsosurfacePipeline pipeline(communicator);
    EXPECT_THROW(pipeline.run(), InvalidArgument); // no input
    pipeline.setInput(takePart(*cloud, 0, cloud->size()));
    for (int what = 0; what < 3; ++what) {
      IsosurfacePipelineParameters parameters = makeParameters();
      parameters.automatic_scale = what == 0;
      parameters.smooth = what == 1;
      if (what == 2)
        parameters.normals = pcl_uvol::NormalMethod::Pca;
      pipeline.setParameters(parameters);
      EXPECT_THROW(pipeline.run(), InvalidArgument) << what;
    }
  });
}

/** One process that has too little memory leaves no other one waiting. */
TEST(DistributedIsosurfacePipeline, AllProcessesRefuseTogether)
{
  std::atomic<int> refused{0};
  uvol_test::runRanks(3, [&](pcl_uvol::Communicator& communicator) {
    const double bytes = communicator.rank() == 1 ? 1e18 : 1.0;
    try {
      pcl_uvol::checkMemoryTogether("A part", 7, bytes, communicator);
    }
    catch (const pcl_uvol::NotEnoughMemory& error) {
      const bool is_own = communicator.rank() == 1;
      EXPECT_EQ(is_own ? "not_enough_memory" : "memory_of_other_processes",
                error.asMessage().code);
      ++refused;
    }
    EXPECT_NO_THROW(pcl_uvol::checkMemoryTogether("A part", 7, 1.0, communicator));
  });
  EXPECT_EQ(3, refused);
}

} // namespace test_distributed_isosurface_pipeline
