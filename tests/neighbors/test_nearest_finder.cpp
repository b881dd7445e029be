// SPDX-License-Identifier: BSD-3-Clause
// The k nearest samples of points anywhere, against brute force.
#include "neighbors/nearest_finder.h"
#include "support/clouds.h"
#include "support/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace test_nearest_finder {

using pcl_uvol::NearestFinder;
using pcl_uvol::Position;
using pcl_uvol::SampleSet;
using uvol_test::buildSamples;

float
sqDistance(const Position& a, const Position& b)
{
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis)
    sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

/** Indices of the k nearest, ascending; of equally far ones the lower index. */
std::vector<std::uint32_t>
bruteForce(const SampleSet& samples, const Position& point, std::size_t k)
{
  std::vector<std::pair<float, std::uint32_t>> all;
  for (std::uint32_t i = 0; i < samples.size(); ++i)
    all.emplace_back(sqDistance(samples.getPositions()[i], point), i);
  std::sort(all.begin(), all.end());
  all.resize(std::min(k, all.size()));
  std::vector<std::uint32_t> indices;
  for (const auto& entry : all)
    indices.push_back(entry.second);
  std::sort(indices.begin(), indices.end());
  return indices;
}

std::vector<std::uint32_t>
indicesOf(const NearestFinder::Row& neighbors)
{
  return {neighbors.samples, neighbors.samples + neighbors.size};
}

class NearestFinderOnEveryShape : public testing::TestWithParam<std::string> {};

TEST_P(NearestFinderOnEveryShape, EqualsBruteForce)
{
  const auto samples = buildSamples(*uvol_test::makeCloud(GetParam(), 2000, 5));
  uvol_test::Random random(1);
  for (const std::size_t k : {std::size_t(1), std::size_t(41), samples->size() + 1}) {
    NearestFinder finder(*samples, k);
    for (int i = 0; i < 60; ++i) {
      // samples themselves, points beside them, points far outside
      Position point = samples->getPositions()[static_cast<std::size_t>(
          random.uniform() * static_cast<double>(samples->size()))];
      const float scatter = i % 3 == 0 ? 0.0f : i % 3 == 1 ? 0.02f : 3.0f;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] += scatter * static_cast<float>(random.uniform() - 0.5);
      ASSERT_EQ(bruteForce(*samples, point, k), indicesOf(finder.find(point, 0.05f)))
          << "k " << k << ", point " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(NearestFinder,
                         NearestFinderOnEveryShape,
                         testing::ValuesIn(uvol_test::cloudShapes()),
                         [](const auto& shape) {
                           return uvol_test::testNameOf(shape.param);
                         });

TEST_P(NearestFinderOnEveryShape, ExpectingPointsChangesNothing)
{
  const auto samples = buildSamples(*uvol_test::makeCloud(GetParam(), 2000, 6));
  uvol_test::Random random(2);
  NearestFinder finder(*samples, 20);
  for (int i = 0; i < 20; ++i) {
    std::vector<Position> points(8);
    for (Position& point : points)
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = 0.05f * static_cast<float>(i + random.uniform());
    finder.expect(points.data(), points.size());
    for (const Position& point : points)
      ASSERT_EQ(bruteForce(*samples, point, 20), indicesOf(finder.find(point, 0.05f)));
  }
}

TEST_P(NearestFinderOnEveryShape, WithinARadiusTheNearestAreFound)
{
  const auto samples = buildSamples(*uvol_test::makeCloud(GetParam(), 2000, 7));
  uvol_test::Random random(3);
  for (const std::size_t k : {std::size_t(1), std::size_t(20)}) {
    NearestFinder finder(*samples, k);
    for (int i = 0; i < 60; ++i) {
      Position point = samples->getPositions()[static_cast<std::size_t>(
          random.uniform() * static_cast<double>(samples->size()))];
      for (int axis = 0; axis < 3; ++axis)
        point[axis] += 0.2f * static_cast<float>(random.uniform() - 0.5);
      const auto radius = static_cast<float>(0.02 + 0.3 * random.uniform());
      const auto within = [&](std::vector<std::uint32_t> indices) {
        indices.erase(std::remove_if(indices.begin(),
                                     indices.end(),
                                     [&](std::uint32_t index) {
                                       const Position& x =
                                           samples->getPositions()[index];
                                       return std::hypot(x[0] - point[0],
                                                         x[1] - point[1],
                                                         x[2] - point[2]) > radius;
                                     }),
                      indices.end());
        return indices;
      };
      ASSERT_EQ(within(bruteForce(*samples, point, k)),
                within(indicesOf(finder.findWithin(point, radius))))
          << "k " << k << ", point " << i;
    }
  }
}

/** Twelve orders of magnitude of density: a box for one point holds all the others. */
TEST(NearestFinder, AnyDensity)
{
  auto cloud = uvol_test::makeCloud("uniform", 20000, 3);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].getVector3fMap() =
        ((*cloud)[i].getVector3fMap() - Eigen::Vector3f::Constant(0.5f)) *
        std::pow(10.0f, -4.0f * static_cast<float>(i % 1000) / 1000.0f);
  for (std::size_t i = 0; i < 20; ++i) // far from all
    (*cloud)[i].getVector3fMap() *= 1000.0f;
  const auto samples = buildSamples(*cloud);
  NearestFinder finder(*samples, 12);
  for (std::size_t i = 0; i < samples->size(); i += 37) {
    const Position& point = samples->getPositions()[i];
    ASSERT_EQ(bruteForce(*samples, point, 12), indicesOf(finder.find(point, 1.0f)));
  }
}

TEST(NearestFinder, AnyStartGivesTheSame)
{
  const auto samples = buildSamples(*uvol_test::makeCloud("uniform", 5000, 2));
  const Position point{{0.3f, 0.6f, 0.5f}};
  const auto expected = bruteForce(*samples, point, 26);
  for (const float length : {1e-30f, 1e-6f, 0.1f, 1.0f, 1e6f, 1e38f})
    EXPECT_EQ(expected, indicesOf(NearestFinder(*samples, 26).find(point, length)));
}

/** Samples of two clusters, and groups of points in the gap between them, whose squared
 * distances are equal by the hundred in float; and a sphere about its centre. */
TEST(NearestFinder, AcrossGaps)
{
  for (const float distance : {3.0f, 1e3f, 1e7f, 1e15f}) {
    auto clusters = uvol_test::makeCloud("uniform", 4000, 3);
    for (std::size_t i = 0; i < clusters->size(); i += 2)
      (*clusters)[i].x += distance;
    auto sphere = uvol_test::makeCloud("uniform", 4000, 4);
    for (auto& point : *sphere)
      point.getVector3fMap() =
          distance *
          (point.getVector3fMap() - Eigen::Vector3f::Constant(0.5f)).normalized();
    for (const auto& cloud : {clusters, sphere}) {
      const auto samples = buildSamples(*cloud);
      const float middle = cloud == clusters ? 0.5f * distance : 0.0f;
      uvol_test::Random random(4);
      NearestFinder finder(*samples, 41);
      for (const float extent : {0.0f, 1e-3f, 0.5f, 5.0f}) {
        std::vector<Position> points(8);
        for (Position& point : points) {
          for (int axis = 0; axis < 3; ++axis)
            point[axis] = extent * static_cast<float>(random.uniform());
          point[0] += middle;
        }
        finder.expect(points.data(), points.size());
        for (const Position& point : points) {
          ASSERT_EQ(bruteForce(*samples, point, 41),
                    indicesOf(finder.find(point, 1.0f)))
              << distance << " " << extent;
          const float radius = 0.6f * distance;
          const auto row = finder.findWithin(point, radius);
          std::vector<std::uint32_t> within, expected;
          for (std::size_t i = 0; i < row.size; ++i)
            if (row.sq_dists[i] <= radius * radius)
              within.push_back(row.samples[i]);
          for (const std::uint32_t index : bruteForce(*samples, point, 41))
            if (sqDistance(samples->getPositions()[index], point) <= radius * radius)
              expected.push_back(index);
          ASSERT_EQ(expected, within) << distance << " " << extent;
        }
      }
    }
  }
}

/** Distances whose squares are 0 in float, or infinite: indices decide. */
TEST(NearestFinder, SquaresBeyondFloat)
{
  for (const float scale : {1e-30f, 1e30f}) {
    auto cloud = uvol_test::makeCloud("uniform", 3000, 9);
    for (auto& point : *cloud)
      point.getVector3fMap() *= scale;
    const auto samples = buildSamples(*cloud);
    NearestFinder finder(*samples, 20);
    for (std::size_t i = 0; i < samples->size(); i += 100) {
      const Position& point = samples->getPositions()[i];
      ASSERT_EQ(bruteForce(*samples, point, 20), indicesOf(finder.find(point, scale)));
    }
  }
}

/** A gap that is found is one, and a wide one between two crowds is found. */
TEST_P(NearestFinderOnEveryShape, GapsThatAreFoundAreGaps)
{
  const auto samples = buildSamples(*uvol_test::makeCloud(GetParam(), 2000, 8));
  const std::vector<Position>& positions = samples->getPositions();
  const auto last = static_cast<std::uint32_t>(samples->size() - 1);
  NearestFinder finder(*samples, 20);
  uvol_test::Random random(4);
  for (int i = 0; i < 60; ++i) {
    Position point = positions[static_cast<std::size_t>(
        random.uniform() * static_cast<double>(samples->size()))];
    for (int axis = 0; axis < 3; ++axis)
      point[axis] +=
          (i % 2 == 0 ? 0.05f : 3.0f) * static_cast<float>(random.uniform() - 0.5);
    const float reach = finder.findGap(point, 0, last, 0.7f);
    const auto nearest = bruteForce(*samples, point, 20);
    float sq_nearest = std::numeric_limits<float>::infinity(), sq_farthest = 0.0f;
    for (const std::uint32_t j : nearest) {
      sq_nearest = std::min(sq_nearest, sqDistance(positions[j], point));
      sq_farthest = std::max(sq_farthest, sqDistance(positions[j], point));
    }
    if (reach == 0.0f)
      continue;
    EXPECT_GT(sq_nearest, 0.7f * 0.7f * sq_farthest);
    EXPECT_GE(reach, std::sqrt(sq_farthest));
  }
  const Position far{{1000.0f, 1000.0f, 1000.0f}};
  EXPECT_EQ(samples->size() >= 20, finder.findGap(far, 0, last, 0.7f) > 0.0f);
}

} // namespace test_nearest_finder
