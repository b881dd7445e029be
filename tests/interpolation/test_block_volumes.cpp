// SPDX-License-Identifier: BSD-3-Clause
// Volumes beyond isovalues by block kriging: against the truth of fields that are known
// everywhere; the same for any unit, place, order and number of threads.
#include "common/random.h"
#include "src/interpolation/block_volumes.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace test_block_volumes {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;
using Field = std::function<double(double, double, double)>;

/** Samples of the unit cube: even, or along vertical lines. */
pcl::PointCloud<pcl::PointXYZI>
makeSamples(const Field& field, std::size_t lines, std::size_t along)
{
  pcl::PointCloud<pcl::PointXYZI> samples;
  for (std::size_t i = 0; i < lines; ++i)
    for (std::size_t j = 0; j < along; ++j) {
      const double x = uniformAt(1, i, 0), y = uniformAt(1, i, 1),
                   z = along == 1 ? uniformAt(1, i, 2)
                                  : (static_cast<double>(j) + 0.5) /
                                        static_cast<double>(along);
      pcl::PointXYZI point;
      point.x = static_cast<float>(x);
      point.y = static_cast<float>(y);
      point.z = static_cast<float>(z);
      point.intensity = static_cast<float>(field(x, y, z));
      samples.push_back(point);
    }
  return samples;
}

BlockVolumes
estimate(const pcl::PointCloud<pcl::PointXYZI>& samples,
         const std::vector<double>& isovalues,
         float side = 0.1f,
         bool is_lower_outside = true,
         unsigned threads = 2)
{
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(samples, cloud);
  BlockParameters parameters;
  parameters.field = "intensity";
  parameters.isovalues = isovalues;
  parameters.is_lower_outside = is_lower_outside;
  parameters.sides.fill(side);
  Report report;
  return estimateBlockVolumes(viewOf(cloud), parameters, threads, report);
}

double
waves(double x, double y, double z)
{
  return std::sin(7.0 * x + 1.0) + std::cos(9.0 * y) * std::sin(5.0 * z);
}

/** Share of the unit cube above an isovalue, and the integral there. */
std::pair<double, double>
integrate(const Field& field, double isovalue)
{
  constexpr int steps = 100;
  double share = 0.0, integral = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      for (int k = 0; k < steps; ++k) {
        const double value =
            field((i + 0.5) / steps, (j + 0.5) / steps, (k + 0.5) / steps);
        if (value < isovalue)
          continue;
        share += 1.0;
        integral += value;
      }
  return {share / 1e6, integral / 1e6};
}

/** Of samples all around and along lines, many and few. Blocks outside of the data are
 * no part of the truth. */
TEST(BlockVolumes, ErrorsCoverTheTruth)
{
  constexpr float side = 0.07f;
  for (const auto& [lines, along] : {std::pair{4000, 1}, {500, 1}, {150, 40}, {40, 40}})
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const auto phase = [seed = seed](std::uint64_t i) {
        return 2.0 * M_PI * uniformAt(77, seed, i);
      };
      const auto field = [&](double x, double y, double z) {
        return std::sin(7.0 * x + phase(0)) +
               std::cos(9.0 * y + phase(1)) * std::sin(5.0 * z + phase(2));
      };
      const auto found = estimate(makeSamples(field,
                                              static_cast<std::size_t>(lines),
                                              static_cast<std::size_t>(along)),
                                  {-0.4, 0.7},
                                  side);
      const double volume = static_cast<double>(found.estimated) * std::pow(side, 3);
      EXPECT_GT(volume, 0.75);
      for (const BlockVolume& all : found.isovalues) {
        const auto [share, integral] = integrate(field, all.isovalue);
        EXPECT_NEAR(share * volume, all.volume, 1.5 * all.volume_error);
        EXPECT_NEAR(integral * volume, all.integral, 1.5 * all.integral_error);
        EXPECT_NEAR(integral / share, all.mean, 1.5 * all.mean_error);
        EXPECT_LT(all.volume_error, 0.2) << lines << ' ' << along;
      }
    }
}

/** Grades of ore, and volumes above cutoffs, as no surface of noise can have them. */
TEST(BlockVolumes, NeitherRiseWithTheCutoffNorFallBelowZero)
{
  const auto noise = [](double x, double y, double z) {
    const double u = uniformAt(5,
                               static_cast<std::uint64_t>(1e6 * x + 1e3 * y),
                               static_cast<std::uint64_t>(1e6 * z));
    return std::exp(waves(x, y, z) + 2.0 * u);
  };
  std::vector<double> cutoffs;
  for (int i = 0; i < 30; ++i)
    cutoffs.push_back(i);
  const auto found = estimate(makeSamples(noise, 100, 30), cutoffs);
  for (std::size_t i = 0; i < cutoffs.size(); ++i) {
    const BlockVolume& all = found.isovalues[i];
    EXPECT_GE(all.volume, 0.0);
    EXPECT_GE(all.mean, cutoffs[i]);
    EXPECT_GE(all.volume_error, 0.0);
    if (i > 0) {
      EXPECT_LE(all.volume, found.isovalues[i - 1].volume);
      EXPECT_GE(all.mean, found.isovalues[i - 1].mean);
    }
  }
}

TEST(BlockVolumes, OfBothSidesAddUp)
{
  const auto samples = makeSamples(waves, 1000, 1);
  const auto above = estimate(samples, {0.3}),
             below = estimate(samples, {0.3}, 0.1f, false);
  const double all = 1e-3 * static_cast<double>(above.estimated);
  EXPECT_NEAR(all, above.isovalues[0].volume + below.isovalues[0].volume, 1e-6);
  EXPECT_NEAR(above.isovalues[0].volume_error, below.isovalues[0].volume_error, 1e-9);
  EXPECT_LT(below.isovalues[0].mean, 0.3);
  EXPECT_GT(above.isovalues[0].mean, 0.3);
}

TEST(BlockVolumes, TheSameForAnyOrderUnitShiftAndThreads)
{
  const auto samples = makeSamples(waves, 600, 1);
  const auto found = estimate(samples, {0.3});
  const BlockVolume& all = found.isovalues[0];
  const auto serial = estimate(samples, {0.3}, 0.1f, true, 1);
  EXPECT_EQ(all.volume, serial.isovalues[0].volume);
  EXPECT_EQ(all.integral_error, serial.isovalues[0].integral_error);
  auto turned = samples;
  std::reverse(turned.begin(), turned.end());
  EXPECT_NEAR(all.volume, estimate(turned, {0.3}).isovalues[0].volume, 1e-12);
  auto large = samples;
  for (pcl::PointXYZI& point : large) {
    point.x = 1024.0f * (point.x + 1.0f);
    point.y *= 1024.0f;
    point.z *= 1024.0f;
    point.intensity = 4.0f * (point.intensity + 8.0f);
  }
  const auto scaled = estimate(large, {4.0 * 8.3}, 102.4f);
  EXPECT_EQ(found.estimated, scaled.estimated);
  EXPECT_NEAR(1.0, scaled.isovalues[0].volume / all.volume / 0x1p30, 1e-4);
  EXPECT_NEAR(1.0, scaled.isovalues[0].volume_error / all.volume_error / 0x1p30, 1e-3);
  EXPECT_NEAR(4.0 * (all.mean + 8.0), scaled.isovalues[0].mean, 1e-3);
  EXPECT_NEAR(4.0, scaled.isovalues[0].mean_error / all.mean_error, 1e-2);
  EXPECT_NEAR(1024.0 * (all.centroid[0] + 1.0), scaled.isovalues[0].centroid[0], 0.1);
}

TEST(BlockVolumes, RefuseWhatTheyCannotEstimate)
{
  const auto samples = makeSamples(waves, 50, 1);
  EXPECT_THROW(estimate(samples, {0.3}, 0.0f), InvalidArgument);
  EXPECT_THROW(estimate(samples, {0.3}, NAN), InvalidArgument);
  EXPECT_THROW(estimate(samples, {0.3}, 1e-4f), InvalidArgument);
  EXPECT_THROW(estimate(pcl::PointCloud<pcl::PointXYZI>(), {0.3}), InvalidArgument);
  const auto constant = [](double, double, double) { return 2.0; };
  const auto found = estimate(makeSamples(constant, 50, 1), {1.0, 2.0, 3.0});
  EXPECT_GT(found.isovalues[0].volume, 0.0);
  EXPECT_EQ(found.isovalues[0].volume, found.isovalues[1].volume);
  EXPECT_EQ(0.0, found.isovalues[2].volume);
  EXPECT_EQ(0.0, found.isovalues[0].volume_error);
  EXPECT_TRUE(std::isnan(found.isovalues[2].mean));
}

} // namespace test_block_volumes
