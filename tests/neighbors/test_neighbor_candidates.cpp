// SPDX-License-Identifier: BSD-3-Clause
// Candidates from discrete Voronoi diagrams against brute force on the grid.
#include "neighbors/neighbor_candidates.h"
#include "neighbors/neighborhood_finder.h"
#include "support/clouds.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace test_neighbor_candidates {

using pcl_uvol::AngleCriterion;
using pcl_uvol::GridCell;
using pcl_uvol::Report;
using pcl_uvol::SampleSet;
using pcl_uvol::VoronoiCandidates;
using pcl_uvol::VoronoiCandidateSettings;
using pcl_uvol::VoronoiGrid;
using uvol_test::buildSamples;
using uvol_test::makeCloud;

/** Candidates by the definition (thesis 2.1), every cell against every other one. */
class GridOracle {
public:
  GridOracle(const SampleSet& samples, std::uint32_t cells)
  {
    std::array<double, 3> low{{1e30, 1e30, 1e30}}, high{{-1e30, -1e30, -1e30}};
    for (const auto& position : samples.getPositions())
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min<double>(low[axis], position.x[axis]);
        high[axis] = std::max<double>(high[axis], position.x[axis]);
      }
    std::vector<std::uint32_t> all(samples.size());
    std::iota(all.begin(), all.end(), 0u);
    pcl_uvol::FeatureTransform way;
    Report report;
    const VoronoiGrid grid(pcl_uvol::GridShape::cubes(low, high, cells),
                           samples.getPositions()[0].x,
                           3,
                           all,
                           way,
                           0,
                           report);
    const auto& shape = grid.getShape();
    const auto& nearest = grid.getNearest();
    adjacent_.assign(grid.getSites().size(),
                     std::vector<bool>(grid.getSites().size(), false));
    for (std::uint64_t i = 0; i < nearest.size(); ++i)
      for (std::uint64_t j = 0; j < nearest.size(); ++j)
        if (touch(shape, i, j))
          adjacent_[nearest[i]][nearest[j]] = true;
    site_of_.resize(samples.size());
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
      const auto& position = samples.getPositions()[i];
      site_of_[i] = nearest[shape.indexOf(
          shape.cellAt({{position[0], position[1], position[2]}}))];
    }
  }

  std::vector<std::uint32_t>
  candidates(std::uint32_t sample) const
  {
    std::vector<std::uint32_t> found;
    for (std::uint32_t other = 0; other < site_of_.size(); ++other)
      if (other != sample && adjacent_[site_of_[sample]][site_of_[other]])
        found.push_back(other);
    return found;
  }

private:
  static bool
  touch(const pcl_uvol::GridShape& shape, std::uint64_t i, std::uint64_t j)
  {
    for (const std::uint64_t cells :
         {std::uint64_t{shape.cells[0]}, std::uint64_t{shape.cells[1]}}) {
      if (std::llabs(static_cast<long long>(i % cells) -
                     static_cast<long long>(j % cells)) > 1)
        return false;
      i /= cells;
      j /= cells;
    }
    return std::llabs(static_cast<long long>(i) - static_cast<long long>(j)) <= 1;
  }

  std::vector<std::vector<bool>> adjacent_; ///< site by site, itself as well
  std::vector<std::uint32_t> site_of_;
};

class CandidatesOnEveryShape : public testing::TestWithParam<std::string> {};

TEST_P(CandidatesOnEveryShape, EqualBruteForce)
{
  const auto samples = buildSamples(*makeCloud(GetParam(), 600, 2));
  std::vector<float> values(samples->size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = samples->getPositions()[i][0];
  const auto ranges = samples->getTree().computeRanges(values, 0);
  const float isovalue = values[values.size() / 2];
  for (const std::uint32_t cells : {1u, 4u, 7u}) {
    const GridOracle oracle(*samples, cells);
    Report report;
    const VoronoiCandidates candidates(
        *samples, VoronoiCandidateSettings{cells, nullptr}, 0, report);
    std::vector<std::uint32_t> found, crossing;
    for (std::uint32_t i = 0; i < samples->size(); ++i) {
      candidates.find(i, found);
      std::sort(found.begin(), found.end());
      const auto expected = oracle.candidates(i);
      ASSERT_EQ(expected, found) << "sample " << i << " of " << cells;
      if (std::any_of(expected.begin(), expected.end(), [&](auto other) {
            return (values[other] >= isovalue) != (values[i] >= isovalue);
          }))
        crossing.push_back(i);
    }
    EXPECT_EQ(crossing, candidates.findCrossing(ranges, isovalue, 0));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         CandidatesOnEveryShape,
                         testing::ValuesIn(uvol_test::cloudShapes()),
                         [](const auto& shape) {
                           return uvol_test::testNameOf(shape.param);
                         });

TEST(VoronoiCandidates, TakeFourSamplesToACellByDefault)
{
  const auto samples = buildSamples(*makeCloud("uniform", 4000, 1));
  Report report;
  const VoronoiCandidates candidates(*samples, {}, 0, report);
  EXPECT_EQ(1000u, report.getCount("cells"));
}

TEST(VoronoiCandidates, GiveTheSameNeighborhoodsOnAnyNumberOfThreads)
{
  const auto samples = buildSamples(*makeCloud("clustered", 20000, 3));
  std::vector<std::uint32_t> first;
  for (const unsigned threads : {1u, 2u, 3u, 7u}) {
    Report report;
    const VoronoiCandidates candidates(*samples, {}, threads, report);
    const auto graph = pcl_uvol::computeNaturalNeighbors(
        *samples, candidates, AngleCriterion::All, threads, report);
    if (first.empty())
      first = graph.indices;
    EXPECT_EQ(first, graph.indices) << threads;
  }
}

/** The nearest of all is a neighbour of everybody, whatever the candidates. */
TEST(VoronoiCandidates, HoldTheNearestSample)
{
  const auto samples = buildSamples(*makeCloud("uniform", 3000, 4));
  Report report;
  const VoronoiCandidates candidates(*samples, {}, 0, report);
  const auto graph = pcl_uvol::computeNaturalNeighbors(
      *samples, candidates, AngleCriterion::Kept, 0, report);
  const auto& positions = samples->getPositions();
  const auto sqDist = [&](std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += std::pow(double{positions[a].x[axis]} - positions[b].x[axis], 2);
    return sum;
  };
  for (std::uint32_t i = 0; i < samples->size(); ++i) {
    std::uint32_t nearest = i == 0 ? 1 : 0;
    for (std::uint32_t j = 0; j < samples->size(); ++j)
      if (j != i && sqDist(i, j) < sqDist(i, nearest))
        nearest = j;
    ASSERT_GT(graph[i].size(), 0u);
    EXPECT_EQ(nearest, *graph[i].begin());
  }
}

TEST(VoronoiCandidates, RefuseGridsThatAreTooLarge)
{
  const auto samples = buildSamples(*makeCloud("uniform", 100, 4));
  Report report;
  for (const std::uint32_t cells : {9000u, 20000u})
    EXPECT_THROW(VoronoiCandidates(
                     *samples, VoronoiCandidateSettings{cells, nullptr}, 0, report),
                 pcl_uvol::InvalidArgument);
}

/** All but two of 5000 samples lie in one cell: 5000 candidates each. */
TEST(VoronoiCandidates, RefuseDenseCellsAndReportTheNumber)
{
  auto cloud = makeCloud("uniform", 5000, 4);
  for (auto& point : *cloud)
    point.getVector3fMap() *= 1e-3f;
  (*cloud)[0].getVector3fMap().setConstant(10.0f);
  (*cloud)[1].getVector3fMap().setConstant(-10.0f);
  const auto samples = buildSamples(*cloud);
  Report report;
  EXPECT_EQ("too_many_candidates", uvol_test::codeOf<pcl_uvol::InvalidArgument>([&] {
              const VoronoiCandidates candidates(*samples, {}, 0, report);
            }));
}

} // namespace test_neighbor_candidates
