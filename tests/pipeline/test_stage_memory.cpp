// SPDX-License-Identifier: BSD-3-Clause
// Stages refuse points that do not fit into memory before they begin, whoever runs
// them.
#include "common/memory.h"
#include "interpolation/sph_density.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/interpolation/field_interpolation.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cstdint>
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
    const pcl_uvol::Message& told = error.asMessage();
    std::fputs((told.code + ' ' + uvol_test::wordOf(told, "what") + ' ' +
                uvol_test::wordOf(told, "needed") + ' ' +
                uvol_test::wordOf(told, "available"))
                   .c_str(),
               stderr);
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
                "not_enough_memory " + task + " of 1000000 points [0-9]+ MB [0-9]+ MB");
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
              "not_enough_memory An isosurface of 1000000 points [0-9]+ MB [0-9]+ MB");
}

/** A stage that has less than it needs of a limit for the process. */
void
expectRefusalWithin(std::uint64_t left, const std::function<void()>& run)
{
  const pcl_uvol::MemoryLimit limit(pcl_uvol::residentMemory() + left);
  EXPECT_THROW(run(), pcl_uvol::NotEnoughMemory);
}

class StageMemoryWithinLimits : public testing::Test {
protected:
  StageMemoryWithinLimits()
  {
    pcl::toPCLPointCloud2(*makePoints(), samples_->cloud);
  }

  const std::shared_ptr<pcl_uvol::Dataset> samples_ =
      std::make_shared<pcl_uvol::Dataset>();
};

constexpr std::uint64_t little = 20000000;

TEST_F(StageMemoryWithinLimits, OfReading)
{
  const uvol_test::TemporaryFolder folder;
  const std::string path = folder / "in.pcd";
  pcl_uvol::saveDataset(path, *samples_);
  expectRefusalWithin(little / 2, [&] { pcl_uvol::loadDataset(path); });
}

TEST_F(StageMemoryWithinLimits, OfInterpolation)
{
  pcl_uvol::FieldInterpolation<pcl::PCLPointCloud2> stage;
  stage.setInputCloud({samples_, &samples_->cloud});
  pcl::PointCloud<pcl::PointXYZ> queries;
  queries.push_back({1.0f, 2.0f, 3.0f});
  pcl_uvol::InterpolatedFields result;
  expectRefusalWithin(little, [&] { stage.interpolate(queries, result); });
}

TEST_F(StageMemoryWithinLimits, OfQueries)
{
  pcl_uvol::FieldInterpolation<PointXYZI> stage;
  const pcl::PointCloud<PointXYZI>::Ptr corners(new pcl::PointCloud<PointXYZI>);
  for (int i = 0; i < 8; ++i) {
    PointXYZI corner;
    corner.x = static_cast<float>(i & 1);
    corner.y = static_cast<float>(i >> 1 & 1);
    corner.z = static_cast<float>(i >> 2);
    corner.intensity = corner.x;
    corners->push_back(corner);
  }
  stage.setInputCloud(corners);
  pcl::PointCloud<pcl::PointXYZ> queries;
  queries.resize(1000000);
  pcl_uvol::InterpolatedFields result;
  expectRefusalWithin(little, [&] { stage.interpolate(queries, result); });
}

TEST_F(StageMemoryWithinLimits, OfDerivatives)
{
  pcl_uvol::Report report;
  expectRefusalWithin(
      little, [&] { addDerivedField(*samples_, "|grad(intensity)|", {}, report); });
}

TEST_F(StageMemoryWithinLimits, OfDensities)
{
  pcl_uvol::Report report;
  expectRefusalWithin(little,
                      [&] { pcl_uvol::addSphDensity(*samples_, 2.0, 1, report); });
}

TEST_F(StageMemoryWithinLimits, OfPictures)
{
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud({samples_, &samples_->cloud});
  pcl_uvol::Image image;
  expectRefusalWithin(little, [&] { renderer.render(image); });
}

TEST_F(StageMemoryWithinLimits, OfRanks)
{
  pcl_uvol::SelfCommunicator alone;
  pcl_uvol::DistributedIsosurfacePipeline pipeline(alone);
  pipeline.setInput(samples_);
  pcl_uvol::IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {50.5};
  pipeline.setParameters(parameters);
  expectRefusalWithin(little, [&] { pipeline.run(); });
}

/** A limit ends with its scope, counts what is resident, and enough is enough. */
TEST_F(StageMemoryWithinLimits, EnoughIsNotRefused)
{
  const std::uint64_t resident = pcl_uvol::residentMemory();
  const auto left = [] { // what the heap gives back is no longer resident
    return pcl_uvol::availableMemory() + pcl_uvol::residentMemory();
  };
  {
    const pcl_uvol::MemoryLimit limit(resident + little);
    EXPECT_LE(left(), resident + 2 * little);
    {
      const pcl_uvol::MemoryLimit wider(resident + 10 * little);
      EXPECT_GT(left(), resident + 5 * little);
    }
    EXPECT_LE(left(), resident + 2 * little);
  }
  const pcl_uvol::MemoryLimit enough(resident + 1000000000);
  pcl_uvol::FieldInterpolation<pcl::PCLPointCloud2> stage;
  stage.setModel(pcl_uvol::InterpolationModel::Nearest);
  stage.setInputCloud({samples_, &samples_->cloud});
  pcl::PointCloud<pcl::PointXYZ> queries;
  queries.push_back({1.0f, 2.0f, 3.0f});
  pcl_uvol::InterpolatedFields result;
  EXPECT_NO_THROW(stage.interpolate(queries, result));
}

} // namespace test_stage_memory
