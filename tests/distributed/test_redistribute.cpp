// SPDX-License-Identifier: BSD-3-Clause
// Samples come to the owners of their pieces, in one step or in two.
#include "distributed/redistribute.h"
#include "support/clouds.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

namespace test_redistribute {

using pcl_uvol::Communicator;
using pcl_uvol::Decomposition;
using pcl_uvol::PieceOwners;
using pcl_uvol::Redistribution;
using pcl_uvol::Report;
using pcl_uvol::Samples;

Samples
makeSamples(const std::string& shape, std::size_t size)
{
  Samples samples;
  const auto cloud = uvol_test::makeCloud(shape, size, 4);
  for (const auto& point : *cloud)
    if (std::isfinite(point.x + point.y + point.z))
      samples.push({{point.x + 0.0f, point.y + 0.0f, point.z + 0.0f}},
                   point.intensity,
                   samples.size());
  return samples;
}

/** What all processes have together. */
struct Together {
  std::optional<Decomposition> decomposition;
  std::map<std::size_t, std::vector<std::uint64_t>> sources; ///< by piece, ascending

  /** \param owner of sample i among the processes */
  Together(const Samples& samples,
           int levels,
           std::size_t ranks,
           std::size_t groups,
           const std::function<std::size_t(std::size_t)>& owner)
  {
    std::mutex mutex;
    uvol_test::runRanks(ranks, [&](Communicator& communicator) {
      Samples own;
      for (std::size_t i = 0; i < samples.size(); ++i)
        if (owner(i) == communicator.rank())
          own.append(samples.span(i, 1));
      Report report;
      Redistribution found =
          redistribute(std::move(own), levels, groups, communicator, 1, report);
      const std::lock_guard lock(mutex);
      for (const auto& [piece, part] : found.samples) {
        EXPECT_EQ(communicator.rank(), found.owners.getOwner(piece));
        auto& of_piece = sources[piece];
        EXPECT_TRUE(of_piece.empty());
        for (std::size_t i = 0; i < part.size(); ++i) {
          const std::uint64_t source = part.sources[i];
          EXPECT_EQ(samples.values[source], part.values[i]);
          for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(samples.positions[source][axis], part.positions[i][axis]);
        }
        of_piece = part.sources;
        std::sort(of_piece.begin(), of_piece.end());
      }
      decomposition = std::move(found.decomposition);
    });
  }
};

void
expectEqual(const Together& expected, const Together& found)
{
  EXPECT_EQ(expected.sources, found.sources);
  const Decomposition &a = *expected.decomposition, &b = *found.decomposition;
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.getAxes(), b.getAxes());
  EXPECT_EQ(a.getSampleCount(), b.getSampleCount());
  for (std::size_t piece = 0; piece < a.size(); ++piece) {
    EXPECT_EQ(a.getBegin(piece), b.getBegin(piece));
    const auto cell = a.getCell(piece), other = b.getCell(piece);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool is_low : {true, false}) {
        const auto& plane = is_low ? cell.low[axis] : cell.high[axis];
        const auto& same = is_low ? other.low[axis] : other.high[axis];
        EXPECT_EQ(plane.coordinate, same.coordinate);
        for (int i = 0; i < 3; ++i)
          EXPECT_EQ(plane.below[i], same.below[i]);
      }
  }
}

class RedistributionOfEveryShape : public testing::TestWithParam<std::string> {};

TEST_P(RedistributionOfEveryShape, IsTheSameInTwoSteps)
{
  const Samples samples = makeSamples(GetParam(), 5000);
  const auto in_turn = [](std::size_t i) { return i % 6; };
  const Together one_step(samples, 5, 6, 1, in_turn);
  std::size_t total = 0;
  for (const auto& [piece, sources] : one_step.sources) {
    EXPECT_EQ(one_step.decomposition->getCount(piece), sources.size());
    total += sources.size();
  }
  EXPECT_EQ(samples.size(), total);
  for (const std::size_t groups : {2, 4}) {
    SCOPED_TRACE(groups);
    expectEqual(one_step, Together(samples, 5, 6, groups, in_turn));
  }
}

INSTANTIATE_TEST_SUITE_P(Clouds,
                         RedistributionOfEveryShape,
                         testing::ValuesIn(uvol_test::cloudShapes()),
                         [](const auto& shape) {
                           return uvol_test::testNameOf(shape.param);
                         });

TEST(Redistribution, DoesNotCareWhereSamplesAre)
{
  const Samples samples = makeSamples("uniform", 3000);
  const Together alone(samples, 4, 1, 1, [](std::size_t) { return 0; });
  for (const std::size_t groups : {1, 2, 4, 8}) {
    SCOPED_TRACE(groups);
    expectEqual(alone, Together(samples, 4, 8, groups, [](auto) { return 3; }));
    expectEqual(alone, Together(samples, 4, 8, groups, [](auto i) { return i / 400; }));
  }
}

/** All but one sample at one place: most groups have none. */
TEST(Redistribution, LeavesGroupsWithoutSamples)
{
  Samples samples;
  for (std::size_t i = 0; i < 100; ++i)
    samples.push({{0.5f, 0.5f, 0.5f}}, 1.0f, i);
  samples.push({{1.0f, 2.0f, 3.0f}}, 2.0f, 100);
  const auto in_turn = [](std::size_t i) { return i % 8; };
  const Together one_step(samples, 4, 8, 1, in_turn);
  expectEqual(one_step, Together(samples, 4, 8, 4, in_turn));
}

/** What each process has in between is its share of its group's. */
TEST(Redistribution, SendsAsMuchToEachProcess)
{
  const Samples samples = makeSamples("uniform", 6400);
  uvol_test::runRanks(8, [&](Communicator& communicator) {
    // Neighbors in space are neighbors in rank, as in files that another run wrote.
    Samples own;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (static_cast<std::size_t>(8.0f * samples.positions[i][0]) ==
          communicator.rank())
        own.append(samples.span(i, 1));
    Report report;
    const auto found = redistribute(std::move(own), 3, 4, communicator, 1, report);
    EXPECT_EQ(1u, found.samples.size());
    EXPECT_EQ(800u, found.samples.begin()->second.size());
    // Twice 800 samples of 24 bytes, and what little messages begin with.
    EXPECT_LT(report.getCount("bytes_redistributed"), 2.1 * 800 * 24);
  });
}

TEST(PieceOwners, ShareThePiecesOfEachGroup)
{
  for (const std::size_t ranks : {1, 3, 64, 100})
    for (std::size_t groups = 1; groups <= ranks && groups <= 16; groups *= 2) {
      const std::size_t pieces = 512;
      const PieceOwners owners(pieces, ranks, groups);
      std::vector<std::size_t> counts(ranks);
      std::size_t before = 0;
      for (std::size_t piece = 0; piece < pieces; ++piece) {
        const std::size_t owner = owners.getOwner(piece);
        ASSERT_LT(owner, ranks);
        EXPECT_LE(before, owner);
        before = owner;
        ++counts[owner];
        EXPECT_EQ(piece / (pieces / groups), owners.getGroup(owner));
      }
      const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
      EXPECT_GE(*least, 1u);
      const auto least_group = static_cast<double>(ranks / groups);
      EXPECT_LE(static_cast<double>(*most),
                std::ceil(static_cast<double>(pieces / groups) / least_group));
    }
}

TEST(PieceGroups, AreAsManyAsTheirProcesses)
{
  EXPECT_EQ(1u, pcl_uvol::chooseGroups(32, 5));
  EXPECT_EQ(8u, pcl_uvol::chooseGroups(64, 6));
  EXPECT_EQ(8u, pcl_uvol::chooseGroups(100, 9));
  EXPECT_EQ(32u, pcl_uvol::chooseGroups(1024, 10));
  EXPECT_EQ(128u, pcl_uvol::chooseGroups(10000, 16));
  EXPECT_EQ(1u, pcl_uvol::chooseGroups(64, 3)); // of a few samples
}

TEST(Redistribution, RefusesGroupsThatCannotBe)
{
  const Samples samples = makeSamples("uniform", 100);
  const auto in_turn = [](std::size_t i) { return i % 4; };
  for (const std::size_t groups : {0, 3, 8})
    EXPECT_THROW(Together(samples, 4, 4, groups, in_turn), pcl_uvol::InvalidArgument);
  EXPECT_THROW(Together(samples, 1, 4, 4, in_turn), pcl_uvol::InvalidArgument);
  EXPECT_THROW(Together(samples, 7, 4, 2, in_turn), pcl_uvol::InvalidArgument);
}

} // namespace test_redistribute
