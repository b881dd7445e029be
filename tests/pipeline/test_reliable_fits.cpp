// SPDX-License-Identifier: BSD-3-Clause
// Gaps that are none: where fits to the measured samples are more certain of the
// surface than kriging is, nothing is predicted, and what they tell stays.
#include "pipeline/gap_filling.h"
#include "pipeline/reliable_fits.h"
#include "pipeline/run_pipeline.h"
#include "support/environment.h"
#include "support/messages.h"
#include "support/stretched_samples.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace test_reliable_fits {

using namespace pcl_uvol;

/** Crossings at random places of the cube from -1 to 1. */
pcl::PointCloud<PointIso>
makeCrossings(std::size_t count)
{
  uvol_test::Random random(1);
  pcl::PointCloud<PointIso> crossings;
  for (std::size_t i = 0; i < count; ++i) {
    PointIso point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.error = 1.0f;
    point.isovalue = 0.0f;
    crossings.push_back(point);
  }
  return crossings;
}

/** A kriged field of slope 1.
 * \param value of the field where its isovalue is 0 */
detail::KrigedSlope
makeSlope(double value, double deviation)
{
  return {{0.6, 0.0, 0.8}, 1.0, value, deviation};
}

const Eigen::Array3f unscaled(1.0f, 1.0f, 1.0f);

TEST(ReliableFits, AreFoundWhereMostAroundContradictKriging)
{
  const std::size_t count = 4000;
  auto crossings = makeCrossings(count);
  std::vector<detail::KrigedSlope> kriged;
  for (std::size_t i = 0; i < count; ++i) { // every fifth one is outvoted
    const bool is_reliable = (crossings[i].x < 0.0f) != (i % 5 == 0);
    const bool contradicts = (crossings[i].y < 0.0f) != (i % 5 == 1);
    kriged.push_back(makeSlope(contradicts ? -0.04 : 0.01, is_reliable ? 1.1 : 0.9));
  }
  std::vector<std::array<double, 3>> places;
  for (const double x : {-3.0, -0.9, -0.5, 0.5, 0.9, 3.0})
    for (const double y : {-3.0, -0.7, 0.7, 2.0})
      places.push_back({x, y, 0.1});
  std::vector<std::uint8_t> supported(count);
  const auto find = [&](double spacing, unsigned threads) {
    return detail::ReliableFits(
               crossings, supported, kriged, unscaled, spacing, threads)
        .find(places, threads);
  };
  const auto found = find(0.1, 2);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_EQ(places[i][0] < 0.0 && places[i][1] < 0.0, found[i] != 0)
        << places[i][0] << ' ' << places[i][1];
  EXPECT_EQ(found, find(0.1, 1));
  // Scaled lengths say the same.
  const auto unit = static_cast<float>(0x1p30);
  for (PointIso& point : crossings) {
    point.getArray3fMap() *= unit;
    point.error *= unit;
  }
  for (detail::KrigedSlope& slope : kriged)
    slope.length /= 0x1p30;
  for (auto& place : places)
    for (double& x : place)
      x *= 0x1p30;
  EXPECT_EQ(found, find(0x1p30 * 0.1, 3));
}

TEST(ReliableFits, AreNotWithoutFitsOrWithoutKriging)
{
  auto crossings = makeCrossings(300);
  const auto isReliable = [&](double deviation) {
    return detail::ReliableFits(crossings,
                                std::vector<std::uint8_t>(crossings.size(), 0),
                                {crossings.size(), makeSlope(1.0, deviation)},
                                unscaled,
                                0.1,
                                1)
               .find({{0.1, 0.2, 0.3}}, 1)
               .front() != 0;
  };
  EXPECT_TRUE(isReliable(1e3));
  EXPECT_FALSE(isReliable(0.5));
  EXPECT_FALSE(isReliable(std::numeric_limits<double>::quiet_NaN()));
  for (PointIso& point : crossings)
    point.error = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(isReliable(1e3));
  crossings.clear();
  EXPECT_FALSE(isReliable(1e3));
}

IsosurfacePipelineParameters
makeParameters(double isovalue, bool fills)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = "intensity";
  parameters.isosurface.isovalues = {isovalue};
  parameters.fill_gaps = fills;
  parameters.automatic_scale = false;
  return parameters;
}

std::shared_ptr<Dataset>
toDataset(const pcl::PointCloud<pcl::PointXYZI>& cloud)
{
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  return samples;
}

/** Whether isopoints are the same, in every field but the confidence. */
void
expectSame(const pcl::PointCloud<PointIso>& expected,
           const pcl::PointCloud<PointIso>& found)
{
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(expected[i].getVector3fMap(), found[i].getVector3fMap());
    EXPECT_EQ(expected[i].getNormalVector3fMap(), found[i].getNormalVector3fMap());
    EXPECT_EQ(expected[i].error, found[i].error);
    EXPECT_EQ(expected[i].support, found[i].support);
  }
}

/** Cells as flow solvers have them at a wall: a hundred times longer than thick, and
 * taken for lines. The field is as smooth as they are small. */
TEST(ReliableFits, LeaveCellsAtAWallAsTheyAre)
{
  constexpr int side = 24;
  for (const std::string shape : {"wall", "curved"}) {
    const auto field = uvol_test::makeSmoothField("gyroid", side * side * side);
    const auto stretched = uvol_test::makeStretchedSamples(shape, 100.0, side);
    const auto samples = toDataset(*stretched.sample(field, side, 1));
    const auto as_it_is =
        uvol_test::runPipeline(samples, makeParameters(field.isovalue, false));
    const auto filled =
        uvol_test::runPipeline(samples, makeParameters(field.isovalue, true));
    EXPECT_EQ(0u, filled.gaps->predicted);
    const auto told = uvol_test::findWarning(filled, "unfilled_gaps");
    ASSERT_TRUE(told);
    EXPECT_EQ(
        "fits to the measured samples are more certain of the surface across them than "
        "kriging is",
        uvol_test::wordOf(*told, "reason"));
    const auto points = uvol_test::toIsopoints(filled);
    expectSame(uvol_test::toIsopoints(as_it_is), points);
    auto deviations = uvol_test::deviations(field, stretched.inIndexSpace(points));
    std::sort(deviations.begin(), deviations.end());
    EXPECT_LT(deviations[deviations.size() / 2], 0.01) << shape; // of a cell
  }
}

double
waveAt(double x, double y)
{
  return 0.5 + 0.1 * std::sin(4.0 * x) * std::cos(3.0 * y);
}

/** The height above a wave. */
pcl::PointXYZI
sampleAt(double x, double y, double z)
{
  pcl::PointXYZI point;
  point.x = static_cast<float>(x);
  point.y = static_cast<float>(y);
  point.z = static_cast<float>(z);
  point.intensity = static_cast<float>(z - waveAt(x, y));
  return point;
}

/** Profiles at random places where x is between 0 and 1, of 60 samples each. */
pcl::PointCloud<pcl::PointXYZI>
makeProfiles(std::size_t count)
{
  uvol_test::Random random(2);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (std::size_t profile = 0; profile < count; ++profile) {
    const double x = random.uniform(), y = random.uniform();
    for (int i = 0; i < 60; ++i)
      cloud.push_back(sampleAt(x, y, (i + 0.3 * random.uniform()) / 60.0));
  }
  return cloud;
}

/** What is predicted with some samples: how many, and where x is least. */
struct Predicted {
  std::size_t count;
  double least_x;
};

Predicted
predict(const pcl::PointCloud<pcl::PointXYZI>& cloud)
{
  PipelineInput input{toDataset(cloud), nullptr, makeParameters(0.0, true)};
  Report report;
  const detail::FilledGaps gaps(input, 0, report);
  const CloudView filled = viewOf(input.samples->cloud);
  Predicted predicted{filled.count - cloud.size(),
                      std::numeric_limits<double>::infinity()};
  for (std::size_t i = cloud.size(); i < filled.count; ++i)
    predicted.least_x =
        std::min(predicted.least_x, static_cast<double>(filled.xyz(i)[0]));
  return predicted;
}

/** The spacing of what is predicted is a quarter of that of the samples here, which are
 * most: they would all have some between them. */
TEST(ReliableFits, PredictBetweenProfilesAndNotAmongSamplesAllAround)
{
  auto cloud = makeProfiles(150);
  const Predicted alone = predict(cloud);
  uvol_test::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const double x = -random.uniform(), y = random.uniform();
    cloud.push_back(sampleAt(x, y, random.uniform()));
  }
  const Predicted beside = predict(cloud);
  EXPECT_GT(alone.count, 1000u);
  EXPECT_GT(beside.count, alone.count);
  EXPECT_GT(beside.least_x, -0.15);
}

/** Layers at a wall whose field bends from cell to cell, where x is below -2.5, beside
 * profiles of one that is smooth, where x is above 0.
 * \param unit of length */
pcl::PointCloud<pcl::PointXYZI>
makeCellsAndProfiles(float unit)
{
  constexpr int side = 20;
  const auto field = uvol_test::makeSmoothField("gyroid", side * side * side);
  pcl::PointCloud<pcl::PointXYZI> cloud =
      *uvol_test::makeStretchedSamples("wall", 100.0, side).sample(field, side, 1);
  double height = 0.0;
  for (pcl::PointXYZI& point : cloud) {
    point.x -= 12.0f;
    point.intensity -= static_cast<float>(field.isovalue);
    height = std::max(height, static_cast<double>(point.z));
  }
  uvol_test::Random random(4);
  for (int profile = 0; profile < 100; ++profile) {
    const double x = 20.0 * random.uniform(), y = 20.0 * random.uniform() - 10.0;
    for (int i = 0; i < 60; ++i) {
      const double z = height * (i + 0.3 * random.uniform()) / 60.0;
      cloud.push_back(sampleAt(x, y, z));
      cloud.back().intensity =
          static_cast<float>(0.2 * (z - height * waveAt(0.1 * x, 0.1 * y)));
    }
  }
  for (pcl::PointXYZI& point : cloud)
    point.getArray3fMap() *= unit;
  return cloud;
}

TEST(ReliableFits, PredictBetweenProfilesAndNotInStretchedCells)
{
  const auto cloud = makeCellsAndProfiles(1.0f);
  const Predicted predicted = predict(cloud);
  EXPECT_GT(predicted.count, 1000u);
  EXPECT_GT(predicted.least_x, -4.0); // at the border of the cells
  const auto samples = toDataset(cloud);
  const auto filled = uvol_test::runPipeline(samples, makeParameters(0.0, true), 1);
  const auto few = uvol_test::findWarning(filled, "few_filled_gaps");
  ASSERT_TRUE(few);
  EXPECT_LT(uvol_test::numberOf(*few, "by_fits"),
            uvol_test::numberOf(*few, "crossings"));
  const auto takeCells = [](const IsosurfaceResult& result) {
    pcl::PointCloud<PointIso> points;
    for (const PointIso& point : uvol_test::toIsopoints(result))
      if (point.x < -5.0f)
        points.push_back(point);
    return points;
  };
  const auto as_it_is =
      takeCells(uvol_test::runPipeline(samples, makeParameters(0.0, false)));
  EXPECT_GT(as_it_is.size(), 1000u);
  expectSame(as_it_is, takeCells(filled));
}

TEST(ReliableFits, PredictTheSameOnThreadsAndInUnits_long)
{
  const auto cloud = makeCellsAndProfiles(1.0f);
  const auto samples = toDataset(cloud);
  const auto filled = uvol_test::runPipeline(samples, makeParameters(0.0, true), 1);
  EXPECT_EQ(
      filled.surface.cloud.data,
      uvol_test::runPipeline(samples, makeParameters(0.0, true), 3).surface.cloud.data);
  const Predicted predicted = predict(cloud);
  const Predicted large = predict(makeCellsAndProfiles(0x1p20f));
  EXPECT_EQ(predicted.count, large.count);
  EXPECT_EQ(0x1p20 * predicted.least_x, large.least_x);
}

} // namespace test_reliable_fits
