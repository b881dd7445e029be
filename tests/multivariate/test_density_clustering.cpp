// SPDX-License-Identifier: BSD-3-Clause
// Clusters that were planted are found again, whatever the order, the units, the
// threads (thesis 2.6).
#include "multivariate/cluster_attributes.h"
#include "multivariate/planted_clusters.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace test_density_clustering {

using namespace uvol_test;
using pcl_uvol::Clustering;
using pcl_uvol::ClusteringParameters;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Report;

/** Agreement with planted clusters, in the adjusted Rand index. */
constexpr double least_agreement = 0.95;

Clustering
cluster(std::size_t columns,
        const std::vector<float>& values,
        const ClusteringParameters& parameters = {},
        unsigned threads = 0)
{
  Report report;
  return pcl_uvol::detail::clusterAttributes(
      tableOf(columns, values), parameters, threads, report);
}

/** Points evenly over an interval, in 1-D. */
void
addRow(std::vector<float>& values, double begin, double step, int count)
{
  for (int i = 0; i < count; ++i)
    values.push_back(static_cast<float>(begin + step * i));
}

class PlantedIn : public testing::TestWithParam<std::size_t> {};

TEST_P(PlantedIn, ManyDimensionsAreFoundAgain)
{
  const std::size_t columns = GetParam();
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const auto planted = plantClusters(columns, 400, seed);
    const auto found = cluster(columns, planted.values);
    EXPECT_GE(adjustedRandIndex(planted.labels, found.labels), least_agreement) << seed;
    EXPECT_EQ(*std::max_element(found.labels.begin(), found.labels.end()), 3) << seed;
    // Clusters are sorted by decreasing size, as they were planted.
    for (const std::size_t first : {0, 700, 1300, 1800}) {
      EXPECT_EQ(found.labels[first + 9], planted.labels[first + 9]) << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Columns, PlantedIn, testing::Values(3, 5, 8));

TEST(DensityClustering, LeavesNoiseOut)
{
  const auto planted = plantClusters(5, 400, 1);
  const auto found = cluster(5, planted.values);
  const auto noise = std::count(found.labels.begin() + 2200, found.labels.end(), -1);
  EXPECT_GE(noise, 300);
  // The rest lies about the clusters, where it is hardly a part of them.
  double of_noise = 0.0, of_members = 0.0;
  for (std::size_t i = 0; i < found.labels.size(); ++i)
    (i < 2200 ? of_members : of_noise) += found.probabilities[i];
  EXPECT_LT(of_noise / 400, 0.1);
  EXPECT_GT(of_members / 2200, 0.4);
  for (std::size_t i = 0; i < found.labels.size(); ++i) {
    EXPECT_EQ(found.labels[i] < 0, found.probabilities[i] == 0.0f) << i;
    ASSERT_GE(found.probabilities[i], 0.0f);
    ASSERT_LE(found.probabilities[i], 1.0f);
  }
}

TEST(DensityClustering, ProbabilityFallsTowardsTheRim)
{
  const auto planted = plantClusters(3, 0, 1);
  const auto found = cluster(3, planted.values);
  double inside = 0.0, outside = 0.0;
  int count_inside = 0, count_outside = 0;
  for (std::size_t i = 0; i < 700; ++i) {
    const double distance = std::hypot(planted.values[3 * i] + 6.0,
                                       planted.values[3 * i + 1] + 6.0,
                                       planted.values[3 * i + 2] + 6.0);
    (distance < 0.2 ? inside : outside) += found.probabilities[i];
    ++(distance < 0.2 ? count_inside : count_outside);
  }
  ASSERT_GT(count_inside, 50);
  EXPECT_GT(inside / count_inside, outside / count_outside + 0.2);
  const auto& probabilities = found.probabilities;
  EXPECT_EQ(*std::max_element(probabilities.begin(), probabilities.begin() + 700),
            1.0f);
}

TEST(DensityClustering, TreeIsThatOfTheHierarchy)
{
  const auto found = cluster(3, plantClusters(3, 400, 2).values);
  ASSERT_FALSE(found.tree.empty());
  const auto& root = found.tree.front();
  EXPECT_EQ(root.parent, -1);
  EXPECT_EQ(root.birth_density, 0.0);
  EXPECT_EQ(root.size, 2600u);
  EXPECT_EQ(root.label, -1);
  std::vector<std::uint32_t> of_children(found.tree.size(), 0);
  std::vector<int> children(found.tree.size(), 0);
  std::set<std::int32_t> labels;
  for (std::size_t c = 0; c < found.tree.size(); ++c) {
    const auto& node = found.tree[c];
    EXPECT_LE(node.birth_density, node.death_density) << c;
    EXPECT_GE(node.stability, 0.0) << c;
    EXPECT_GE(node.size, 50u) << "the root of 2600";
    if (node.label >= 0) {
      EXPECT_TRUE(labels.insert(node.label).second) << c;
    }
    if (c == 0)
      continue;
    ASSERT_GE(node.parent, 0);
    ASSERT_LT(node.parent, static_cast<std::int32_t>(c));
    const auto parent = static_cast<std::size_t>(node.parent);
    EXPECT_EQ(node.birth_density, found.tree[parent].death_density) << c;
    of_children[parent] += node.size;
    ++children[parent];
  }
  for (std::size_t c = 0; c < found.tree.size(); ++c) {
    EXPECT_LE(of_children[c], found.tree[c].size) << c;
    EXPECT_NE(children[c], 1) << c;
  }
  for (const auto& node : found.tree)
    if (node.label >= 0) {
      EXPECT_EQ(static_cast<std::uint32_t>(
                    std::count(found.labels.begin(), found.labels.end(), node.label)),
                node.size);
    }
}

TEST(DensityClustering, StabilityIsTheExcessOfMass)
{
  // Two rows of 20 points, steps of 1/4 and 1/2, 16 apart; k = 1, so that distances are
  // the steps.
  std::vector<float> values;
  addRow(values, 0.0, 0.25, 20);
  addRow(values, 20.75, 0.5, 20);
  ClusteringParameters parameters;
  parameters.neighbors = 1;
  const auto found = cluster(1, values, parameters);
  ASSERT_EQ(found.tree.size(), 3u);
  EXPECT_DOUBLE_EQ(found.tree[0].death_density, 1.0 / 16);
  EXPECT_DOUBLE_EQ(found.tree[0].stability, 40.0 / 16);
  std::vector<double> stabilities = {found.tree[1].stability, found.tree[2].stability};
  std::sort(stabilities.begin(), stabilities.end());
  EXPECT_DOUBLE_EQ(stabilities[0], 20 * (2.0 - 1.0 / 16));
  EXPECT_DOUBLE_EQ(stabilities[1], 20 * (4.0 - 1.0 / 16));
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(found.labels[i], i < 20 ? 0 : 1) << "equal sizes: by first member";
    EXPECT_EQ(found.probabilities[i], 1.0f);
  }
}

TEST(DensityClustering, PersistenceWeighsParentsAgainstChildren)
{
  // Pairs of rows: far apart they are clusters, close together their union is one.
  for (const bool is_apart : {false, true}) {
    std::vector<float> values;
    addRow(values, 0.0, 0.25, 20);
    addRow(values, is_apart ? 12.0 : 5.125, 0.25, 20);
    addRow(values, 100.0, 0.25, 30);
    ClusteringParameters parameters;
    parameters.neighbors = 1;
    const auto found = cluster(1, values, parameters);
    EXPECT_EQ(*std::max_element(found.labels.begin(), found.labels.end()),
              is_apart ? 2 : 1);
    EXPECT_EQ(found.tree.size(), 5u);
  }
}

TEST(DensityClustering, ChanceMakesNoClusters)
{
  for (const std::size_t columns : {1u, 2u, 3u, 4u})
    for (const std::size_t count : {300u, 1000u, 3000u})
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        uvol_test::Random random(seed);
        std::vector<float> values;
        for (std::size_t i = 0; i < count * columns; ++i)
          values.push_back(static_cast<float>(random.uniform()));
        const auto found = cluster(columns, values);
        EXPECT_EQ(-1, *std::max_element(found.labels.begin(), found.labels.end()))
            << columns << " columns, " << count << " points, seed " << seed;
      }
}

TEST(DensityClustering, ADenseSpotInUniformNoiseIsFound)
{
  uvol_test::Random random(1);
  std::vector<float> values;
  for (std::size_t i = 0; i < 2000 * 3; ++i)
    values.push_back(static_cast<float>(random.uniform()));
  for (std::size_t i = 0; i < 100 * 3; ++i)
    values.push_back(static_cast<float>(0.4 + 0.1 * random.uniform()));
  Report report;
  const Clustering found =
      pcl_uvol::detail::clusterAttributes(tableOf(3, values), {}, 0, report);
  for (std::size_t i = 2000; i < 2100; ++i)
    EXPECT_EQ(0, found.labels[i]);
  EXPECT_EQ(0, *std::max_element(found.labels.begin(), found.labels.end()));
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_EQ("mostly_noise", report.warnings[0].code);
  EXPECT_EQ(static_cast<double>(report.getCount("noise")),
            uvol_test::numberOf(report.warnings[0], "noise"));
}

TEST(DensityClustering, CutsAtADistance)
{
  std::vector<float> values;
  addRow(values, 0.0, 0.25, 20);
  addRow(values, 20.75, 0.5, 30);
  addRow(values, 100.0, 1.0, 40);
  ClusteringParameters parameters;
  parameters.neighbors = 1;
  const auto found_at = [&](double distance) {
    parameters.cut_distance = distance;
    return cluster(1, values, parameters);
  };
  const auto all = found_at(1000.0);
  EXPECT_EQ(std::count(all.labels.begin(), all.labels.end(), 0), 90);
  EXPECT_EQ(all.tree.front().label, 0);
  const auto two = found_at(20.0);
  EXPECT_EQ(std::count(two.labels.begin(), two.labels.end(), 0), 50);
  EXPECT_EQ(std::count(two.labels.begin(), two.labels.end(), 1), 40);
  const auto three = found_at(1.0); // edges as long as the cut hold
  EXPECT_EQ(std::count(three.labels.begin(), three.labels.end(), 0), 40);
  EXPECT_EQ(std::count(three.labels.begin(), three.labels.end(), 1), 30);
  EXPECT_EQ(std::count(three.labels.begin(), three.labels.end(), 2), 20);
  const auto dense = found_at(0.3);
  EXPECT_EQ(std::count(dense.labels.begin(), dense.labels.end(), 0), 20);
  EXPECT_EQ(std::count(dense.labels.begin(), dense.labels.end(), -1), 70);
  const auto none = found_at(0.1);
  EXPECT_EQ(std::count(none.labels.begin(), none.labels.end(), -1), 90);
}

TEST(DensityClustering, CutLeavesOutWhatIsFartherOff)
{
  std::vector<float> values;
  addRow(values, 0.0, 0.25, 20);
  values.push_back(6.75f); // 2 off the row
  ClusteringParameters parameters;
  parameters.neighbors = 1;
  parameters.cut_distance = 1.5;
  const auto found = cluster(1, values, parameters);
  EXPECT_EQ(std::count(found.labels.begin(), found.labels.end(), 0), 20);
  EXPECT_EQ(found.labels.back(), -1);
  EXPECT_EQ(found.probabilities.back(), 0.0f);
  parameters.cut_distance = 2.0;
  EXPECT_EQ(cluster(1, values, parameters).labels.back(), 0);
}

TEST(DensityClustering, AnyNumberOfThreadsIsTheSame)
{
  const auto planted = plantClusters(5, 6000, 1);
  const auto one = cluster(5, planted.values, {}, 1);
  for (const unsigned threads : {2u, 3u, 7u}) {
    const auto many = cluster(5, planted.values, {}, threads);
    EXPECT_EQ(one.labels, many.labels);
    EXPECT_EQ(one.probabilities, many.probabilities);
    ASSERT_EQ(one.tree.size(), many.tree.size());
    for (std::size_t c = 0; c < one.tree.size(); ++c) {
      EXPECT_EQ(one.tree[c].parent, many.tree[c].parent);
      EXPECT_EQ(one.tree[c].birth_density, many.tree[c].birth_density);
      EXPECT_EQ(one.tree[c].death_density, many.tree[c].death_density);
      EXPECT_EQ(one.tree[c].stability, many.tree[c].stability);
      EXPECT_EQ(one.tree[c].label, many.tree[c].label);
    }
  }
}

/** Clusters of planted points, and of a lattice, where many distances are equal. */
TEST(DensityClustering, AnyOrderOfTheInputIsTheSame)
{
  auto planted = plantClusters(3, 400, 1);
  auto lattice = planted;
  for (float& value : lattice.values)
    value = std::round(4.0f * value);
  for (const auto& points : {planted, lattice}) {
    const std::size_t count = points.labels.size();
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [](auto a, auto b) {
      return pcl_uvol::mixBits(a) < pcl_uvol::mixBits(b);
    });
    std::vector<float> values;
    for (const std::uint32_t i : order)
      values.insert(values.end(), &points.values[3 * i], &points.values[3 * i] + 3);
    const auto expected = cluster(3, points.values);
    const auto found = cluster(3, values);
    ASSERT_EQ(expected.tree.size(), found.tree.size());
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(found.labels[i], expected.labels[order[i]]);
      ASSERT_EQ(found.probabilities[i], expected.probabilities[order[i]]);
    }
  }
}

TEST(DensityClustering, DuplicatesHaveTheHighestDensity)
{
  // Two places of 50 points and a row between them.
  std::vector<float> values(50, 0.0f);
  values.insert(values.end(), 50, 10.0f);
  addRow(values, 2.0, 0.5, 13);
  for (const std::size_t k : {0, 5}) {
    ClusteringParameters parameters;
    parameters.neighbors = k;
    const auto found = cluster(1, values, parameters);
    for (std::size_t i = 0; i < 100; ++i) {
      EXPECT_EQ(found.labels[i], i < 50 ? 0 : 1) << i;
      EXPECT_EQ(found.probabilities[i], 1.0f) << i;
    }
    for (const auto& node : found.tree) {
      EXPECT_TRUE(std::isfinite(node.death_density));
      EXPECT_TRUE(std::isfinite(node.stability));
    }
  }
}

/** What is found among few or equal points, and how often it warns. */
struct Few {
  std::size_t points;
  bool allow_single_cluster;
  int clusters;
};

TEST(DensityClustering, FewOrEqualPointsGiveAWarningOrOneCluster)
{
  for (const Few few : {Few{1, false, 0},
                        Few{1, true, 0},
                        Few{2, false, 0},
                        Few{9, true, 0},
                        Few{10, false, 0},
                        Few{10, true, 1},
                        Few{500, false, 0},
                        Few{500, true, 1}}) {
    ClusteringParameters parameters;
    parameters.allow_single_cluster = few.allow_single_cluster;
    Report report;
    const auto found = pcl_uvol::detail::clusterAttributes(
        tableOf(2, std::vector<float>(2 * few.points, 1.0f)), parameters, 0, report);
    ASSERT_EQ(found.labels.size(), few.points);
    EXPECT_EQ(report.getCount("points"), few.points);
    EXPECT_EQ(report.getCount("clusters"), static_cast<std::uint64_t>(few.clusters));
    EXPECT_EQ(report.getCount("noise"), few.clusters > 0 ? 0 : few.points);
    ASSERT_EQ(report.warnings.size(), few.clusters > 0 ? 0u : 1u);
    EXPECT_EQ(found.probabilities.front(), few.clusters > 0 ? 1.0f : 0.0f);
    if (few.clusters == 0) {
      EXPECT_EQ("no_clusters", report.warnings.front().code);
    }
  }
}

TEST(DensityClustering, TwoPointsMayBeACluster)
{
  ClusteringParameters parameters;
  parameters.min_cluster_size = 2;
  const auto found = cluster(1, {0.0f, 1.0f, 100.0f, 101.0f}, parameters);
  EXPECT_EQ(found.labels, (std::vector<std::int32_t>{-1, -1, -1, -1}))
      << "core distances reach to all others";
  parameters.neighbors = 1;
  const auto pairs = cluster(1, {0.0f, 1.0f, 100.0f, 101.0f}, parameters);
  EXPECT_EQ(pairs.labels, (std::vector<std::int32_t>{0, 0, 1, 1}));
}

TEST(DensityClustering, BadParametersThrow)
{
  const auto expect_bad = [](const ClusteringParameters& parameters) {
    EXPECT_THROW(cluster(1, {0.0f, 1.0f}, parameters), InvalidArgument);
  };
  ClusteringParameters parameters;
  parameters.neighbors = 1001;
  expect_bad(parameters);
  parameters = {};
  parameters.min_cluster_size = 1;
  expect_bad(parameters);
  parameters = {};
  parameters.cut_distance = -1.0;
  expect_bad(parameters);
  parameters.cut_distance = std::numeric_limits<double>::quiet_NaN();
  expect_bad(parameters);
  EXPECT_THROW(cluster(1, {}), InvalidArgument);
}

} // namespace test_density_clustering
