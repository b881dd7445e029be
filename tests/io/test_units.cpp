// SPDX-License-Identifier: BSD-3-Clause
// Results do not depend on the unit of length, nor on a few points or values that lie
// far from the others.
#include "common/records.h"
#include "io/point_stream.h"
#include "pipeline/extract_from_ranks.h"
#include "pipeline/extract_out_of_core.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/surfaces.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/derivatives/gradient_estimation.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/common/io.h>
#include <pcl/conversions.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::Interpolation;
using pcl_uvol::IsosurfaceParameters;
using pcl_uvol::PointGradient;
using pcl_uvol::PointIso;
using pcl_uvol::PointSplat;
using pcl_uvol::Report;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Isopoints = pcl::PointCloud<PointIso>;

constexpr double radius = 0.3;

/** Samples in [1, 2)^3, so that nothing that is made of them is a subnormal number at
 * 2^-100; intensity is the distance to the middle. */
Cloud::Ptr
makeSamples(int exponent, std::size_t count = 3000)
{
  Cloud::Ptr cloud(new Cloud);
  uvol_test::Random random(5);
  for (std::size_t i = 0; i < count; ++i) {
    pcl::PointXYZI point;
    double sq_dist = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      point.data[axis] = static_cast<float>(1.0 + random.uniform());
      sq_dist += std::pow(point.data[axis] - 1.5, 2);
      point.data[axis] = std::ldexp(point.data[axis], exponent);
    }
    point.intensity = static_cast<float>(std::sqrt(sq_dist));
    cloud->push_back(point);
  }
  return cloud;
}

/** Rows far out among the samples, with a value on either side of the isovalue. */
Cloud::Ptr
withStrays(const Cloud& cloud, const std::vector<float>& places)
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

Isopoints
extract(const Cloud::ConstPtr& cloud,
        const IsosurfaceParameters& settings,
        Report* report = nullptr)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValues(settings.isovalues);
  extraction.setInterpolation(settings.interpolation);
  extraction.setScale(settings.scale);
  Isopoints isopoints;
  extraction.extract(isopoints);
  if (report != nullptr)
    *report = extraction.getReport();
  return isopoints;
}

IsosurfaceParameters
settingsOf(Interpolation interpolation)
{
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {radius};
  settings.interpolation = interpolation;
  return settings;
}

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

void
expectSame(const Isopoints& expected, const Isopoints& found)
{
  ASSERT_EQ(expected.size(), found.size());
  EXPECT_EQ(0,
            std::memcmp(expected.points.data(),
                        found.points.data(),
                        expected.size() * sizeof(PointIso)));
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
  return pcl_uvol::detail::evolveLevelSet(cloud, all, parameters, 0, {}, 0, report);
}

std::vector<std::uint32_t>
allOf(std::size_t count)
{
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  return all;
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
    extraction.setIsoValue(radius);
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
    parameters.view_point.setConstant(std::ldexp(4.0f, exponent));
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
    evolution.setIsoValue(radius);
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
  const auto cloud = withStrays(*makeSamples(GetParam(), 40000), {});
  const IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  const Isopoints expected = extract(cloud, settings);
  const auto view = pcl_uvol::viewOf(*cloud);
  std::mutex mutex;
  Isopoints found;
  uvol_test::runRanks(3, [&](pcl_uvol::Communicator& communicator) {
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
        found.push_back(toPointIso(isopoint, radius));
  });
  expectSame(expected, found);

  const uvol_test::TemporaryFolder folder;
  Dataset dataset;
  pcl::toPCLPointCloud2(*cloud, dataset.cloud);
  pcl_uvol::saveDataset(folder / "in.pcd", dataset);
  pcl_uvol::PointStream points(folder / "in.pcd");
  pcl_uvol::OutOfCoreSettings out_of_core;
  out_of_core.max_memory = pcl_uvol::leastOutOfCoreMemory(points.size(), 1);
  out_of_core.scratch_folder = folder / "";
  Report report;
  expectSame(expected,
             extractOutOfCore(points, settings, out_of_core, report).isopoints);
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
TEST(Strays, AreLeftOutCountedAndNamed)
{
  const auto cloud = makeSamples(0);
  Report report;
  const IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  const Isopoints expected = extract(cloud, settings);
  expectSame(expected, extract(withStrays(*cloud, {-1e20f}), settings, &report));
  EXPECT_EQ(1u, report.getCount("strays"));
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_EQ("1 point lies 1e12 times as far out as most others and is left out: it is "
            "point 7 at (-1e+20, 1e+20, 1).",
            report.warnings[0]);
  const std::vector<float> many(1000, 3.4e38f);
  expectSame(expected, extract(withStrays(*cloud, many), settings, &report));
  EXPECT_EQ(1000u, report.getCount("strays"));
}

TEST(Strays, WithinReachStay)
{
  const auto cloud = makeSamples(0);
  Report report;
  const auto isopoints =
      extract(withStrays(*cloud, {1e12f}), settingsOf(Interpolation::Fit), &report);
  EXPECT_EQ(0u, report.getCount("strays"));
  EXPECT_GT(isopoints.size(), 400u);
}

TEST(Strays, AreTheSameOnRanksAndDisks)
{
  const auto cloud = withStrays(*makeSamples(0, 40000), {1e20f, -3e30f, 1e20f});
  const IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  Report alone;
  const Isopoints expected = extract(cloud, settings, &alone);
  EXPECT_EQ(3u, alone.getCount("strays"));
  const uvol_test::TemporaryFolder folder;
  Dataset dataset;
  pcl::toPCLPointCloud2(*cloud, dataset.cloud);
  pcl_uvol::saveDataset(folder / "in.pcd", dataset);
  pcl_uvol::PointStream points(folder / "in.pcd");
  pcl_uvol::OutOfCoreSettings out_of_core;
  out_of_core.max_memory = pcl_uvol::leastOutOfCoreMemory(points.size(), 1);
  out_of_core.scratch_folder = folder / "";
  Report report;
  expectSame(expected,
             extractOutOfCore(points, settings, out_of_core, report).isopoints);
  EXPECT_EQ(3u, report.getCount("strays"));
  EXPECT_EQ(alone.warnings, report.warnings);
}

TEST(Strays, HarmNoStage)
{
  const auto cloud = withStrays(*makeSamples(0), {1e20f, -1e34f});
  std::vector<int> all(cloud->size());
  std::iota(all.begin(), all.end(), 0);
  const auto view = pcl_uvol::viewOf(*cloud);
  Report report;
  const auto gradients =
      pcl_uvol::detail::estimateGradients(view, all, {}, nullptr, 0, report);
  EXPECT_TRUE(std::isnan(gradients[7].gradient_x));
  EXPECT_EQ(2u, report.getCount("strays"));
  const auto level_set = evolveField(view, "intensity", radius);
  EXPECT_TRUE(std::isnan(level_set.phi[7]));
  EXPECT_TRUE(level_set.summary.converged);

  Cloud sphere;
  pcl::copyPointCloud(*uvol_test::makeSphere(2000, 3), sphere);
  const auto surface = withStrays(sphere, {1e20f, -1e34f});
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

/** A dataset of a field in double. */
Dataset
withDoubles(const Cloud& cloud, const std::function<double(double)>& map)
{
  pcl_uvol::Fields fields;
  for (const char* const name : {"x", "y", "z"})
    pcl_uvol::appendField(fields, name, pcl::PCLPointField::FLOAT32);
  pcl_uvol::appendField(fields, "f", pcl::PCLPointField::FLOAT64);
  Dataset dataset;
  dataset.cloud = pcl_uvol::makeRecords(fields, cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::uint8_t* const point = &dataset.cloud.data[i * dataset.cloud.point_step];
    const double value = map(cloud[i].intensity);
    std::memcpy(point, cloud[i].data, 3 * sizeof(float));
    std::memcpy(point + 3 * sizeof(float), &value, sizeof(value));
  }
  return dataset;
}

Isopoints
extractDoubles(const Cloud& cloud,
               const std::function<double(double)>& map,
               double isovalue,
               Report* report = nullptr)
{
  const Dataset dataset = withDoubles(cloud, map);
  pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
  extraction.setScalarField("f");
  extraction.setIsoValue(isovalue);
  Isopoints isopoints;
  extraction.extract(isopoints);
  if (report != nullptr)
    *report = extraction.getReport();
  return isopoints;
}

/** Median distance of isopoints to the sphere. */
double
deviationOf(const Isopoints& isopoints)
{
  std::vector<double> deviations;
  for (const PointIso& point : isopoints)
    deviations.push_back(
        std::abs((point.getVector3fMap().cast<double>().array() - 1.5).matrix().norm() -
                 radius));
  std::sort(deviations.begin(), deviations.end());
  return deviations.empty() ? 1.0 : deviations[deviations.size() / 2];
}

TEST(Values, OffsetsCostNoDigits)
{
  const auto cloud = makeSamples(0);
  const double best = deviationOf(extractDoubles(
      *cloud, [](double f) { return f; }, radius));
  ASSERT_LT(best, 1e-4);
  for (const double offset : {1e5, 1e7, -1e9, 1.7e9}) {
    const auto isopoints = extractDoubles(
        *cloud, [&](double f) { return f + offset; }, radius + offset);
    EXPECT_LT(deviationOf(isopoints), 1.05 * best) << offset;
    EXPECT_EQ(static_cast<float>(radius + offset), isopoints[0].isovalue);
  }
}

TEST(Values, FillValuesTakeNoDigits)
{
  const auto cloud = makeSamples(0);
  std::size_t count = 0;
  const auto isopoints = extractDoubles(
      *cloud,
      [&](double f) { return count++ == 100 ? -9999.0 : f + 1e7; },
      radius + 1e7);
  EXPECT_LT(deviationOf(isopoints), 1e-4);
}

TEST(Values, PowersOfTwoChangeNothing)
{
  const auto cloud = makeSamples(0);
  const auto expected = extractDoubles(
      *cloud, [](double f) { return f; }, radius);
  for (const int exponent : {-900, -200, -100, -30, 30, 100, 200, 900}) {
    auto found = extractDoubles(
        *cloud,
        [&](double f) { return std::ldexp(f, exponent); },
        std::ldexp(radius, exponent));
    for (PointIso& point : found)
      point.isovalue = static_cast<float>(radius);
    expectSame(expected, found);
  }
}

TEST(Values, LargerThanFloatAreFinite)
{
  const auto cloud = makeSamples(0);
  const auto isopoints = extractDoubles(
      *cloud, [](double f) { return 1e51 * f; }, 3e50);
  EXPECT_LT(deviationOf(isopoints), 1e-4);
}

TEST(Values, GradientsAndLevelSetsFollow)
{
  const auto cloud = makeSamples(0);
  std::vector<int> all(cloud->size());
  std::iota(all.begin(), all.end(), 0);
  const auto estimate = [&](double factor, double offset) {
    const Dataset dataset =
        withDoubles(*cloud, [&](double f) { return factor * f + offset; });
    Report report;
    pcl_uvol::GradientParameters parameters;
    parameters.field = "f";
    return pcl_uvol::detail::estimateGradients(
        pcl_uvol::viewOf(dataset.cloud), all, parameters, nullptr, 0, report);
  };
  const auto expected = estimate(1.0, 0.0), far = estimate(1.0, 1e7),
             small = estimate(0x1p-100, 0.0);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(expected[i].gradient_x, far[i].gradient_x, 1e-4);
    EXPECT_EQ(std::ldexp(expected[i].gradient_x, -100), small[i].gradient_x);
    EXPECT_EQ(expected[i].mean_curvature, small[i].mean_curvature);
  }
  const auto evolve = [&](double offset) {
    const Dataset dataset = withDoubles(*cloud, [&](double f) { return f + offset; });
    Report report;
    pcl_uvol::LevelSetParameters parameters;
    parameters.field = "f";
    parameters.isovalue = radius + offset;
    return pcl_uvol::detail::evolveLevelSet(
               pcl_uvol::viewOf(dataset.cloud), all, parameters, 0, nullptr, 0, report)
        .phi;
  };
  const auto phi = evolve(0.0), far_phi = evolve(1e7);
  for (std::size_t i = 0; i < phi.size(); ++i)
    EXPECT_NEAR(phi[i], far_phi[i], 1e-3);
}

TEST(Values, RangesAreToldInDigitsThatDiffer)
{
  Report report;
  extractDoubles(
      *makeSamples(0), [](double f) { return f + 1e7; }, 1e7 + 2.0, &report);
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_NE(std::string::npos,
            report.warnings[0].find("10000002: it lies outside the range [10000000"))
      << report.warnings[0];
}

TEST(Values, OffsetsCostNothingOnDisk)
{
  const auto cloud = makeSamples(0, 40000);
  const auto map = [](double f) { return f + 1e7; };
  const Isopoints expected = extractDoubles(*cloud, map, radius + 1e7);
  const uvol_test::TemporaryFolder folder;
  pcl_uvol::saveDataset(folder / "in.pcd", withDoubles(*cloud, map));
  pcl_uvol::PointStream points(folder / "in.pcd");
  pcl_uvol::OutOfCoreSettings out_of_core;
  out_of_core.max_memory = pcl_uvol::leastOutOfCoreMemory(points.size(), 1);
  out_of_core.scratch_folder = folder / "";
  IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  settings.field = "f";
  settings.isovalues = {radius + 1e7};
  Report report;
  expectSame(expected,
             extractOutOfCore(points, settings, out_of_core, report).isopoints);
  EXPECT_EQ(40000u, report.getCount("samples"));
}

} // namespace
