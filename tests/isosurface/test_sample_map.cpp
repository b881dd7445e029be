// SPDX-License-Identifier: BSD-3-Clause
// Samples that come and go: the map of the example for ROS 2.
#include "../../examples/ros2/sample_map.h"
#include "common/random.h"

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <atomic>
#include <cstring>
#include <thread>

namespace test_sample_map {

using namespace pcl_uvol;
using uvol_ros::SampleMap;
using uvol_ros::SampleMapParameters;
using Point = pcl::PointXYZI;
using Cloud = pcl::PointCloud<Point>;

/** Random points of a cube with their distance from its middle. */
Cloud
makeCloud(std::size_t count, std::uint64_t seed, double shift = 0.0)
{
  Cloud cloud;
  for (std::uint64_t i = 0; i < count; ++i) {
    Point point;
    double sum = 0.0;
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
      const double x = 2.0 * uniformAt(seed, i, axis) - 1.0;
      point.data[axis] = static_cast<float>(x + shift);
      sum += x * x;
    }
    point.intensity = static_cast<float>(std::sqrt(sum));
    cloud.push_back(point);
  }
  return cloud;
}

IsosurfaceParameters
makeParameters()
{
  IsosurfaceParameters parameters;
  parameters.isovalues = {0.6};
  parameters.outside = Outside::Higher;
  return parameters;
}

TEST(SampleMap, SurfacesAreThoseOfAFreshCloud)
{
  SampleMap<Point> map;
  Cloud all;
  for (std::uint64_t i = 0; i < 4; ++i) {
    map.append(makeCloud(1500, i), static_cast<double>(i));
    all += makeCloud(1500, i);
  }
  EXPECT_EQ(6000u, map.size());
  const auto surface = map.extractInBackground(makeParameters()).get();
  IsosurfaceExtraction<Point> extraction;
  extraction.setInputCloud(std::make_shared<Cloud>(all));
  extraction.setParameters(makeParameters());
  pcl::PointCloud<PointIso> expected;
  extraction.extract(expected);
  ASSERT_EQ(expected.size(), surface.isopoints.size());
  ASSERT_GT(expected.size(), 500u);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(expected[i].getVector3fMap(), surface.isopoints[i].getVector3fMap());
    EXPECT_EQ(extraction.getEdges()[i].first, surface.edges[i].first);
  }
  EXPECT_EQ(6000u, surface.samples->size());
}

TEST(SampleMap, KeepsAWindowInTime)
{
  SampleMapParameters parameters;
  parameters.window = 2.0;
  SampleMap<Point> map(parameters);
  for (const double stamp : {10.0, 11.0, 12.0, 13.0})
    map.append(makeCloud(100, 1, stamp), stamp);
  EXPECT_EQ(300u, map.size());
  map.append(makeCloud(100, 1), 10.5); // late, and too old
  EXPECT_EQ(300u, map.size());
  map.append(makeCloud(100, 1), 11.0); // late
  EXPECT_EQ(400u, map.size());
  map.forgetBefore(12.0);
  EXPECT_EQ(200u, map.size());
  const auto left = map.getSamples();
  for (const Point& point : *left)
    EXPECT_GE(point.x, 11.0f);
  map.forget();
  EXPECT_EQ(0u, map.size());
  map.append(makeCloud(100, 1), 1.0); // time begins anew
  EXPECT_EQ(100u, map.size());
}

TEST(SampleMap, KeepsTheNewestOfEachCube)
{
  SampleMapParameters parameters;
  parameters.most_samples = 1000;
  SampleMap<Point> map(parameters);
  map.append(makeCloud(1000, 1), 0.0);
  EXPECT_EQ(1000u, map.size());
  map.append(makeCloud(1000, 2), 1.0);
  EXPECT_LE(map.size(), 750u);
  EXPECT_GT(map.size(), 300u);

  // The last point that came to each of few places stays.
  Cloud places;
  for (int round = 0; round < 300; ++round)
    for (int place = 0; place < 8; ++place) {
      Point point;
      point.getVector3fMap() = Eigen::Vector3f(
          0.5f + (place & 1), 0.5f + (place >> 1 & 1), 0.5f + (place >> 2 & 1));
      point.intensity = static_cast<float>(round);
      places.push_back(point);
    }
  parameters.cube = 1.0;
  SampleMap<Point> few(parameters);
  few.append(places, 0.0);
  const auto left = few.getSamples();
  ASSERT_EQ(8u, left->size());
  for (const Point& point : *left)
    EXPECT_EQ(299.0f, point.intensity);
}

TEST(SampleMap, FlatAndSinglePlacesAreThinned)
{
  SampleMapParameters parameters;
  parameters.most_samples = 100;
  Cloud flat = makeCloud(500, 3), one = makeCloud(500, 3);
  for (std::size_t i = 0; i < 500; ++i) {
    flat[i].z = 2.0f;
    one[i].getVector3fMap().setConstant(-4.0f);
  }
  flat[7].x = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [cloud, least] : {std::pair(&flat, 25u), std::pair(&one, 1u)}) {
    SampleMap<Point> map(parameters);
    map.append(*cloud, 0.0);
    EXPECT_GE(map.size(), least);
    EXPECT_LE(map.size(), 75u);
    const auto left = map.getSamples();
    for (const Point& point : *left)
      EXPECT_TRUE(std::isfinite(point.x));
  }
  parameters.most_samples = 1; // on both sides of the cubes' corner at 0
  SampleMap<Point> last(parameters);
  last.append(makeCloud(50, 4), 0.0);
  EXPECT_EQ(1u, last.size());
}

TEST(SampleMap, TakesSamplesWhileItExtracts)
{
  SampleMap<Point> map;
  map.append(makeCloud(3000, 1), 0.0);
  auto surface = map.extractInBackground(makeParameters(), 1);
  std::atomic<int> failed{0};
  std::thread other([&] {
    for (int i = 0; i < 20; ++i)
      map.append(makeCloud(100, 2), 0.0);
  });
  for (int i = 0; i < 20; ++i)
    failed += map.getSamples()->size() < 3000 ? 1 : 0;
  other.join();
  EXPECT_EQ(0, failed.load());
  EXPECT_EQ(3000u, surface.get().samples->size());
  EXPECT_EQ(5000u, map.size());
}

TEST(SampleMap, RefusesWhatCannotBe)
{
  const auto make = [](double window, std::size_t most, double cube) {
    SampleMapParameters parameters;
    parameters.window = window;
    parameters.most_samples = most;
    parameters.cube = cube;
    SampleMap<Point> map(parameters);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(make(nan, 1, 0.0));
  EXPECT_THROW(make(-1.0, 1, 0.0), std::invalid_argument);
  EXPECT_THROW(make(1.0, 0, 0.0), std::invalid_argument);
  EXPECT_THROW(make(1.0, 1, -1.0), std::invalid_argument);
  EXPECT_THROW(make(1.0, 1, nan), std::invalid_argument);
  SampleMap<Point> map;
  EXPECT_THROW(map.append(makeCloud(1, 1), nan), std::invalid_argument);
  EXPECT_THROW(map.extract(makeParameters()), InvalidArgument);
  EXPECT_THROW(map.extractInBackground(makeParameters()).get(), InvalidArgument);
}

} // namespace test_sample_map
