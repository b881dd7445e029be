// SPDX-License-Identifier: BSD-3-Clause
// Metrics of samples depend on what is asked for, not on what was asked for before.
#include "src/common/random.h"
#include "src/neighbors/local_metric.h"
#include <pcl_uvol/common/stage.h>

#include <gtest/gtest.h>

#include <numeric>

namespace test_local_metric {

using pcl_uvol::LocalMetricFinder;
using pcl_uvol::Position;
using pcl_uvol::SampleSet;

SampleSet::ConstPtr
makeSamples(const std::vector<Position>& places)
{
  std::vector<std::uint32_t> all(places.size());
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::Report report;
  return SampleSet::build(places[0].x, 3, all, Position{{1.0f, 1.0f, 1.0f}}, 1, report);
}

/** Random samples, a little stretched: some ratios of spacings are below any bound,
 * some above it. */
SampleSet::ConstPtr
makeRandomSamples(std::size_t count)
{
  std::vector<Position> places;
  for (std::uint64_t i = 0; i < count; ++i)
    places.push_back({{static_cast<float>(pcl_uvol::uniformAt(3, i, 0)),
                       static_cast<float>(pcl_uvol::uniformAt(3, i, 1)),
                       static_cast<float>(0.6 * pcl_uvol::uniformAt(3, i, 2))}});
  return makeSamples(places);
}

void
expectEqual(bool found,
            const LocalMetricFinder& metrics,
            bool expected,
            const LocalMetricFinder& alone)
{
  EXPECT_EQ(expected, found);
  EXPECT_EQ(alone.getRatio(), metrics.getRatio());
  EXPECT_EQ(alone.getMetric(), metrics.getMetric());
  for (const double bound : {1.1, LocalMetricFinder::even_ratio, 2.0})
    EXPECT_EQ(alone.isEven(bound), metrics.isEven(bound));
}

TEST(LocalMetric, DoesNotDependOnWhatWasAskedBefore)
{
  const auto samples = makeRandomSamples(1000);
  LocalMetricFinder used(*samples), group(*samples);
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < 1000; i += 3) {
    LocalMetricFinder first(*samples), refined(*samples);
    const double bound = i % 2 == 0 ? 2.0 : 1.1;
    group.find(used.findAnchor(i), 1.0);
    const bool by_itself = first.find(i, bound);
    const bool from_nearby = refined.refine(i, group, bound);
    found += by_itself + from_nearby;
    expectEqual(used.find(i, bound), used, by_itself, first);
    expectEqual(used.refine(i, group, bound), used, from_nearby, refined);
    expectEqual(used.find(i, bound), used, by_itself, first);
  }
  EXPECT_GT(found, 100u);
  EXPECT_LT(found, 600u);
}

/** A lattice that is stretched twice along an axis, or not at all. */
TEST(LocalMetric, IsEvenWhereSpacingsAre)
{
  for (const bool is_stretched : {false, true}) {
    std::vector<Position> places(1000);
    for (int i = 0; i < 1000; ++i) {
      const int layer = i / 100;
      places[static_cast<std::size_t>(i)] = {
          {static_cast<float>(i % 10),
           static_cast<float>(i / 10 % 10),
           static_cast<float>((is_stretched ? 2 : 1) * layer)}};
    }
    const auto samples = makeSamples(places);
    LocalMetricFinder metrics(*samples);
    for (std::uint32_t i = 0; i < 1000; ++i) {
      EXPECT_EQ(is_stretched, metrics.find(i)) << i;
      EXPECT_EQ(!is_stretched, metrics.isEven(LocalMetricFinder::even_ratio)) << i;
    }
  }
}

/** Some samples so close together that squares of their distances are 0 in float,
 * among others: no metric is found there, and none that is no number. */
TEST(LocalMetric, IsANumberWhereSamplesAreNearAndFar)
{
  for (const float size : {1e-20f, 1e-23f, 1e-30f, 1e-36f})
    for (const std::size_t close : {2, 5, 12, 20, 40}) {
      std::vector<Position> places;
      for (std::uint64_t i = 0; i < 200; ++i) {
        const float scale = i < close ? size : 1.0f;
        Position place;
        for (int axis = 0; axis < 3; ++axis)
          place[axis] = scale * static_cast<float>(pcl_uvol::uniformAt(
                                    5, i, static_cast<std::uint64_t>(axis)));
        places.push_back(place);
      }
      const auto samples = makeSamples(places);
      LocalMetricFinder metrics(*samples), nearby(*samples);
      for (std::uint32_t i = 0; i < samples->size(); ++i) {
        metrics.find(i, 1.0);
        EXPECT_TRUE(metrics.getMetric().allFinite()) << size << ' ' << close;
        nearby.find(metrics.findAnchor(i), 1.0);
        metrics.refine(i, nearby, 1.0);
        EXPECT_TRUE(metrics.getMetric().allFinite()) << size << ' ' << close;
      }
    }
}

} // namespace test_local_metric
