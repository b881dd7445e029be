// SPDX-License-Identifier: BSD-3-Clause
// Stages refuse points that do not fit into memory before they begin, whoever runs
// them.
#include "common/memory.h"
#include "support/environment.h"
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <sys/resource.h>
#include <vector>

namespace test_stage_memory {

using pcl::PointXYZI;

pcl::PointCloud<PointXYZI>::Ptr
makePoints()
{
  const pcl::PointCloud<PointXYZI>::Ptr points(new pcl::PointCloud<PointXYZI>);
  points->resize(1000000);
  for (std::size_t i = 0; i < points->size(); ++i) {
    (*points)[i].x = static_cast<float>(i % 100);
    (*points)[i].y = static_cast<float>(i / 100 % 100);
    (*points)[i].z = static_cast<float>(i / 10000);
    (*points)[i].intensity = (*points)[i].x;
  }
  return points;
}

/** Leave 42 MB to the process, run, and exit with 0 where that is refused in figures.
 */
void
runShortOfMemory(const std::function<void()>& run)
{
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  constexpr rlim_t left = 42000000, step = 1000000; // level sets take 44 MB first
  limit.rlim_cur = left;
  do { // the least limit that leaves so much
    limit.rlim_cur += step;
    setrlimit(RLIMIT_DATA, &limit);
  } while (pcl_uvol::availableMemory() < left);
  try {
    run();
  }
  catch (const pcl_uvol::NotEnoughMemory& error) {
    std::fputs(error.message().c_str(), stderr);
    std::_Exit(0);
  }
  catch (...) {
  }
  std::_Exit(1);
}

class StageMemory : public testing::Test {
protected:
  void
  SetUp() override
  {
    if (uvol_test::isSanitized())
      GTEST_SKIP() << "Sanitizers map terabytes.";
  }

  template <typename Stage>
  void
  expectRefusal(const std::string& task,
                const std::function<void(Stage&)>& compute) const
  {
    EXPECT_EXIT(runShortOfMemory([&] {
                  Stage stage;
                  stage.setInputCloud(points_);
                  stage.setNumberOfThreads(1);
                  compute(stage);
                }),
                testing::ExitedWithCode(0),
                task + " of 1000000 points needs [0-9]+ MB of memory, and only [0-9]+ "
                       "MB are available");
  }

  const pcl::PointCloud<PointXYZI>::Ptr points_ = makePoints();
};

TEST_F(StageMemory, IsCheckedBeforeNormals)
{
  expectRefusal<pcl_uvol::SurfaceNormalEstimation<PointXYZI, pcl::PointNormal>>(
      "Estimating normals", [](auto& stage) {
        pcl::PointCloud<pcl::PointNormal> normals;
        stage.compute(normals);
      });
}

TEST_F(StageMemory, IsCheckedBeforeSplats)
{
  expectRefusal<pcl_uvol::SplatGeneration<PointXYZI>>("Making splats", [](auto& stage) {
    pcl::PointCloud<pcl_uvol::PointSplat> splats;
    stage.compute(splats);
  });
}

TEST_F(StageMemory, IsCheckedBeforeClusters)
{
  expectRefusal<pcl_uvol::DensityClustering<PointXYZI>>("Clustering", [](auto& stage) {
    std::vector<int> labels;
    stage.setAttributes({"intensity"});
    stage.compute(labels);
  });
}

TEST_F(StageMemory, IsCheckedBeforeLevelSets)
{
  expectRefusal<pcl_uvol::LevelSetEvolution<PointXYZI>>("A level set", [](auto& stage) {
    std::vector<float> phi;
    stage.setIsoValue(50.5);
    stage.evolve(phi);
  });
}

TEST_F(StageMemory, IsCheckedBeforeIsosurfaces)
{
  const auto samples = std::make_shared<pcl_uvol::Dataset>();
  pcl::toPCLPointCloud2(*points_, samples->cloud);
  EXPECT_EXIT(runShortOfMemory([&] {
                pcl_uvol::IsosurfacePipeline pipeline;
                pipeline.setInput(samples);
                pcl_uvol::IsosurfacePipelineParameters parameters;
                parameters.isosurface.isovalues = {50.5};
                pipeline.setParameters(parameters);
                pipeline.run();
              }),
              testing::ExitedWithCode(0),
              "An isosurface of 1000000 points needs [0-9]+ MB of memory, and only");
}

} // namespace test_stage_memory
