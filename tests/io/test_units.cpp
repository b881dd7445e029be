// SPDX-License-Identifier: BSD-3-Clause
// Results do not depend on the unit of length.
#include "io/unit_samples.h"
#include "pipeline/extract_from_ranks.h"
#include "support/clouds.h"
#include "support/surfaces.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/derivatives/gradient_estimation.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>
#include <mutex>

namespace test_units {

using namespace uvol_test;
using pcl_uvol::Dataset;
using pcl_uvol::PointGradient;
using pcl_uvol::PointSplat;

/** The same isopoints in a larger unit. */
Isopoints
scaled(Isopoints isopoints, int exponent)
{
  for (PointIso& point : isopoints) {
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = std::ldexp(point.data[axis], exponent);
    point.error = std::ldexp(point.error, exponent);
    point.edge_length = std::ldexp(point.edge_length, exponent);
    point.mean_curvature = std::ldexp(point.mean_curvature, -exponent);
  }
  return isopoints;
}

/** Powers of two that coordinates are multiplied by. */
class Units : public testing::TestWithParam<int> {};

TEST_P(Units, IsosurfacesAreTheSame)
{
  for (const Interpolation interpolation :
       {Interpolation::Linear, Interpolation::Fit}) {
    IsosurfaceParameters settings = settingsOf(interpolation);
    const Isopoints expected = extract(makeSamples(0), settings);
    ASSERT_GT(expected.size(), 400u);
    expectSame(scaled(expected, GetParam()),
               extract(makeSamples(GetParam()), settings));
    settings.scale = {1.0f, 3.0f, 0.7f};
    expectSame(scaled(extract(makeSamples(0), settings), GetParam()),
               extract(makeSamples(GetParam()), settings));
  }
}

TEST_P(Units, VoronoiGridsAreTheSame)
{
  const auto extract_by_grid = [](int exponent) {
    pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
    extraction.setInputCloud(makeSamples(exponent));
    extraction.setIsoValue(sphere_radius);
    extraction.setNeighborSource(pcl_uvol::NeighborSource::Voronoi);
    Isopoints isopoints;
    extraction.extract(isopoints);
    return isopoints;
  };
  expectSame(scaled(extract_by_grid(0), GetParam()), extract_by_grid(GetParam()));
}

TEST_P(Units, GradientsAreTheSame)
{
  const auto estimate = [](int exponent, pcl_uvol::FitScheme scheme) {
    pcl_uvol::GradientEstimation<pcl::PointXYZI> estimation;
    estimation.setInputCloud(makeSamples(exponent));
    estimation.setScheme(scheme);
    pcl::PointCloud<PointGradient> gradients;
    estimation.compute(gradients);
    return gradients;
  };
  for (const auto scheme :
       {pcl_uvol::FitScheme::Linear, pcl_uvol::FitScheme::Quadratic}) {
    const auto expected = estimate(0, scheme), found = estimate(GetParam(), scheme);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(std::ldexp(expected[i].gradient_x, -GetParam()), found[i].gradient_x);
      ASSERT_EQ(std::ldexp(expected[i].gradient_y, -GetParam()), found[i].gradient_y);
      ASSERT_EQ(std::ldexp(expected[i].gradient_z, -GetParam()), found[i].gradient_z);
      ASSERT_EQ(std::ldexp(expected[i].mean_curvature, -GetParam()),
                found[i].mean_curvature);
    }
    EXPECT_NEAR(1.0,
                std::hypot(expected[0].gradient_x,
                           expected[0].gradient_y,
                           expected[0].gradient_z),
                0.1);
  }
}

TEST_P(Units, NormalsAreTheSame)
{
  const Isopoints surface = extract(makeSamples(0), settingsOf(Interpolation::Linear));
  const auto estimate = [&](int exponent, bool is_oriented) {
    pcl::PointCloud<pcl::PointNormal> cloud;
    for (const PointIso& point : scaled(surface, exponent)) {
      pcl::PointNormal copy;
      copy.getVector3fMap() = point.getVector3fMap();
      if (is_oriented)
        copy.getNormalVector3fMap() = point.getNormalVector3fMap();
      cloud.push_back(copy);
    }
    pcl_uvol::SurfaceNormalParameters parameters;
    parameters.view_point = Eigen::Array3d::Constant(std::ldexp(4.0, exponent));
    Report report;
    return pcl_uvol::detail::estimateSurfaceNormals(
        pcl_uvol::viewOf(cloud), allOf(cloud.size()), parameters, nullptr, 0, report);
  };
  for (const bool is_oriented : {false, true}) {
    const auto expected = estimate(0, is_oriented);
    const auto found = estimate(GetParam(), is_oriented);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_EQ(expected[i].normal[axis], found[i].normal[axis]) << i;
      ASSERT_EQ(expected[i].curvature, found[i].curvature) << i;
    }
  }
}

TEST_P(Units, SplatsAreTheSame)
{
  const Isopoints surface = extract(makeSamples(0), settingsOf(Interpolation::Fit));
  const auto generate = [&](int exponent, bool is_length) {
    const Isopoints points = scaled(surface, exponent);
    pcl_uvol::SplatParameters parameters;
    parameters.delta_is_length = is_length;
    parameters.delta = is_length ? std::ldexp(0.003, exponent) : 0.003;
    Report report;
    return pcl_uvol::detail::generateSplats(
        pcl_uvol::viewOf(points), allOf(points.size()), parameters, 0, report);
  };
  for (const bool is_length : {false, true}) {
    const auto expected = generate(0, is_length),
               found = generate(GetParam(), is_length);
    ASSERT_EQ(expected.sources, found.sources);
    for (std::size_t i = 0; i < expected.cloud.size(); ++i) {
      const PointSplat &a = expected.cloud[i], &b = found.cloud[i];
      for (const auto length : {&PointSplat::radius, &PointSplat::error})
        ASSERT_EQ(std::ldexp(a.*length, GetParam()), b.*length);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(std::ldexp(a.data[axis], GetParam()), b.data[axis]);
        ASSERT_EQ(a.data_n[axis], b.data_n[axis]);
      }
      for (const auto number : {&PointSplat::tilt_u,
                                &PointSplat::tilt_v,
                                &PointSplat::slope_u,
                                &PointSplat::slope_v})
        ASSERT_EQ(a.*number, b.*number);
    }
  }
}

TEST_P(Units, LevelSetsAreTheSame)
{
  const auto evolve = [](int exponent, bool from_sphere, double& spacing) {
    pcl_uvol::LevelSetEvolution<pcl::PointXYZI> evolution;
    evolution.setInputCloud(makeSamples(exponent));
    evolution.setIsoValue(sphere_radius);
    evolution.setScale({1.0f, 1.0f, 1.2f});
    evolution.setMaximumSteps(25);
    if (from_sphere)
      evolution.setInitialFunction(pcl_uvol::InitialFunction::sphere(
          Eigen::Vector3d::Constant(std::ldexp(1.5, exponent)),
          std::ldexp(0.35, exponent)));
    std::vector<float> phi;
    evolution.evolve(phi);
    spacing = evolution.getSummary().spacing;
    return phi;
  };
  for (const bool from_sphere : {false, true}) {
    double expected_spacing = 0.0, spacing = 0.0;
    const auto expected = evolve(0, from_sphere, expected_spacing);
    const auto found = evolve(GetParam(), from_sphere, spacing);
    EXPECT_EQ(std::ldexp(expected_spacing, GetParam()), spacing);
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_EQ(std::ldexp(expected[i], GetParam()), found[i]) << i;
  }
}

TEST_P(Units, PicturesAreTheSame)
{
  const Isopoints surface = extract(makeSamples(0), settingsOf(Interpolation::Fit));
  const auto render = [&](int exponent) {
    pcl_uvol::ImageSpaceRenderer<PointIso> renderer;
    renderer.setInputCloud(pcl::make_shared<Isopoints>(scaled(surface, exponent)));
    renderer.setSize(80, 60);
    pcl_uvol::Light light; // near the surface: places of lights are lengths as well
    light.kind = pcl_uvol::Light::Kind::Point;
    light.position.setConstant(std::ldexp(2.0, exponent));
    light.follows_camera = false;
    renderer.settings().lights = {light};
    pcl_uvol::Image image;
    renderer.render(image);
    return image.color;
  };
  const auto expected = render(0);
  EXPECT_LT(1000, std::count_if(expected.begin(), expected.end(), [](auto byte) {
              return byte != 255;
            }));
  EXPECT_EQ(expected, render(GetParam()));
}

TEST_P(Units, RanksAndDisksGiveTheSame)
{
  const auto cloud = makeSamples(GetParam(), 40000);
  const IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  const Isopoints expected = extract(cloud, settings);
  const auto view = pcl_uvol::viewOf(*cloud);
  std::mutex mutex;
  Isopoints found;
  runRanks(3, [&](pcl_uvol::Communicator& communicator) {
    Report report;
    const auto all = readSamples(view, {view.fields, "intensity"}, {}, 0, 1, report);
    pcl_uvol::Samples own;
    for (std::size_t i = communicator.rank(); i < all.size(); i += communicator.size())
      own.append(all.span(i, 1));
    const auto parts = gatherIsopoints(
        extractFromRanks(std::move(own), settings, {}, communicator, 1, report)
            .isopoints,
        communicator,
        1);
    const std::lock_guard lock(mutex);
    for (const auto& part : parts)
      for (const auto& isopoint : part)
        found.push_back(toPointIso(isopoint, sphere_radius));
  });
  expectSame(expected, found);

  Dataset dataset;
  pcl::toPCLPointCloud2(*cloud, dataset.cloud);
  Report report;
  expectSame(expected, extractFromDisk(dataset, settings, report));
  EXPECT_GT(report.getCount("pieces"), 1u);
}

INSTANTIATE_TEST_SUITE_P(Exponents,
                         Units,
                         testing::Values(-100, -61, 3, 32, 64, 100),
                         [](const auto& exponent) {
                           return (exponent.param < 0 ? "Minus" : "Plus") +
                                  std::to_string(std::abs(exponent.param));
                         });

/** Rows that lie beyond all reach. */

} // namespace test_units
