// SPDX-License-Identifier: BSD-3-Clause
// What SplatGeneration does with input of every kind, good or bad, and splats that are
// read again.
#include "support/environment.h"
#include "support/messages.h"
#include "surface/splat_input.h"
#include "surface/splat_setup.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace test_splat_input {

using namespace uvol_test;
using Eigen::Vector3d;
using Eigen::Vector3f;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Report;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<std::uint32_t>
allOf(std::size_t count)
{
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/** Points at these places that all look upwards. */
SurfaceCloudPtr
makeCloud(const std::vector<Vector3f>& places)
{
  SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  for (const Vector3f& place : places) {
    pcl::PointNormal point;
    point.getVector3fMap() = place;
    point.normal_z = 1.0f;
    cloud->push_back(point);
  }
  return cloud;
}

/** Splats as a stage makes them that is prepared by the caller. */
SplatCloud
computeWith(SplatStage& generation, const SurfaceCloudPtr& cloud)
{
  generation.setInputCloud(cloud);
  SplatCloud splats;
  generation.compute(splats);
  return splats;
}

/** Numbers, unit vectors at right angles, a radius. */
void
expectUsable(const SplatCloud& splats)
{
  for (const pcl_uvol::PointSplat& splat : splats) {
    for (const float number : numbersOf(splat))
      EXPECT_TRUE(std::isfinite(number));
    const Disc disc(splat);
    EXPECT_GT(disc.radius, 0.0);
    EXPECT_GE(disc.error, 0.0);
    EXPECT_LT((disc.axes * disc.axes.transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-5);
  }
}

TEST(SplatsOfPictures, SpecksAreDotsBesideASurface)
{
  std::vector<Vector3f> places = {{0.0f, 0.0f, 20.0f}, {3.0f, 0.0f, 24.0f}};
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j)
      places.emplace_back(
          0.05f * static_cast<float>(i), 0.05f * static_cast<float>(j), 0.0f);
  const auto cloud = makeCloud(places);
  Report report;
  const auto splats =
      pcl_uvol::findSplats(pcl_uvol::viewOf(*cloud), {}, false, 0, report).cloud;
  const float diagonal = Vector3f(1.45f, 1.45f, 0.0f).norm(); // without the specks
  std::size_t dots = 0;
  for (const auto& splat : splats)
    if (splat.z > 10.0f) {
      ++dots;
      EXPECT_NEAR(7e-4f * diagonal, splat.radius, 1e-8f);
    }
    else
      EXPECT_GT(splat.radius, 0.03f);
  EXPECT_EQ(2u, dots);

  // Specks alone are the picture.
  const auto pair = makeCloud({places[0], places[1]});
  for (const auto& splat :
       pcl_uvol::findSplats(pcl_uvol::viewOf(*pair), {}, false, 0, report).cloud)
    EXPECT_NEAR(2.5f, splat.radius, 1e-4f);
}

TEST(SplatsOfPictures, IsopointsInGapsAreDotsWhereNothingCoversThem)
{
  pcl::PointCloud<pcl_uvol::PointIso> cloud;
  const auto add = [&](float x, float y, pcl_uvol::IsoSupport support) {
    pcl_uvol::PointIso point;
    point.x = x;
    point.y = y;
    point.z = 0.0f;
    point.normal_x = point.normal_y = 0.0f;
    point.normal_z = 1.0f;
    point.edge_length = 0.05f;
    point.support = static_cast<std::uint8_t>(support);
    cloud.push_back(point);
  };
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j)
      add(0.05f * static_cast<float>(i),
          0.05f * static_cast<float>(j),
          pcl_uvol::IsoSupport::Measured);
  add(0.72f, 0.73f, pcl_uvol::IsoSupport::Bridged);
  add(3.0f, 0.73f, pcl_uvol::IsoSupport::Bridged);
  Report report;
  const auto splats =
      pcl_uvol::findSplats(pcl_uvol::viewOf(cloud), {}, false, 0, report);
  EXPECT_EQ(2u, report.getCount("bridged"));
  EXPECT_EQ(0, std::count(splats.sources.begin(), splats.sources.end(), 900u));
  EXPECT_EQ(1, std::count(splats.sources.begin(), splats.sources.end(), 901u));
  // The square ends at its sides.
  ASSERT_EQ(splats.cloud.size(), splats.rims.size());
  for (std::size_t i = 0; i < splats.rims.size(); ++i) {
    const std::uint32_t row = splats.sources[i] / 30, column = splats.sources[i] % 30;
    const bool is_corner = row % 29 == 0 && column % 29 == 0;
    EXPECT_TRUE(!is_corner || row == 30 || splats.rims[i] != 0) << row << ' ' << column;
  }
  EXPECT_EQ(0u, splats.rims.back()); // the dot
}

TEST(SplatGeneration, OnePointHasNoExtentThatDeltaIsAPartOf)
{
  for (const std::size_t times : {1u, 20u}) { // 20 at one place are as one
    const auto cloud = makeCloud(std::vector<Vector3f>(times, {1.0f, 2.0f, 3.0f}));
    SplatStage generation;
    generation.setInputCloud(cloud);
    SplatCloud splats(2, 1);
    EXPECT_THROW(generation.compute(splats), InvalidArgument);
    EXPECT_EQ(splats.size(), 2u);
    generation.setAbsoluteDelta(0.25);
    generation.compute(splats);
    ASSERT_EQ(splats.size(), 1u);
    EXPECT_EQ(splats[0].radius, 0.25f);
    EXPECT_EQ(Vector3f(splats[0].getVector3fMap()), Vector3f(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(generation.getReport().getCount("duplicates"), times - 1);
    expectUsable(splats);
  }
}

TEST(SplatGeneration, TwoPointsMeetHalfWay)
{
  const auto cloud = makeCloud({{0.0f, 0.0f, 0.0f}, {3.0f, 0.0f, 0.0f}});
  for (const double delta : {1e-6, 0.1, 100.0}) {
    const auto splats = makeSplats(cloud, delta, 1.0);
    ASSERT_EQ(splats.size(), 2u) << delta;
    for (const pcl_uvol::PointSplat& splat : splats)
      EXPECT_FLOAT_EQ(splat.radius, 1.5f);
    expectUsable(splats);
  }
}

TEST(SplatGeneration, PointsOfALineMeetHalfWay)
{
  std::vector<Vector3f> places(100);
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = static_cast<float>(i) * Vector3f(1.0f, 2.0f, 0.0f);
  for (const double delta : {1e-3, 100.0}) {
    const auto splats = makeSplats(makeCloud(places), delta, 0.2);
    EXPECT_EQ(splats.size(), places.size());
    for (const pcl_uvol::PointSplat& splat : splats)
      EXPECT_FLOAT_EQ(splat.radius, 0.5f * places[1].norm());
    expectUsable(splats);
  }
}

TEST(SplatGeneration, FewPointsOfAPlaneAreCovered)
{
  for (int side = 2; side <= 9; ++side)
    for (int count = side * (side - 1) + 1; count <= side * side; ++count) {
      std::vector<Vector3f> places(static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) {
        const int row = i / side;
        places[static_cast<std::size_t>(i)] =
            Vector3f(static_cast<float>(i % side), static_cast<float>(row), 0.0f);
      }
      const auto splats = makeSplats(makeCloud(places), 0.1, 1.0);
      expectUsable(splats);
      const auto discs = discsOf(splats);
      for (const Vector3f& place : places)
        EXPECT_TRUE(std::any_of(discs.begin(), discs.end(), [&](const Disc& disc) {
          return disc.covers(place.cast<double>(), Vector3d::UnitZ());
        })) << count;
      for (const Disc& disc : discs) // a plane: no error, and normals all the same
        EXPECT_EQ(disc.error + disc.tilt.norm() + disc.slope.norm(), 0.0) << count;
    }
}

TEST(SplatGeneration, LeavesOutPointsWithoutPlaceOrNormal)
{
  const auto cloud = makeSphere(1000, 1);
  (*cloud)[3].x = nan_value;
  (*cloud)[4].z = infinity;
  (*cloud)[5].normal_y = nan_value;
  (*cloud)[6].getNormalVector3fMap().setZero();
  (*cloud)[7].getVector3fMap() = (*cloud)[8].getVector3fMap();
  SplatStage generation;
  generation.setLambda(0.0); // a splat for each of the others
  const auto splats = computeWith(generation, cloud);
  EXPECT_EQ(splats.size(), 995u);
  EXPECT_TRUE(splats.is_dense);
  const Report& report = generation.getReport();
  EXPECT_EQ(report.getCount("points"), 1000u);
  EXPECT_EQ(report.getCount("non_finite"), 2u);
  EXPECT_EQ(report.getCount("without_normal"), 2u);
  EXPECT_EQ(report.getCount("duplicates"), 1u);
  EXPECT_EQ(report.getCount("splats"), 995u);
  EXPECT_TRUE(report.warnings.empty());
  expectUsable(splats);
  for (const std::uint32_t source : generation.getSources())
    EXPECT_TRUE(source < 3 || source > 6) << source;
}

TEST(SplatGeneration, EstimatesNormalsWhereThereAreNone)
{
  const auto sphere = makeSphere(5000, 2);
  pcl::PointCloud<pcl::PointXYZ> bare;
  for (const auto& point : *sphere)
    bare.push_back({point.x, point.y, point.z});
  Report report;
  pcl_uvol::SplatParameters parameters;
  parameters.delta = 4e-3;
  parameters.delta_is_length = true;
  const auto splats = pcl_uvol::detail::generateSplats(
      pcl_uvol::viewOf(bare), allOf(bare.size()), parameters, 0, report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ("estimated_normals", report.warnings[0].code);
  EXPECT_LT(splats.cloud.size(), bare.size());
  expectUsable(splats.cloud);
  // Either side is as good; the fields know how the normals turn towards it.
  for (const Disc& disc : discsOf(splats.cloud)) {
    const Vector3d outside = disc.center.normalized();
    const double side = disc.normal().dot(outside) < 0.0 ? -1.0 : 1.0;
    EXPECT_GT(side * disc.normal().dot(outside), 0.99);
    const Vector3d border =
        disc.center + 0.9 * disc.radius * Vector3d(disc.axes.row(0));
    EXPECT_GT(side * disc.normalAt(border).dot(border.normalized()), 0.99);
  }
}

TEST(SplatGeneration, RefusesBadParameters)
{
  const auto cloud = makeSphere(100, 1);
  const auto expectThrow = [&](const std::function<void(SplatStage&)>& configure) {
    SplatStage generation;
    generation.setInputCloud(cloud);
    configure(generation);
    SplatCloud splats(2, 1);
    EXPECT_THROW(generation.compute(splats), InvalidArgument);
    EXPECT_EQ(splats.size(), 2u);
    EXPECT_TRUE(generation.getSources().empty());
  };
  for (const double delta : {0.0, -1.0, double{nan_value}, double{infinity}}) {
    expectThrow([&](SplatStage& generation) { generation.setDelta(delta); });
    expectThrow([&](SplatStage& generation) { generation.setAbsoluteDelta(delta); });
  }
  for (const double lambda : {-0.1, 1.1, double{nan_value}, double{infinity}})
    expectThrow([&](SplatStage& generation) { generation.setLambda(lambda); });
}

TEST(SplatGeneration, RefusesCloudsWithoutAPoint)
{
  const auto lost = makeSphere(10, 1);
  for (auto& point : *lost)
    point.y = nan_value;
  const SurfaceCloudPtr empty(new pcl::PointCloud<pcl::PointNormal>);
  for (const SurfaceCloudPtr& cloud : {SurfaceCloudPtr(), empty, lost}) {
    SplatStage generation;
    if (cloud)
      generation.setInputCloud(cloud);
    SplatCloud splats(2, 1);
    EXPECT_THROW(generation.compute(splats), InvalidArgument);
    EXPECT_EQ(splats.size(), 2u);
  }
  SplatStage generation;
  generation.setInputCloud(makeSphere(10, 1));
  generation.setIndices(pcl::IndicesPtr(new pcl::Indices));
  SplatCloud splats(2, 1);
  EXPECT_THROW(generation.compute(splats), InvalidArgument);
  EXPECT_EQ(splats.size(), 2u);
}

TEST(SplatGeneration, IsEndedByItsProgressCallback)
{
  SplatStage generation;
  generation.setInputCloud(makeSphere(20000, 1));
  generation.setProgressCallback([](const std::string& step, double) {
    if (step == "splats")
      throw std::runtime_error("enough");
  });
  SplatCloud splats(2, 1);
  EXPECT_THROW(generation.compute(splats), std::runtime_error);
  EXPECT_EQ(splats.size(), 2u);
  generation.setProgressCallback(nullptr);
  generation.compute(splats);
  EXPECT_GT(splats.size(), 2u);
}

TEST(SplatGeneration, DeltaIsAPartOfTheLongestSide)
{
  const auto cloud = makeSphere(5000, 3);
  const auto [low, high] =
      std::minmax_element(cloud->begin(),
                          cloud->end(),
                          [](const auto& a, const auto& b) { return a.y < b.y; });
  const double side = static_cast<double>(high->y) - low->y;
  for (auto& point : *cloud) {
    point.x *= 0.5f;
    point.z *= 0.25f;
  }
  SplatStage generation;
  generation.setAbsoluteDelta(7.0);
  generation.setDelta(1e-3); // what is said last counts
  EXPECT_EQ(bytesOf(computeWith(generation, cloud)),
            bytesOf(makeSplats(cloud, 1e-3 * side, 0.2)));
}

TEST(SplatGeneration, DeltaIsAPartOfTheSideWithoutAFewFarPoints)
{
  const auto cloud = makeSphere(5000, 3);
  const auto [low, high] =
      std::minmax_element(cloud->begin(),
                          cloud->end(),
                          [](const auto& a, const auto& b) { return a.y < b.y; });
  low->y = -300.0f;
  high->y = 500.0f;
  for (auto& point : *cloud) {
    point.x *= 0.5f;
    point.z *= 0.25f;
  }
  std::vector<float> heights;
  for (const auto& point : *cloud)
    heights.push_back(point.y);
  std::sort(heights.begin(), heights.end());
  const double side = static_cast<double>(heights[5000 - 51]) - heights[50];
  SplatStage generation;
  generation.setDelta(1e-3);
  EXPECT_EQ(bytesOf(computeWith(generation, cloud)),
            bytesOf(makeSplats(cloud, 1e-3 * side, 0.2)));
}

TEST(SplatGeneration, GivesTheSameBytesOnAnyNumberOfThreads)
{
  const auto cloud = makeTorusKnot(20000, 4);
  SplatStage generation;
  generation.setDelta(1e-3);
  std::string first;
  std::vector<std::uint32_t> sources;
  for (const unsigned threads : {1u, 2u, 3u, 7u}) {
    generation.setNumberOfThreads(threads);
    const std::string bytes = bytesOf(computeWith(generation, cloud));
    if (first.empty()) {
      first = bytes;
      sources = generation.getSources();
    }
    EXPECT_TRUE(bytes == first) << threads;
    EXPECT_EQ(generation.getSources(), sources) << threads;
  }
}

TEST(SplatGeneration, DoesNotDependOnTheOrderOfTheInput)
{
  const auto cloud = makeWaves(20000, 5);
  std::vector<std::uint32_t> order = allOf(cloud->size());
  Random random(6);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(
        order[i - 1],
        order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  const SurfaceCloudPtr shuffled(new pcl::PointCloud<pcl::PointNormal>);
  for (const std::uint32_t i : order)
    shuffled->push_back((*cloud)[i]);
  SplatStage generation;
  generation.setDelta(1e-3);
  const std::string expected = bytesOf(computeWith(generation, cloud));
  const auto expected_sources = generation.getSources();
  EXPECT_TRUE(bytesOf(computeWith(generation, shuffled)) == expected);
  const auto& sources = generation.getSources();
  ASSERT_EQ(sources.size(), expected_sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
    EXPECT_EQ(order[sources[i]], expected_sources[i]);
}

TEST(SplatGeneration, IsTheSameInAnyUnitOfLength)
{
  const auto cloud = makeSphere(10000, 7);
  SplatStage generation;
  generation.setDelta(1e-3);
  const auto meanRadius = [](const SplatCloud& splats) {
    double sum = 0.0;
    for (const pcl_uvol::PointSplat& splat : splats)
      sum += splat.radius;
    return sum / static_cast<double>(splats.size());
  };
  const auto expected = computeWith(generation, cloud);
  for (const float unit : {1e-6f, 0x1p-20f, 0x1p20f, 1e6f}) {
    const SurfaceCloudPtr scaled(new pcl::PointCloud<pcl::PointNormal>(*cloud));
    for (auto& point : *scaled)
      point.getVector3fMap() *= unit;
    auto splats = computeWith(generation, scaled);
    expectUsable(splats);
    // Rounded coordinates may change the order of a few points.
    const auto count = static_cast<double>(expected.size());
    EXPECT_NEAR(static_cast<double>(splats.size()), count, 0.01 * count) << unit;
    EXPECT_NEAR(meanRadius(splats) / unit, meanRadius(expected), 1e-3) << unit;
    if (std::log2(unit) != std::floor(std::log2(unit)))
      continue;
    for (pcl_uvol::PointSplat& splat : splats) { // powers of two do not round
      splat.getVector3fMap() /= unit;
      splat.radius /= unit;
      splat.error /= unit;
    }
    EXPECT_TRUE(bytesOf(splats) == bytesOf(expected)) << unit;
  }
}

TEST(SplatGeneration, OfIndicesAreThoseOfTheCloudOfThesePoints)
{
  const auto cloud = makeSphere(9000, 8);
  const pcl::IndicesPtr indices(new pcl::Indices);
  const SurfaceCloudPtr chosen(new pcl::PointCloud<pcl::PointNormal>);
  for (int i = 8999; i >= 0; i -= 3) {
    indices->push_back(i);
    chosen->push_back((*cloud)[static_cast<std::size_t>(i)]);
  }
  SplatStage generation;
  const std::string expected = bytesOf(computeWith(generation, chosen));
  const auto sources_in_chosen = generation.getSources();
  generation.setIndices(indices);
  EXPECT_TRUE(bytesOf(computeWith(generation, cloud)) == expected);
  const auto& sources = generation.getSources();
  ASSERT_EQ(sources.size(), sources_in_chosen.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
    EXPECT_EQ(sources[i], static_cast<std::uint32_t>((*indices)[sources_in_chosen[i]]));
}

TEST(SplatGeneration, KeepsTheHeaderAndTakesIsopoints)
{
  const auto sphere = makeSphere(1000, 9);
  sphere->header.frame_id = "laboratory";
  sphere->header.stamp = 42;
  const pcl::PointCloud<pcl_uvol::PointIso>::Ptr isopoints(
      new pcl::PointCloud<pcl_uvol::PointIso>);
  for (const auto& point : *sphere) {
    pcl_uvol::PointIso isopoint;
    isopoint.getVector3fMap() = point.getVector3fMap();
    isopoint.getNormalVector3fMap() = point.getNormalVector3fMap();
    isopoints->push_back(isopoint);
  }
  SplatStage generation;
  const auto splats = computeWith(generation, sphere);
  EXPECT_EQ(splats.header.frame_id, "laboratory");
  EXPECT_EQ(splats.header.stamp, 42u);
  EXPECT_EQ(splats.width, splats.size());
  EXPECT_EQ(splats.height, 1u);
  pcl_uvol::SplatGeneration<pcl_uvol::PointIso> of_isopoints;
  of_isopoints.setInputCloud(isopoints);
  SplatCloud others;
  of_isopoints.compute(others);
  EXPECT_TRUE(bytesOf(others) == bytesOf(splats));
}

TEST(ReadSplats, GivesWhatWasWritten)
{
  const auto splats = makeSplats(makeSphere(2000, 1), 1e-3, 0.2);
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(splats, cloud);
  const auto view = pcl_uvol::viewOf(cloud);
  ASSERT_TRUE(pcl_uvol::hasSplats(view));
  Report report;
  const auto read = pcl_uvol::readSplats(view, report);
  EXPECT_EQ(report.getCount("splats"), splats.size());
  EXPECT_EQ(report.getCount("bad_splats"), 0u);
  EXPECT_EQ(read.sources, allOf(splats.size()));
  ASSERT_EQ(read.cloud.size(), splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const auto actual = numbersOf(read.cloud[i]), expected = numbersOf(splats[i]);
    for (std::size_t k = 0; k < actual.size(); ++k) // unit vectors are made so anew
      EXPECT_NEAR(actual[k], expected[k], 1e-6f);
  }
}

TEST(ReadSplats, LeavesOutWhatIsNoDisc)
{
  SplatCloud splats = makeSplats(makeSphere(100, 1), 1e-3, 0.0);
  ASSERT_EQ(splats.size(), 100u);
  splats[1].x = nan_value;
  splats[2].radius = 0.0f;
  splats[3].radius = -1.0f;
  splats[4].radius = infinity;
  splats[5].getNormalVector3fMap().setZero();
  splats[6].getTangentVector3fMap().setZero();
  splats[7].slope_v = nan_value;
  splats[8].normal_y = infinity;
  splats[9].getNormalVector3fMap() *= 3.0f; // made a unit vector again
  Report report;
  const auto read = pcl_uvol::readSplats(pcl_uvol::viewOf(splats), report);
  EXPECT_EQ(report.getCount("splats"), 92u);
  EXPECT_EQ(report.getCount("bad_splats"), 8u);
  ASSERT_EQ(read.sources.size(), 92u);
  EXPECT_EQ(read.sources[1], 9u);
  expectUsable(read.cloud);
}

/** Products of lengths between splats have to stay within float. */
TEST(ReadSplats, LeavesOutWhatIsTooFarTooLargeOrTooSmall)
{
  SplatCloud splats = makeSplats(makeSphere(100, 1), 1e-3, 0.0);
  splats[1].y = 2.5e37f;
  splats[2].radius = 1e37f;
  splats[3].z = -1.01f * pcl_uvol::most_splat_reach;
  splats[4].x = pcl_uvol::most_splat_reach;
  splats[5].radius = pcl_uvol::most_splat_reach;
  splats[6].radius = 0.99f * pcl_uvol::least_splat_radius;
  splats[7].radius = pcl_uvol::least_splat_radius;
  Report report;
  const auto read = pcl_uvol::readSplats(pcl_uvol::viewOf(splats), report);
  EXPECT_EQ(report.getCount("bad_splats"), 4u);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ("bad_splats", report.warnings[0].code);
  EXPECT_EQ(4.0, uvol_test::numberOf(report.warnings[0], "bad"));
  EXPECT_EQ(100.0, uvol_test::numberOf(report.warnings[0], "splats"));
  ASSERT_EQ(read.sources.size(), 96u);
  EXPECT_EQ(read.sources[1], 4u);
}

TEST(ReadSplats, NeedsAllFields)
{
  EXPECT_TRUE(pcl_uvol::hasSplats(pcl_uvol::viewOf(SplatCloud(1, 1))));
  const auto points = makeSphere(10, 1);
  const auto view = pcl_uvol::viewOf(*points);
  EXPECT_FALSE(pcl_uvol::hasSplats(view));
  Report report;
  EXPECT_THROW(pcl_uvol::readSplats(view, report), InvalidArgument);
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(SplatCloud(1, 1), cloud);
  for (auto& field : cloud.fields)
    if (field.name == "slope_u")
      field.name = "slope";
  EXPECT_FALSE(pcl_uvol::hasSplats(pcl_uvol::viewOf(cloud)));
}

} // namespace test_splat_input
