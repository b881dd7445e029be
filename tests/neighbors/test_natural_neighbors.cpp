// SPDX-License-Identifier: BSD-3-Clause
// Touching cells, angle criterion and natural neighbours against brute force, and where
// coordinates coincide.
#include "neighbors/angle_criterion.h"
#include "neighbors/kd_tree.h"
#include "neighbors/neighborhood_finder.h"
#include "neighbors/sample_set.h"
#include "support/clouds.h"
#include "support/neighbor_oracle.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace test_natural_neighbors {

using pcl_uvol::AngleCriterion;
using pcl_uvol::Position;
using pcl_uvol::SampleSet;
using uvol_test::buildSamples;
using uvol_test::makeCloud;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;

bool
sameBytes(const std::vector<Position>& a, const std::vector<Position>& b)
{
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(Position)) == 0;
}

class OnEveryShape
    : public testing::TestWithParam<std::tuple<std::string, std::size_t>> {
protected:
  Cloud::Ptr cloud_ = makeCloud(std::get<0>(GetParam()), std::get<1>(GetParam()), 7);
};

TEST_P(OnEveryShape, LeafOrderAndTouchingCellsEqualBruteForce)
{
  const auto samples = buildSamples(*cloud_);
  const uvol_test::NeighborOracle oracle(samples->getPositions());
  ASSERT_TRUE(sameBytes(oracle.positions(), samples->getPositions()));
  std::vector<std::uint32_t> touching;
  for (std::uint32_t i = 0; i < samples->size(); ++i) {
    samples->getTree().findTouching(samples->getPositions(), i, touching);
    std::sort(touching.begin(), touching.end());
    ASSERT_EQ(oracle.touching(i), touching) << "sample " << i;
  }
}

TEST_P(OnEveryShape, NeighborhoodsEqualBruteForceInBothReadings)
{
  const auto samples = buildSamples(*cloud_);
  const uvol_test::NeighborOracle oracle(samples->getPositions());
  for (const auto criterion : {AngleCriterion::Kept, AngleCriterion::All}) {
    pcl_uvol::Report report;
    const auto graph = pcl_uvol::computeNaturalNeighbors(
        *samples, pcl_uvol::TouchingCells(*samples), criterion, 0, report);
    ASSERT_EQ(samples->size(), graph.size());
    for (std::uint32_t i = 0; i < samples->size(); i += 7) {
      const std::vector<std::uint32_t> row(graph[i].begin(), graph[i].end());
      ASSERT_EQ(oracle.neighbors(i, criterion), row) << "sample " << i;
    }
  }
}

TEST_P(OnEveryShape, CrossingSamplesAreThoseThatTouchTheOtherSide)
{
  const auto samples = buildSamples(*cloud_);
  std::vector<float> values;
  for (std::size_t i = 0; i < samples->size(); ++i)
    values.push_back((*cloud_)[samples->getInputIndex(i)].intensity);
  const auto ranges = samples->getTree().computeRanges(values, 0);
  for (const float isovalue : {0.3f, values[values.size() / 2]}) {
    std::vector<std::uint32_t> expected, touching;
    for (std::uint32_t i = 0; i < samples->size(); ++i) {
      samples->getTree().findTouching(samples->getPositions(), i, touching);
      if (std::any_of(touching.begin(), touching.end(), [&](std::uint32_t j) {
            return (values[i] >= isovalue) != (values[j] >= isovalue);
          }))
        expected.push_back(i);
    }
    EXPECT_EQ(
        expected,
        samples->getTree().findCrossing(samples->getPositions(), ranges, isovalue, 0));
  }
}

TEST_P(OnEveryShape, TreeDependsNeitherOnInputOrderNorOnThreads)
{
  const auto samples = buildSamples(*cloud_, 1);
  Cloud shuffled = *cloud_;
  std::mt19937_64 generator(3);
  std::shuffle(shuffled.begin(), shuffled.end(), generator);
  EXPECT_TRUE(
      sameBytes(samples->getPositions(), buildSamples(shuffled, 2)->getPositions()));
}

INSTANTIATE_TEST_SUITE_P(
    NaturalNeighbors,
    OnEveryShape,
    testing::Combine(testing::ValuesIn(uvol_test::cloudShapes()),
                     testing::Values<std::size_t>(2, 3, 100, 1331, 4913)),
    [](const auto& shape_and_size) {
      return uvol_test::testNameOf(std::get<0>(shape_and_size.param)) + "_" +
             std::to_string(std::get<1>(shape_and_size.param));
    });

TEST(NaturalNeighbors, UniformSamplesHaveFourteenCandidatesAndFiveNeighbors)
{
  const auto samples = buildSamples(*makeCloud("uniform", 200000, 1));
  pcl_uvol::Report report;
  pcl_uvol::computeNaturalNeighbors(
      *samples, pcl_uvol::TouchingCells(*samples), AngleCriterion::Kept, 0, report);
  const auto mean = [&](const char* count) {
    return static_cast<double>(report.getCount(count)) /
           static_cast<double>(samples->size());
  };
  EXPECT_NEAR(13.8, mean("candidates"), 0.2); // thesis Table 2.8: 11, with wider cells
  EXPECT_NEAR(5.1, mean("neighbors"), 0.1);   // thesis Table 2.8: 5
  report = pcl_uvol::Report();
  pcl_uvol::computeNaturalNeighbors(
      *samples, pcl_uvol::TouchingCells(*samples), AngleCriterion::All, 0, report);
  EXPECT_NEAR(4.5, mean("neighbors"), 0.3); // varies with the shape of the cells
}

/** Touching by coordinates alone gives up to 130 candidates here, and more with more.
 */
TEST(NaturalNeighbors, EqualCoordinatesKeepCandidatesBounded)
{
  for (const char* shape :
       {"lattice", "three planes", "drill holes", "one plane and noise"}) {
    const auto samples = buildSamples(*makeCloud(shape, 1000000, 5));
    pcl_uvol::Report report;
    pcl_uvol::computeNaturalNeighbors(
        *samples, pcl_uvol::TouchingCells(*samples), AngleCriterion::Kept, 0, report);
    EXPECT_LT(report.getCount("candidates"), 30 * samples->size()) << shape;
  }
}

TEST(NaturalNeighbors, DuplicatesAreMergedAndRemembered)
{
  Cloud cloud = *makeCloud("uniform", 50, 1);
  cloud.push_back(cloud[3]);
  cloud.push_back(cloud[40]);
  cloud.push_back(cloud[3]);
  const auto samples = buildSamples(cloud);
  EXPECT_EQ(50u, samples->size());
  ASSERT_EQ(2u, samples->getMerged().size());
  for (const auto& merged : samples->getMerged()) {
    const std::vector<std::uint32_t> members(merged.members.begin(),
                                             merged.members.end());
    EXPECT_EQ((members.front() == 3 ? std::vector<std::uint32_t>{3, 50, 52}
                                    : std::vector<std::uint32_t>{40, 51}),
              members);
    EXPECT_EQ(members.front(), samples->getInputIndex(merged.sample));
  }
}

/** More points than one task builds a tree of, at the same places in any order. */
TEST(NaturalNeighbors, ManyDuplicatesGiveTheTreeOfTheDistinctOnes)
{
  const Cloud distinct = *makeCloud("uniform", 20000, 1);
  const auto expected = buildSamples(distinct);
  for (const std::size_t places :
       {std::size_t(20000), std::size_t(1), std::size_t(7)}) {
    Cloud cloud;
    for (std::size_t i = 0; i < 3 * distinct.size(); ++i)
      cloud.push_back(distinct[i % places]);
    std::shuffle(cloud.begin(), cloud.end(), std::mt19937_64(5));
    const auto samples = buildSamples(cloud, 2);
    ASSERT_EQ(places, samples->size());
    if (places == distinct.size()) {
      EXPECT_TRUE(sameBytes(expected->getPositions(), samples->getPositions()));
    }
    std::size_t members = 0, last = 0;
    for (const auto& merged : samples->getMerged()) {
      EXPECT_LE(last, merged.sample);
      last = merged.sample;
      members += merged.members.size();
      EXPECT_TRUE(std::is_sorted(merged.members.begin(), merged.members.end()));
      EXPECT_EQ(*merged.members.begin(), samples->getInputIndex(merged.sample));
      for (const auto member : merged.members)
        ASSERT_EQ(cloud[member].x * samples->getUnit().factor,
                  samples->getPositions()[merged.sample][0]);
    }
    EXPECT_EQ(cloud.size(), members);
  }
}

/** A lattice, where many neighbours are equally far, in any order of its points. */
TEST(NaturalNeighbors, RowsAreSortedByDistanceAndIndex)
{
  const auto cloud = makeCloud("lattice", 1000, 1);
  std::shuffle(cloud->begin(), cloud->end(), std::mt19937_64(5));
  pcl_uvol::NaturalNeighbors<pcl::PointXYZI> natural;
  natural.setInputCloud(cloud);
  pcl_uvol::NeighborGraph graph;
  natural.compute(graph);
  std::size_t ties = 0;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    std::pair<double, std::uint32_t> last(0.0, 0);
    for (const auto j : graph[i]) {
      const std::pair<double, std::uint32_t> next(
          ((*cloud)[i].getVector3fMap().cast<double>() -
           (*cloud)[j].getVector3fMap().cast<double>())
              .squaredNorm(),
          j);
      EXPECT_LT(last, next);
      ties += last.first == next.first ? 1 : 0;
      last = next;
    }
  }
  EXPECT_GT(ties, 100u);
}

TEST(NaturalNeighbors, NegativeZeroEqualsZero)
{
  Cloud cloud(2, 1);
  cloud[0].x = 0.0f;
  cloud[1].x = -0.0f;
  EXPECT_EQ(1u, buildSamples(cloud)->size());
}

TEST(NaturalNeighbors, StageSpeaksInIndicesOfTheInputCloud)
{
  const auto cloud = makeCloud("uniform", 300, 2);
  (*cloud)[10].y = std::numeric_limits<float>::quiet_NaN();
  pcl_uvol::NaturalNeighbors<pcl::PointXYZI> natural;
  natural.setInputCloud(cloud);
  pcl_uvol::NeighborGraph graph;
  natural.compute(graph);
  ASSERT_EQ(cloud->size(), graph.size());
  EXPECT_EQ(0u, graph[10].size());
  EXPECT_EQ(1u, natural.getReport().getCount("non_finite"));
  for (std::size_t i = 0; i < graph.size(); ++i) {
    double last = 0.0;
    for (const auto j : graph[i]) {
      EXPECT_NE(10u, j);
      const double sq_dist = std::pow((*cloud)[i].x - (*cloud)[j].x, 2.0) +
                             std::pow((*cloud)[i].y - (*cloud)[j].y, 2.0) +
                             std::pow((*cloud)[i].z - (*cloud)[j].z, 2.0);
      EXPECT_GE(sq_dist, last);
      last = sq_dist;
    }
  }
}

TEST(NaturalNeighbors, BadInputThrows)
{
  pcl_uvol::NaturalNeighbors<pcl::PointXYZ> natural;
  pcl_uvol::NeighborGraph graph;
  EXPECT_THROW(natural.compute(graph), pcl_uvol::InvalidArgument);
  pcl::PointCloud<pcl::PointXYZ>::Ptr nowhere(new pcl::PointCloud<pcl::PointXYZ>);
  nowhere->resize(3);
  for (auto& point : *nowhere)
    point.x = std::numeric_limits<float>::infinity();
  natural.setInputCloud(nowhere);
  EXPECT_THROW(natural.compute(graph), pcl_uvol::InvalidArgument);
}

/** The thesis's grid case: the axis neighbours and the space diagonals stay (2.3). */
TEST(AngleFilter, KeepsAxesAndDiagonalsOfAGrid)
{
  std::vector<Position> positions;
  std::vector<std::uint32_t> candidates;
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        if (i != 0 || j != 0 || k != 0)
          candidates.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(
            {{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)}});
      }
  pcl_uvol::AngleFilter(positions, AngleCriterion::Kept).apply(13, candidates);
  ASSERT_EQ(14u, candidates.size());
  for (const auto index : candidates) {
    const Position& p = positions[index];
    const float sq_dist = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    EXPECT_TRUE(sq_dist == 1.0f || sq_dist == 3.0f);
  }
}

} // namespace test_natural_neighbors
