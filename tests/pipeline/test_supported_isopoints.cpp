// SPDX-License-Identifier: BSD-3-Clause
// Where values jump, what an automatic bound of the error keeps: crossings between
// neighbours, whatever the isovalue, and none that slips past samples.
#include "pipeline/run_pipeline.h"
#include "support/environment.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

namespace test_supported_isopoints {

using namespace pcl_uvol;

std::shared_ptr<Dataset>
toDataset(const pcl::PointCloud<pcl::PointXYZI>& cloud)
{
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  return samples;
}

/** Random samples, 4 inside of a ball and 1 elsewhere. */
std::shared_ptr<Dataset>
sampleBall()
{
  uvol_test::Random random(5);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 8000; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = point.getVector3fMap().norm() < 0.6f ? 4.0f : 1.0f;
    cloud.push_back(point);
  }
  return toDataset(cloud);
}

/** Two cubic lattices side by side at x = 0, the right one twice as wide, as in a shock
 * tube: edges slip through its channels. */
std::shared_ptr<Dataset>
sampleTube()
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  const auto fill = [&](float first_x, float spacing, int layers, float value) {
    const int across = static_cast<int>(12.0f / spacing);
    for (int i = 0; i < layers; ++i)
      for (int j = 0; j < across; ++j)
        for (int k = 0; k < across; ++k) {
          pcl::PointXYZI point;
          point.x = first_x + spacing * static_cast<float>(i);
          point.y = spacing * (0.5f + static_cast<float>(j));
          point.z = spacing * (0.5f + static_cast<float>(k));
          point.intensity = value;
          cloud.push_back(point);
        }
  };
  fill(-7.5f, 1.0f, 8, 1.2f);
  fill(1.0f, 2.0f, 6, 1.5f);
  return toDataset(cloud);
}

IsosurfaceResult
extract(const std::shared_ptr<Dataset>& samples, double isovalue, bool only_known)
{
  IsosurfacePipelineParameters parameters;
  // Auto removes some of the others by itself, see OneSidedTest.
  if (!only_known)
    parameters.isosurface.interpolation = pcl_uvol::Interpolation::Fit;
  parameters.isosurface.field = "intensity";
  parameters.isosurface.isovalues = {isovalue};
  parameters.automatic_max_error = only_known;
  return uvol_test::runPipeline(samples, parameters);
}

std::size_t
count(IsoSupport support, const IsosurfaceResult& result)
{
  std::size_t found = 0;
  for (const PointIso& point : uvol_test::toIsopoints(result))
    found += point.support == static_cast<std::uint8_t>(support);
  return found;
}

TEST(SupportedIsopoints, AreCrossingsOfAJumpAtAnyIsovalue)
{
  const auto samples = sampleBall();
  for (const double isovalue : {1.1, 1.75, 2.5, 3.25, 3.9}) {
    SCOPED_TRACE(isovalue);
    const auto all = extract(samples, isovalue, false);
    const auto known = extract(samples, isovalue, true);
    ASSERT_GT(count(IsoSupport::Measured, all), 800u);
    EXPECT_EQ(count(IsoSupport::Measured, all), count(IsoSupport::Measured, known));
    EXPECT_EQ(count(IsoSupport::Rim, all), count(IsoSupport::Rim, known));
    EXPECT_EQ(0u, count(IsoSupport::Bridged, known));
  }
}

TEST(SupportedIsopoints, DoNotSlipPastSamples)
{
  const auto samples = sampleTube();
  for (const double isovalue : {1.25, 1.35, 1.45}) {
    SCOPED_TRACE(isovalue);
    const auto all = extract(samples, isovalue, false);
    ASSERT_GT(count(IsoSupport::Bridged, all), 0u);
    const auto known = uvol_test::toIsopoints(extract(samples, isovalue, true));
    EXPECT_EQ(all.surface.cloud.width - count(IsoSupport::Bridged, all), known.size());
    // Neighbours lie at -0.5 and at 1 or, behind the first layer, at 3.
    for (const PointIso& point : known) {
      EXPECT_GE(point.x, -1.5f);
      EXPECT_LE(point.x, 3.0f);
    }
  }
}

/** Profiles at random places, of a value that jumps at a depth of its own. */
std::shared_ptr<Dataset>
sampleProfiles()
{
  uvol_test::Random random(7);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int profile = 0; profile < 40; ++profile) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(20.0 * random.uniform());
    point.y = static_cast<float>(20.0 * random.uniform());
    const double depth = 2.0 + random.uniform();
    for (int i = 0; i < 50; ++i) {
      point.z = 0.1f * static_cast<float>(i);
      point.intensity = point.z < depth ? 1.0f : 3.0f;
      cloud.push_back(point);
    }
  }
  return toDataset(cloud);
}

/** Neighbours of a profile know where the surface crosses it, the space between
 * profiles does not. */
TEST(SupportedIsopoints, AreCrossingsWithLines)
{
  const auto samples = sampleProfiles();
  const auto count = [&](bool only_known, bool on_line) {
    std::size_t found = 0;
    for (const PointIso& point :
         uvol_test::toIsopoints(extract(samples, 1.5, only_known)))
      found += (point.edge_length < 0.11f) == on_line;
    return found;
  };
  EXPECT_EQ(40u, count(false, true));
  EXPECT_EQ(40u, count(true, true));
  EXPECT_GT(count(false, false), 100u);
  EXPECT_LT(count(true, false), count(false, false) / 10);
}

/** Where the surface crosses 40 profiles, samples are 16 times as far apart as most of
 * them are. By their errors alone 13 crossings are known. */
TEST(SupportedIsopoints, AreCrossingsWithUnevenLines)
{
  uvol_test::Random random(8);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int profile = 0; profile < 40; ++profile) {
    const double x = 10.0 * random.uniform(), y = 10.0 * random.uniform();
    for (int i = 0; i < 100; ++i) {
      const double z = i < 80 ? 0.001 * i : 0.08 + 0.016 * (i - 80);
      pcl::PointXYZI point;
      point.x = static_cast<float>(x);
      point.y = static_cast<float>(y);
      point.z = static_cast<float>(z);
      point.intensity = static_cast<float>(z + 0.01 * std::sin(x * y) - 0.2);
      cloud.push_back(point);
    }
  }
  std::size_t on_lines = 0;
  for (const PointIso& point :
       uvol_test::toIsopoints(extract(toDataset(cloud), 0.0, true)))
    on_lines += point.edge_length < 0.017f;
  EXPECT_GE(on_lines, 30u);
}

/** How far outliers lie beyond other values, and how many there are. */
struct Outliers {
  bool beside_steps; ///< among two values, else among those of a distance
  float value;
  std::size_t one_in;
};

class KnownBesideOutliers : public ::testing::TestWithParam<Outliers> {};

TEST_P(KnownBesideOutliers, DoNotSurroundThem)
{
  const auto [beside_steps, value, one_in] = GetParam();
  const auto samples = sampleBall();
  pcl::PointCloud<pcl::PointXYZI> cloud;
  pcl::fromPCLPointCloud2(samples->cloud, cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (i % one_in == 0)
      cloud[i].intensity = value;
    else if (!beside_steps)
      cloud[i].intensity = 3.1f - cloud[i].getVector3fMap().norm();
  const auto count_far = [&](bool only_known) {
    const auto isopoints =
        uvol_test::toIsopoints(extract(toDataset(cloud), 2.5, only_known));
    EXPECT_GT(isopoints.size(), 100u);
    return std::count_if(isopoints.begin(), isopoints.end(), [](const auto& point) {
      return std::abs(point.getVector3fMap().norm() - 0.6f) > 0.2f;
    });
  };
  EXPECT_GT(count_far(false), 70);
  EXPECT_LE(count_far(true), 20);
}

INSTANTIATE_TEST_SUITE_P(,
                         KnownBesideOutliers,
                         ::testing::Values(Outliers{false, -9999.0f, 30},
                                           Outliers{false, 1000.0f, 30},
                                           Outliers{false, 9.0f, 30},
                                           Outliers{true, -9999.0f, 30},
                                           Outliers{true, -9999.0f, 4},
                                           Outliers{true, 1000.0f, 30},
                                           Outliers{true, 9.0f, 30}));

} // namespace test_supported_isopoints
