// SPDX-License-Identifier: BSD-3-Clause
// Nearest samples in metrics of all kinds, beside brute force.
#include "src/neighbors/metric_finder.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <utility>

namespace test_metric_finder {

using pcl_uvol::Ball;
using pcl_uvol::MetricFinder;
using pcl_uvol::Position;
using pcl_uvol::SampleSet;

constexpr std::size_t k = 41;

SampleSet::ConstPtr
makeSamples(const std::vector<Position>& positions)
{
  std::vector<std::uint32_t> all(positions.size());
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::Report report;
  return SampleSet::build(
      positions.front().x, 3, all, Position{{1.0f, 1.0f, 1.0f}}, 1, report);
}

std::vector<Position>
makePositions(const std::string& layout, std::size_t count)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::vector<Position> positions;
  for (std::size_t i = 0; i < count; ++i) {
    Position x{{uniform(random), uniform(random), uniform(random)}};
    if (layout == "sheets")
      x[2] = static_cast<float>(i % 3);
    else if (layout == "clusters")
      x[0] += i % 2 == 0 ? 0.0f : 1000.0f;
    else if (layout == "line")
      x = {{x[0], 2.0f * x[0], -x[0]}};
    else if (layout == "lattice")
      x = {{static_cast<float>(i % 16),
            static_cast<float>(i / 16 % 16),
            4.0f * static_cast<float>(i / 256)}};
    positions.push_back(x);
  }
  return positions;
}

/** Rotated, and stretched by up to 1 : ratio. */
Eigen::Matrix3d
makeMetric(double ratio, double angle)
{
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 2.0, -0.5).normalized())
          .toRotationMatrix();
  return turn * Eigen::Vector3d(1.0, 1.0 / std::sqrt(ratio), 1.0 / ratio).asDiagonal() *
         turn.transpose();
}

Eigen::Vector3d
offset(const Position& from, const Position& to)
{
  return {static_cast<double>(to[0]) - from[0],
          static_cast<double>(to[1]) - from[1],
          static_cast<double>(to[2]) - from[2]};
}

/** Expect samples to lie in a ball, but for rounding. */
void
expectIn(const Ball& ball,
         const SampleSet& samples,
         const std::vector<std::uint32_t>& found)
{
  for (const std::uint32_t i : found) {
    const Eigen::Vector3d away = offset(ball.center, samples.getPositions()[i]);
    double sq_length = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_LE(std::abs(away[static_cast<Eigen::Index>(axis)]),
                ball.radius * ball.extent[axis] * (1.0 + 1e-6));
      sq_length += std::pow(
          away.dot(Eigen::Map<const Eigen::Vector3d>(ball.metric[axis].data())), 2);
    }
    EXPECT_LE(std::sqrt(sq_length), ball.radius * (1.0 + 1e-6));
    EXPECT_LE(away.norm(), ball.getReach() * (1.0 + 1e-6));
  }
}

/** Squared distances in the metric, ascending. */
std::vector<double>
sqDistances(const SampleSet& samples,
            const Position& point,
            const Eigen::Matrix3d& metric,
            const std::vector<std::uint32_t>& of)
{
  std::vector<double> found;
  for (const std::uint32_t i : of)
    found.push_back((metric * offset(point, samples.getPositions()[i])).squaredNorm());
  std::sort(found.begin(), found.end());
  return found;
}

TEST(MetricFinder, FindsTheNearestOfAllKinds)
{
  for (const std::string layout : {"cube", "sheets", "clusters", "line", "lattice"})
    for (const std::size_t count : {1u, 41u, 100u, 3000u}) {
      const auto samples = makeSamples(makePositions(layout, count));
      std::vector<std::uint32_t> all(samples->size());
      std::iota(all.begin(), all.end(), 0u);
      MetricFinder finder(*samples, k);
      std::mt19937 random(11);
      std::uniform_real_distribution<float> uniform(-0.5f, 1.5f);
      for (const double ratio : {1.0, 3.0, 30.0, 1e4})
        for (const double angle : {0.0, 0.7})
          for (int i = 0; i < 6; ++i) {
            const Position& near = samples->getPositions()[static_cast<std::size_t>(
                random() % samples->size())];
            const float far = i == 5 ? 300.0f : 0.01f;
            const Position point{{near[0] + far * uniform(random),
                                  near[1] + far * uniform(random),
                                  near[2] + far * uniform(random)}};
            const Eigen::Matrix3d metric = makeMetric(ratio, angle);
            const auto& found = finder.find(point, metric);
            auto expected = sqDistances(*samples, point, metric, all);
            expected.resize(std::min(k, expected.size()));
            const auto sq_dists = sqDistances(*samples, point, metric, found);
            ASSERT_EQ(expected.size(), sq_dists.size());
            for (std::size_t j = 0; j < expected.size(); ++j)
              ASSERT_NEAR(expected[j], sq_dists[j], 1e-12 * expected.back())
                  << layout << ' ' << count << ' ' << ratio << ' ' << j;
            EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
            expectIn(finder.getSearched(), *samples, found);
          }
    }
}

/** Equally far samples are taken by lower index: all distances are exact here. */
TEST(MetricFinder, TakesTheLowerIndicesOfEqualDistances)
{
  const auto samples = makeSamples(makePositions("lattice", 2048));
  const Eigen::Matrix3d metric = Eigen::Vector3d(1.0, 1.0, 0.25).asDiagonal();
  MetricFinder finder(*samples, k);
  for (std::size_t at = 0; at < samples->size(); at += 97) {
    const Position& point = samples->getPositions()[at];
    std::vector<std::pair<double, std::uint32_t>> all;
    for (std::uint32_t i = 0; i < samples->size(); ++i)
      all.emplace_back(
          (metric * offset(point, samples->getPositions()[i])).squaredNorm(), i);
    std::sort(all.begin(), all.end());
    std::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < k; ++i)
      expected.push_back(all[i].second);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(expected, finder.find(point, metric));
  }
}

/** Points that share a metric share a copy of samples: they find what each of them
 * finds alone. */
TEST(MetricFinder, FindsTheSameWithACopyInCommon)
{
  for (const std::string layout : {"cube", "sheets", "clusters", "lattice"}) {
    const auto samples = makeSamples(makePositions(layout, 3000));
    MetricFinder shares(*samples, k, true), alone(*samples, k);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-0.05f, 0.05f);
    for (std::size_t at = 0; at < samples->size(); at += 61) {
      const Eigen::Matrix3d metric = makeMetric(at % 2 == 0 ? 5.0 : 30.0, 0.1 * at);
      const Position& near = samples->getPositions()[at];
      for (int i = 0; i < 8; ++i) {
        const Position point{{near[0] + uniform(random),
                              near[1] + uniform(random),
                              near[2] + uniform(random)}};
        const auto expected = alone.find(point, metric);
        double sq_limit = 0.0;
        for (const std::uint32_t j : expected)
          sq_limit = std::max(
              sq_limit,
              (metric * offset(point, samples->getPositions()[j])).squaredNorm());
        EXPECT_EQ(expected, shares.find(point, metric, 3.0 * sq_limit)) << layout;
        EXPECT_EQ(alone.getSearched().radius, shares.getSearched().radius);
        EXPECT_EQ(expected, alone.find(point, metric, sq_limit));
      }
    }
  }
}

TEST(MetricFinder, SaysWhetherABallIsEmpty)
{
  const auto samples = makeSamples(makePositions("clusters", 2000));
  MetricFinder finder(*samples, k);
  std::vector<std::uint32_t> all(samples->size());
  std::iota(all.begin(), all.end(), 0u);
  for (const double ratio : {1.0, 30.0})
    for (const float x : {-0.3f, 0.5f, 3.0f, 500.0f}) {
      const Position point{{x, 0.4f, 0.6f}};
      const Eigen::Matrix3d metric = makeMetric(ratio, 0.7);
      const double nearest =
          std::sqrt(sqDistances(*samples, point, metric, all).front());
      EXPECT_TRUE(finder.isEmpty(point, metric, 0.999 * nearest));
      EXPECT_FALSE(finder.isEmpty(point, metric, 1.001 * nearest));
    }
}

} // namespace test_metric_finder
