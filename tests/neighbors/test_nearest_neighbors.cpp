// SPDX-License-Identifier: BSD-3-Clause
// Nearest neighbours against brute force: equal distances, whatever FLANN takes among
// ties.
#include "neighbors/nearest_neighbors.h"
#include "support/clouds.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace test_nearest_neighbors {

using pcl_uvol::SampleSet;
using uvol_test::buildSamples;

float
sqDist(const SampleSet& samples, std::size_t i, std::size_t j)
{
  float sum = 0.0f; // as FLANN adds them
  for (int axis = 0; axis < 3; ++axis) {
    const float d = samples.getPositions()[i][axis] - samples.getPositions()[j][axis];
    sum += d * d;
  }
  return sum;
}

/** Neighbours whose report is of no interest. */
pcl_uvol::NeighborGraph
nearest(const SampleSet& samples, std::size_t k, unsigned threads)
{
  pcl_uvol::Report report;
  return pcl_uvol::computeNearestNeighbors(samples, k, threads, report);
}

class NearestOnEveryShape : public testing::TestWithParam<std::string> {};

TEST_P(NearestOnEveryShape, DistancesEqualBruteForce)
{
  const auto samples = buildSamples(*uvol_test::makeCloud(GetParam(), 700, 3));
  for (const std::size_t k : {std::size_t(1), std::size_t(26), samples->size() + 5}) {
    const auto graph = nearest(*samples, k, 0);
    ASSERT_EQ(samples->size(), graph.size());
    for (std::size_t i = 0; i < samples->size(); i += 11) {
      std::vector<float> expected, found;
      for (std::size_t j = 0; j < samples->size(); ++j)
        if (j != i)
          expected.push_back(sqDist(*samples, i, j));
      std::sort(expected.begin(), expected.end());
      expected.resize(std::min(k, expected.size()));
      for (const auto j : graph[i]) {
        EXPECT_NE(i, j);
        found.push_back(sqDist(*samples, i, j));
      }
      ASSERT_EQ(expected.size(), found.size());
      for (std::size_t n = 0; n < found.size(); ++n)
        ASSERT_FLOAT_EQ(expected[n], found[n]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(NearestNeighbors,
                         NearestOnEveryShape,
                         testing::ValuesIn(uvol_test::cloudShapes()),
                         [](const auto& shape) {
                           return uvol_test::testNameOf(shape.param);
                         });

TEST(NearestNeighbors, SameForAnyNumberOfThreads)
{
  const auto samples = buildSamples(*uvol_test::makeCloud("lattice", 8000, 1));
  EXPECT_EQ(nearest(*samples, 10, 1).indices, nearest(*samples, 10, 2).indices);
}

TEST(NearestNeighbors, OnePointHasNoneAndZeroIsRefused)
{
  const auto samples = buildSamples(*uvol_test::makeCloud("uniform", 1, 1));
  EXPECT_EQ(0u, nearest(*samples, 5, 0)[0].size());
  EXPECT_THROW(nearest(*samples, 0, 0), pcl_uvol::InvalidArgument);
}

} // namespace test_nearest_neighbors
