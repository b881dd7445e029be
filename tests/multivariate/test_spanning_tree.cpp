// SPDX-License-Identifier: BSD-3-Clause
// Minimum spanning trees against Prim's method on all pairs (thesis 2.6).
#include "multivariate/planted_clusters.h"
#include "multivariate/spanning_tree.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>

namespace test_spanning_tree {

using namespace uvol_test;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Report;
using pcl_uvol::SpanningEdge;

/** Distances are sums of float squares. */
constexpr double relative_rounding = 1e-6;

std::vector<float>
makePoints(const std::string& shape, std::size_t columns, std::size_t count)
{
  Random random(count * 10 + columns);
  std::vector<float> values(count * columns);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < columns; ++axis) {
      float& value = values[i * columns + axis];
      const double number = random.uniform();
      if (shape == "uniform")
        value = static_cast<float>(number);
      else if (shape == "lattice") // 3 steps per axis, many of them taken twice
        value = static_cast<float>(std::floor(3.0 * number));
      else if (shape == "clustered")
        value = static_cast<float>(10.0 * static_cast<double>(i % 5) +
                                   std::pow(0.1, i % 5) * number);
      else if (shape == "duplicates") // 5 places
        value = static_cast<float>((i % 5) * (axis + 1));
      else if (shape == "equal")
        value = 3.0f;
      else if (shape == "line") // far from the origin
        value = static_cast<float>(i) + 1e4f;
    }
  return values;
}

double
distanceOf(const std::vector<float>& values,
           std::size_t columns,
           std::size_t i,
           std::size_t j)
{
  double sum = 0.0;
  for (std::size_t axis = 0; axis < columns; ++axis) {
    const double d = static_cast<double>(values[i * columns + axis]) -
                     static_cast<double>(values[j * columns + axis]);
    sum += d * d;
  }
  return std::sqrt(sum);
}

/** Distance to the k-th nearest other point by sorting. */
std::vector<double>
coresOf(const std::vector<float>& values, std::size_t columns, std::size_t k)
{
  const std::size_t count = values.size() / columns;
  std::vector<double> cores(count, 0.0);
  for (std::size_t i = 0; i < count && k > 0; ++i) {
    std::vector<double> distances;
    for (std::size_t j = 0; j < count; ++j)
      if (j != i)
        distances.push_back(distanceOf(values, columns, i, j));
    std::sort(distances.begin(), distances.end());
    cores[i] = distances[std::min(k, distances.size()) - 1];
  }
  return cores;
}

/** Weights of the spanning tree by Prim, ascending. */
std::vector<double>
primWeights(const std::vector<float>& values,
            std::size_t columns,
            const std::vector<double>& cores)
{
  const std::size_t count = values.size() / columns;
  std::vector<double> nearest(count, std::numeric_limits<double>::infinity());
  std::vector<bool> is_in(count, false);
  std::vector<double> weights;
  std::size_t last = 0;
  is_in[0] = true;
  while (weights.size() + 1 < count) {
    std::size_t next = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (is_in[i])
        continue;
      nearest[i] = std::min(
          nearest[i],
          std::max({distanceOf(values, columns, i, last), cores[i], cores[last]}));
      if (next == count || nearest[i] < nearest[next])
        next = i;
    }
    weights.push_back(nearest[next]);
    is_in[next] = true;
    last = next;
  }
  std::sort(weights.begin(), weights.end());
  return weights;
}

/** Whether edges connect all points, which with one edge less than points is a tree. */
bool
connectAll(const std::vector<SpanningEdge>& edges, std::size_t count)
{
  std::vector<std::size_t> parents(count);
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  const auto root_of = [&](std::size_t point) {
    while (parents[point] != point)
      point = parents[point];
    return point;
  };
  std::size_t parts = count;
  for (const auto& edge : edges) {
    const std::size_t a = root_of(edge.a), b = root_of(edge.b);
    if (a == b)
      return false;
    parents[a] = b;
    --parts;
  }
  return parts == 1;
}

std::vector<SpanningEdge>
treeOf(const std::vector<float>& values,
       std::size_t columns,
       std::size_t k,
       unsigned threads = 0)
{
  Report report;
  return pcl_uvol::spanningTree(values, columns, k, threads, report);
}

void
expectTreeOfPrim(const std::vector<float>& values, std::size_t columns, std::size_t k)
{
  const std::size_t count = values.size() / columns;
  const auto cores = coresOf(values, columns, k);
  const auto expected = primWeights(values, columns, cores);
  const auto edges = treeOf(values, columns, k);
  ASSERT_EQ(edges.size(), count - 1);
  EXPECT_TRUE(connectAll(edges, count));
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto& [a, b, weight] = edges[e];
    ASSERT_LT(a, b);
    EXPECT_NEAR(weight, expected[e], relative_rounding * expected[e]) << e;
    const double reach =
        std::max({distanceOf(values, columns, a, b), cores[a], cores[b]});
    EXPECT_NEAR(weight, reach, relative_rounding * reach) << e;
    if (e > 0) {
      EXPECT_LT(std::tie(edges[e - 1].weight, edges[e - 1].a, edges[e - 1].b),
                std::tie(weight, a, b));
    }
  }
}

using Case = std::tuple<std::string, std::size_t>;

class SpanningTree : public testing::TestWithParam<Case> {};

TEST_P(SpanningTree, HasTheWeightsOfPrim)
{
  const auto& [shape, k] = GetParam();
  for (std::size_t columns = 1; columns <= 6; ++columns)
    for (const std::size_t count : {2, 17, 500}) {
      SCOPED_TRACE(std::to_string(count) + " points, " + std::to_string(columns) +
                   " columns");
      expectTreeOfPrim(makePoints(shape, columns, count), columns, k);
    }
}

std::string
nameOf(const testing::TestParamInfo<Case>& test)
{
  return std::get<0>(test.param) + "_k" + std::to_string(std::get<1>(test.param));
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         SpanningTree,
                         testing::Combine(testing::Values("uniform",
                                                          "lattice",
                                                          "clustered",
                                                          "duplicates",
                                                          "equal",
                                                          "line"),
                                          testing::Values(0, 1, 5, 12)),
                         nameOf);

TEST(SpanningTreeOf, ClustersAndNoiseHasTheWeightsOfPrim)
{
  expectTreeOfPrim(plantClusters(5, 1500, 4).values, 5, 10);
}

TEST(SpanningTreeOf, AnyNumberOfThreadsIsTheSame)
{
  for (const char* const shape : {"uniform", "lattice", "clustered", "duplicates"})
    for (const std::size_t k : {0, 4}) {
      const auto values = makePoints(shape, 3, 20000);
      const auto one = treeOf(values, 3, k, 1);
      for (const unsigned threads : {2u, 3u, 7u}) {
        const auto many = treeOf(values, 3, k, threads);
        ASSERT_EQ(one.size(), many.size());
        EXPECT_EQ(std::memcmp(one.data(), many.data(), one.size() * sizeof(one[0])), 0)
            << shape << ", k = " << k << ", " << threads << " threads";
      }
    }
}

TEST(SpanningTreeOf, UnitsOfAnySizeIsTheSame)
{
  const auto values = makePoints("uniform", 3, 500);
  const auto expected = treeOf(values, 3, 5);
  for (const int exponent : {-110, 100}) {
    auto scaled = values;
    for (float& value : scaled)
      value = std::ldexp(value, exponent);
    const auto edges = treeOf(scaled, 3, 5);
    ASSERT_EQ(edges.size(), expected.size());
    for (std::size_t e = 0; e < edges.size(); ++e)
      EXPECT_EQ(edges[e].weight, std::ldexp(expected[e].weight, exponent)) << e;
  }
}

TEST(SpanningTreeOf, PointsOfOneHugeCoordinateIsThatOfTheOthers)
{
  const auto edges = treeOf({1e38f, 0.0f, 1e38f, 1e-10f, 1e38f, 4e-10f}, 2, 0);
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_NEAR(edges[0].weight, 1e-10, 1e-16);
  EXPECT_NEAR(edges[1].weight, 3e-10, 1e-16);
}

TEST(SpanningTreeOf, HugeNumbersOfEqualPointsIsQuick)
{
  const std::vector<float> values(2 * 200000, 1.0f);
  const auto edges = treeOf(values, 2, 10);
  ASSERT_EQ(edges.size(), 199999u);
  EXPECT_TRUE(std::all_of(
      edges.begin(), edges.end(), [](const auto& edge) { return edge.weight == 0.0; }));
}

TEST(SpanningTreeOf, LessThanTwoPointsIsEmpty)
{
  EXPECT_TRUE(treeOf({}, 3, 5).empty());
  EXPECT_TRUE(treeOf({1, 2, 3}, 3, 5).empty());
}

TEST(SpanningTreeOf, BadValuesThrows)
{
  EXPECT_THROW(treeOf({1, 2, 3}, 0, 5), InvalidArgument);
  EXPECT_THROW(treeOf({1, 2, 3}, 2, 5), InvalidArgument);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(treeOf({1, 2, nan, 4}, 2, 5), InvalidArgument);
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THROW(treeOf({1, 2, infinity, 4}, 2, 5), InvalidArgument);
}

TEST(SpanningTreeOf, ReportsTimesAndProgress)
{
  Report report;
  std::vector<std::pair<std::string, double>> told;
  report.progress = [&](const std::string& step, double done) {
    told.emplace_back(step, done);
  };
  pcl_uvol::spanningTree(makePoints("uniform", 3, 5000), 3, 5, 2, report);
  ASSERT_EQ(report.milliseconds.size(), 2u);
  EXPECT_EQ(report.milliseconds[0].first, "neighbors");
  EXPECT_EQ(report.milliseconds[1].first, "spanning_tree");
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().first, "spanning_tree");
  EXPECT_DOUBLE_EQ(told.back().second, 1.0);
}

TEST(LongestSpanningEdge, IsTheLargestGap)
{
  // Two rows of unit steps, 4 apart, and a point 2.5 off the end of one.
  std::vector<pcl_uvol::Position> positions;
  for (int i = 0; i < 100; ++i) {
    positions.push_back({{static_cast<float>(i), 0.0f, 0.0f}});
    positions.push_back({{static_cast<float>(i), 4.0f, 0.0f}});
  }
  positions.push_back({{-2.5f, 0.0f, 0.0f}});
  Report report;
  EXPECT_DOUBLE_EQ(pcl_uvol::longestSpanningEdge(positions, 0, report), 4.0);
  EXPECT_EQ(pcl_uvol::longestSpanningEdge({}, 0, report), 0.0);
  EXPECT_EQ(pcl_uvol::longestSpanningEdge({{{1, 2, 3}}}, 0, report), 0.0);
}

} // namespace test_spanning_tree
