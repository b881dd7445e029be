// SPDX-License-Identifier: BSD-3-Clause
// Results do not depend on a few points that lie far from the others.
#include "io/unit_samples.h"
#include "support/surfaces.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/derivatives/gradient_estimation.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/common/io.h>
#include <pcl/conversions.h>

#include <numeric>

namespace test_far_points {

using namespace uvol_test;
using pcl_uvol::Dataset;
using pcl_uvol::PointSplat;

/** Rows far out among the samples, with a value on either side of the isovalue. */
Cloud::Ptr
withOutliers(const Cloud& cloud, const std::vector<float>& places)
{
  Cloud::Ptr more(new Cloud(cloud));
  for (const float place : places) {
    pcl::PointXYZI point;
    point.x = place;
    point.y = -place;
    point.z = 1.0f;
    point.intensity = more->size() % 2 == 0 ? 0.0f : 1.0f;
    more->insert(more->begin() + 7, point);
  }
  return more;
}

pcl_uvol::LevelSet
evolveField(const pcl_uvol::CloudView& cloud, const std::string& field, double isovalue)
{
  pcl::Indices all(cloud.count);
  std::iota(all.begin(), all.end(), 0);
  pcl_uvol::LevelSetParameters parameters;
  parameters.field = field;
  parameters.isovalue = isovalue;
  Report report;
  return pcl_uvol::detail::evolveLevelSet(
      cloud, all, parameters, 0, {}, false, 0, report);
}

TEST(FarPoints, AreLeftOutCountedAndNamed)
{
  const auto cloud = makeSamples(0);
  Report report;
  const IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  const Isopoints expected = extract(cloud, settings);
  expectSame(expected, extract(withOutliers(*cloud, {-1e20f}), settings, &report));
  EXPECT_EQ(1u, report.getCount("far_points"));
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_EQ(
      pcl_uvol::Message(
          "far_points",
          {{"far_points", 1}, {"first", 7}, {"x", -1e20f}, {"y", 1e20f}, {"z", 1.0f}}),
      report.warnings[0]);
  EXPECT_EQ(
      "1 outlier is ignored, 1e12 times farther out than most points. It is point 7 "
      "at (-1e+20, 1e+20, 1).",
      report.warnings[0].text());
  const std::vector<float> many(1000, 3.4e38f);
  expectSame(expected, extract(withOutliers(*cloud, many), settings, &report));
  EXPECT_EQ(1000u, report.getCount("far_points"));
}

TEST(FarPoints, WithinReachStay)
{
  const auto cloud = makeSamples(0);
  Report report;
  const auto isopoints =
      extract(withOutliers(*cloud, {1e12f}), settingsOf(Interpolation::Fit), &report);
  EXPECT_EQ(0u, report.getCount("far_points"));
  EXPECT_GT(isopoints.size(), 400u);
}

TEST(FarPoints, AreTheSameOnRanksAndDisks)
{
  const auto cloud = withOutliers(*makeSamples(0, 40000), {1e20f, -3e30f, 1e20f});
  const IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  Report alone;
  const Isopoints expected = extract(cloud, settings, &alone);
  EXPECT_EQ(3u, alone.getCount("far_points"));
  Dataset dataset;
  pcl::toPCLPointCloud2(*cloud, dataset.cloud);
  Report report;
  expectSame(expected, extractFromDisk(dataset, settings, report));
  EXPECT_EQ(3u, report.getCount("far_points"));
  EXPECT_EQ(alone.warnings, report.warnings);
}

TEST(FarPoints, HarmNoStage)
{
  const auto cloud = withOutliers(*makeSamples(0), {1e20f, -1e34f});
  std::vector<int> all(cloud->size());
  std::iota(all.begin(), all.end(), 0);
  const auto view = pcl_uvol::viewOf(*cloud);
  Report report;
  const auto gradients =
      pcl_uvol::detail::estimateGradients(view, all, {}, nullptr, 0, report);
  EXPECT_TRUE(std::isnan(gradients[7].gradient_x));
  EXPECT_EQ(2u, report.getCount("far_points"));
  const auto level_set = evolveField(view, "intensity", sphere_radius);
  EXPECT_TRUE(std::isnan(level_set.phi[7]));
  EXPECT_TRUE(level_set.summary.converged);

  Cloud sphere;
  pcl::copyPointCloud(*makeSphere(2000, 3), sphere);
  const auto surface = withOutliers(sphere, {1e20f, -1e34f});
  const auto surface_view = pcl_uvol::viewOf(*surface);
  const auto normals = pcl_uvol::detail::estimateSurfaceNormals(
      surface_view, allOf(surface->size()), {}, nullptr, 0, report);
  EXPECT_TRUE(std::isnan(normals[7].normal[0]));
  EXPECT_FALSE(std::isnan(normals[9].normal[0]));
  const auto splats = pcl_uvol::detail::generateSplats(
      surface_view, allOf(surface->size()), {}, 0, report);
  for (const PointSplat& splat : splats.cloud)
    EXPECT_LT(splat.getVector3fMap().norm() + splat.radius, 10.0f);
  pcl::PCLPointCloud2::Ptr drawn(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*surface, *drawn);
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(drawn);
  EXPECT_LT(renderer.getBounds().radius, 10.0);
}

TEST(Scale, BeyondFloatIsRefusedOrWorks)
{
  IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  settings.scale = {1e30f, 1.0f, 1.0f};
  EXPECT_GT(extract(makeSamples(0), settings).size(), 0u);
  settings.scale = {1e38f, 1.0f, 1e-38f};
  EXPECT_THROW(extract(makeSamples(0), settings), pcl_uvol::InvalidArgument);
}

} // namespace test_far_points
