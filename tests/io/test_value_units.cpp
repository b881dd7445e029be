// SPDX-License-Identifier: BSD-3-Clause
// Results do not depend on the unit and the offset of values, nor on a few that lie far
// from the others.
#include "common/records.h"
#include "io/unit_samples.h"
#include "support/messages.h"
#include <pcl_uvol/derivatives/gradient_estimation.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>

namespace test_value_units {

using namespace uvol_test;
using pcl_uvol::Dataset;

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
                 sphere_radius));
  std::sort(deviations.begin(), deviations.end());
  return deviations.empty() ? 1.0 : deviations[deviations.size() / 2];
}

TEST(Values, OffsetsCostNoDigits)
{
  const auto cloud = makeSamples(0);
  const double best = deviationOf(extractDoubles(
      *cloud, [](double f) { return f; }, sphere_radius));
  ASSERT_LT(best, 1e-4);
  for (const double offset : {1e5, 1e7, -1e9, 1.7e9}) {
    const auto isopoints = extractDoubles(
        *cloud, [&](double f) { return f + offset; }, sphere_radius + offset);
    EXPECT_LT(deviationOf(isopoints), 1.05 * best) << offset;
    EXPECT_EQ(static_cast<float>(sphere_radius + offset), isopoints[0].isovalue);
  }
}

TEST(Values, FillValuesTakeNoDigits)
{
  const auto cloud = makeSamples(0);
  std::size_t count = 0;
  const auto isopoints = extractDoubles(
      *cloud,
      [&](double f) { return count++ == 100 ? -9999.0 : f + 1e7; },
      sphere_radius + 1e7);
  EXPECT_LT(deviationOf(isopoints), 1e-4);
}

TEST(Values, PowersOfTwoChangeNothing)
{
  const auto cloud = makeSamples(0);
  const auto expected = extractDoubles(
      *cloud, [](double f) { return f; }, sphere_radius);
  for (const int exponent : {-900, -200, -100, -30, 30, 100, 200, 900}) {
    auto found = extractDoubles(
        *cloud,
        [&](double f) { return std::ldexp(f, exponent); },
        std::ldexp(sphere_radius, exponent));
    for (PointIso& point : found)
      point.isovalue = static_cast<float>(sphere_radius);
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
    parameters.isovalue = sphere_radius + offset;
    return pcl_uvol::detail::evolveLevelSet(pcl_uvol::viewOf(dataset.cloud),
                                            all,
                                            parameters,
                                            0,
                                            nullptr,
                                            false,
                                            0,
                                            report)
        .phi;
  };
  const auto phi = evolve(0.0), far_phi = evolve(1e7);
  for (std::size_t i = 0; i < phi.size(); ++i)
    EXPECT_NEAR(phi[i], far_phi[i], 1e-3);
}

TEST(Values, RangesAreDescribedInDigitsThatDiffer)
{
  Report report;
  extractDoubles(
      *makeSamples(0), [](double f) { return f + 1e7; }, 1e7 + 2.0, &report);
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_EQ("no_isopoints", report.warnings[0].code);
  EXPECT_EQ("10000002", uvol_test::wordOf(report.warnings[0], "isovalue"));
  EXPECT_EQ(0u, uvol_test::wordOf(report.warnings[0], "low").find("10000000"));
}

TEST(Values, OffsetsCostNothingOnDisk)
{
  const auto cloud = makeSamples(0, 40000);
  const auto map = [](double f) { return f + 1e7; };
  const Isopoints expected = extractDoubles(*cloud, map, sphere_radius + 1e7);
  IsosurfaceParameters settings = settingsOf(Interpolation::Fit);
  settings.field = "f";
  settings.isovalues = {sphere_radius + 1e7};
  Report report;
  expectSame(expected, extractFromDisk(withDoubles(*cloud, map), settings, report));
  EXPECT_EQ(40000u, report.getCount("samples"));
}

} // namespace test_value_units
