// SPDX-License-Identifier: BSD-3-Clause
// Errors after smoothing: of where the surface is, not of how well fits follow phi.
#include "pipeline/run_pipeline.h"
#include "pipeline/zero_level.h"
#include "support/messages.h"
#include "support/noisy_shapes.h"
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace test_level_set_errors {

using namespace pcl_uvol;
using Surface = pcl::PointCloud<PointIso>;

constexpr double noise = 0.3;

uvol_test::NoisyCloud
makeSphere()
{
  return uvol_test::makeNoisyCloud(uvol_test::makeSmallShape("sphere", 7.0), noise, 1);
}

IsosurfacePipelineParameters
makeParameters(const std::optional<double>& mu)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {0.0};
  parameters.smooth = true;
  parameters.level_set.mu = mu;
  return parameters;
}

/** \param factor of all coordinates
 * \param stretch of z, which the scale undoes */
Surface
smooth(const uvol_test::NoisyCloud& noisy,
       IsosurfacePipelineParameters parameters,
       float factor = 1.0f,
       float stretch = 1.0f,
       unsigned threads = 0)
{
  pcl::PointCloud<pcl::PointXYZI> cloud = *noisy.cloud;
  for (auto& point : cloud) {
    point.getVector3fMap() *= factor;
    point.z *= stretch;
  }
  parameters.isosurface.scale = {1.0f, 1.0f, 1.0f / stretch};
  const auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  Surface surface;
  pcl::fromPCLPointCloud2(
      uvol_test::runPipeline(samples, parameters, threads).surface.cloud, surface);
  return surface;
}

/** The share of the deviations that errors cover, and the median of error over
 * deviation: a tenth may be left, and more than 6 is no estimate. */
void
expectErrorsOfTheSurface(const uvol_test::NoisyCloud& noisy,
                         const Surface& surface,
                         float stretch = 1.0f)
{
  std::vector<double> ratios;
  for (const PointIso& point : surface) {
    // A length of the samples' space is as much longer here as the normal is there.
    const Eigen::Vector3d x(point.x, point.y, point.z / stretch);
    const Eigen::Vector3d normal = point.getNormalVector3fMap().cast<double>();
    const double across =
        Eigen::Vector3d(normal[0], normal[1], stretch * normal[2]).norm();
    const double deviation = std::abs(noisy.shape.distance(x)) * across;
    ratios.push_back(point.error / std::max(deviation, 1e-12));
  }
  ASSERT_GT(ratios.size(), 1000u);
  const auto covered =
      std::count_if(ratios.begin(), ratios.end(), [](double r) { return r >= 1.0; });
  EXPECT_GT(static_cast<double>(covered), 0.9 * static_cast<double>(ratios.size()));
  std::nth_element(ratios.begin(),
                   ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2),
                   ratios.end());
  EXPECT_GT(ratios[ratios.size() / 2], 1.0);
  EXPECT_LT(ratios[ratios.size() / 2], 6.0);
}

TEST(LevelSetErrors, CoverDeviationsForEveryWeight)
{
  const auto noisy = makeSphere();
  for (const std::optional<double>& mu :
       {std::optional<double>(), std::optional<double>(0.5), std::optional(0.15)}) {
    SCOPED_TRACE(mu.value_or(-1.0));
    expectErrorsOfTheSurface(noisy, smooth(noisy, makeParameters(mu)));
  }
}

TEST(LevelSetErrors, CoverThoseOfMeshes)
{
  const auto noisy = makeSphere();
  auto parameters = makeParameters(std::nullopt);
  parameters.mesh.emplace();
  const Surface vertices = smooth(noisy, parameters);
  expectErrorsOfTheSurface(noisy, vertices);
}

TEST(LevelSetErrors, AreLengthsOfTheSamplesWhateverTheirScale)
{
  const auto noisy = makeSphere();
  const auto parameters = makeParameters(std::nullopt);
  const Surface plain = smooth(noisy, parameters);
  expectErrorsOfTheSurface(noisy, smooth(noisy, parameters, 1.0f, 0.125f), 0.125f);
  const Surface larger = smooth(noisy, parameters, 0x1p30f, 1.0f, 1);
  ASSERT_EQ(plain.size(), larger.size());
  for (std::size_t i = 0; i < plain.size(); ++i)
    EXPECT_EQ(0x1p30f * plain[i].error, larger[i].error);
}

TEST(LevelSetErrors, AreUnknownWithoutDeviations)
{
  const auto noisy = makeSphere();
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(*noisy.cloud, cloud);
  std::vector<float> phi;
  for (const auto& point : *noisy.cloud)
    phi.push_back(point.intensity);
  Report report;
  IsosurfaceParameters parameters;
  parameters.isovalues = {0.0};
  const auto surface =
      extractZeroLevel(viewOf(cloud), phi, {}, parameters, std::nullopt, 1, report)
          .vertices;
  ASSERT_GT(surface.size(), 1000u);
  for (const PointIso& point : surface)
    EXPECT_TRUE(std::isnan(point.error));
}

TEST(LevelSetErrors, ASurfaceThatVanishedIsReportedWithItsIsovalue)
{
  const auto noisy =
      uvol_test::makeNoisyCloud(uvol_test::makeSmallShape("sphere", 1.2), 0.0, 1);
  const auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(*noisy.cloud, samples->cloud);
  auto parameters = makeParameters(0.01);
  parameters.isosurface.isovalues = {0.3};
  parameters.level_set.max_steps = 2000;
  for (const bool is_mesh : {false, true}) {
    if (is_mesh)
      parameters.mesh.emplace();
    const auto result = uvol_test::runPipeline(samples, parameters, 0);
    ASSERT_EQ(0u, result.surface.cloud.width);
    bool is_told = false;
    for (const Message& warning : result.report.warnings) {
      is_told = is_told || (warning.code == "vanished" &&
                            uvol_test::wordOf(warning, "isovalue") == "0.3");
      EXPECT_EQ(std::string::npos, warning.text().find(" phi")) << warning;
    }
    EXPECT_TRUE(is_told);
  }
}

} // namespace test_level_set_errors
