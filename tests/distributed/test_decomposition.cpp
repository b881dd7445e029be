// SPDX-License-Identifier: BSD-3-Clause
// The top of the tree, found over ranks, is the top of the tree.
#include "common/random.h"
#include "distributed/piece.h"
#include "neighbors/sample_set.h"
#include "support/clouds.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace test_decomposition {

using pcl_uvol::Ball;
using pcl_uvol::CellKey;
using pcl_uvol::Decomposition;
using pcl_uvol::Position;
using pcl_uvol::Report;
using pcl_uvol::uniformAt;
using Positions = std::vector<Position>;

Positions
makePositions(std::size_t count, const std::function<Position(std::uint64_t)>& make)
{
  Positions positions;
  for (std::uint64_t i = 0; i < count; ++i)
    positions.push_back(make(i));
  return positions;
}

float
at(std::uint64_t i, int axis)
{
  return static_cast<float>(uniformAt(11, i, static_cast<std::uint64_t>(axis)));
}

/** \param passes gets how often each position was asked for at most */
void
decompose(const Positions& positions,
          int levels,
          std::size_t ranks,
          const std::function<void(const Decomposition&)>& examine,
          int& passes)
{
  std::atomic<int> most{0};
  uvol_test::runRanks(ranks, [&](pcl_uvol::Communicator& communicator) {
    // The second rank has none.
    const std::size_t begin =
        communicator.rank() == 0 ? 0
                                 : (communicator.rank() - 1) * positions.size() / ranks;
    const std::size_t end = ranks == 1                 ? positions.size()
                            : communicator.rank() == 0 ? 0
                            : communicator.rank() + 1 == ranks
                                ? positions.size()
                                : communicator.rank() * positions.size() / ranks;
    std::atomic<int> scans{0};
    const auto read = [&](std::uint64_t first, std::size_t count, Position* buffer) {
      scans += first == 0;
      const auto from = positions.begin() + static_cast<std::ptrdiff_t>(begin + first);
      std::copy_n(from, count, buffer);
      return buffer;
    };
    const Decomposition decomposition(
        {end - begin, read}, levels, communicator, ranks == 1 ? 3 : 1);
    most = std::max<int>(most, scans);
    if (communicator.rank() == 0)
      examine(decomposition);
  });
  passes = most;
}

pcl_uvol::SampleSet::ConstPtr
collectSamples(const Positions& positions)
{
  std::vector<std::uint32_t> all(positions.size());
  std::iota(all.begin(), all.end(), 0u);
  Report report;
  return pcl_uvol::SampleSet::buildInUnit(positions[0].x, 3, all, {}, 0, report);
}

void
expectSamePlane(const pcl_uvol::PlaneKey& found,
                const pcl_uvol::SplitPlane& expected,
                const pcl_uvol::SampleSet& samples)
{
  EXPECT_EQ(expected.coordinate, found.coordinate);
  for (int axis = 0; axis < 3 && std::isfinite(expected.coordinate); ++axis)
    EXPECT_EQ(samples.getPositions()[expected.below_sample][axis], found.below[axis]);
}

/** Walk the tree of all samples down to each piece. */
void
expectTopOfTree(const Decomposition& decomposition, const pcl_uvol::SampleSet& samples)
{
  const pcl_uvol::KdTree& tree = samples.getTree();
  for (std::size_t piece = 0; piece < decomposition.size(); ++piece) {
    pcl_uvol::KdNode node = tree.getRoot();
    pcl_uvol::KdCell cell = tree.getCell();
    for (int depth = 0; depth < decomposition.getLevels(); ++depth) {
      const auto axis = static_cast<std::size_t>(tree.getAxis(depth));
      const bool is_right = (piece >> (decomposition.getLevels() - 1 - depth) & 1) != 0;
      (is_right ? cell.low : cell.high)[axis] = tree.getPlane(node);
      node = is_right ? node.right() : node.left();
    }
    EXPECT_EQ(node.begin, decomposition.getBegin(piece));
    EXPECT_EQ(node.count, decomposition.getCount(piece));
    const CellKey found = decomposition.getCell(piece);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      expectSamePlane(found.low[axis], cell.low[axis], samples);
      expectSamePlane(found.high[axis], cell.high[axis], samples);
    }
    for (const std::uint32_t sample : {node.begin, node.begin + node.count - 1})
      EXPECT_EQ(piece, decomposition.findPiece(samples.getPositions()[sample]));
  }
}

/** Whether the positions drawn first tell where medians lie, or not. */
TEST(Decompositions, AreTheTopOfTheTree)
{
  const auto scaled = [](float factor) {
    return [factor](std::uint64_t i) {
      return Position{{factor * (at(i, 0) - 0.5f) + 0.0f,
                       factor * (at(i, 1) - 0.5f) + 0.0f,
                       factor * (at(i, 2) - 0.5f) + 0.0f}};
    };
  };
  // 100000 positions: every eighth, by this number, is drawn in the first pass.
  const auto is_drawn = [](std::uint64_t i) {
    return (pcl_uvol::mixBits(pcl_uvol::mixBits(0) + i) & 7) == 0;
  };
  const struct {
    const char* name;
    Positions positions;
    bool one_pass_each;
  } cases[] = {
      {"in one binade",
       makePositions(
           1000000,
           [](std::uint64_t i) {
             return Position{{1.0f + at(i, 0), 1.0f + at(i, 1), 1.0f + at(i, 2)}};
           }),
       true},
      {"of one x for most",
       makePositions(
           200000,
           [](std::uint64_t i) {
             return Position{{i % 10 == 0 ? at(i, 0) : 0.5f, at(i, 1), at(i, 2)}};
           }),
       true},
      {"of one x and y for most",
       makePositions(300000,
                     [](std::uint64_t i) {
                       return i % 10 == 0 ? Position{{at(i, 0), at(i, 1), at(i, 2)}}
                                          : Position{{0.5f,
                                                      0.25f,
                                                      1e-5f * static_cast<float>(
                                                                  i * 7919 % 300007)}};
                     }),
       true},
      {"around the origin", makePositions(100000, scaled(3.0f)), true},
      {"smaller than normal numbers", makePositions(100000, scaled(1e-39f)), true},
      {"drawn on one side only",
       makePositions(100000,
                     [&](std::uint64_t i) {
                       return Position{{is_drawn(i) ? 0.1f * at(i, 0) : 0.5f + at(i, 0),
                                        at(i, 1),
                                        at(i, 2)}};
                     }),
       false},
      {"drawn from few places only",
       makePositions(100000,
                     [&](std::uint64_t i) {
                       const float x = is_drawn(i) ? static_cast<float>(i % 3) : 1.5f;
                       return Position{{x + 1e-3f * at(i, 0), at(i, 1), at(i, 2)}};
                     }),
       false},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.name);
    const auto samples = collectSamples(one.positions);
    ASSERT_EQ(one.positions.size(), samples->size());
    for (const std::size_t ranks : {1, 3}) {
      int passes = 0;
      decompose(
          one.positions,
          4,
          ranks,
          [&](const Decomposition& found) { expectTopOfTree(found, *samples); },
          passes);
      if (one.one_pass_each) {
        EXPECT_EQ(1 + 4, passes);
      }
      else if (ranks == 1) {
        EXPECT_LT(1 + 4, passes);
      }
    }
  }
}

/** At the last two of eight levels more samples lie between the bounds than may be
 * drawn: they are kept, not looked for again, which would take twelve passes. */
TEST(Decompositions, KeepWhatIsLeftOfAPass)
{
  const Positions positions = makePositions(300000, [](std::uint64_t i) {
    return Position{{at(i, 0), at(i, 1), at(i, 2)}};
  });
  const auto samples = collectSamples(positions);
  for (const std::size_t ranks : {1, 3}) {
    int passes = 0;
    decompose(
        positions,
        8,
        ranks,
        [&](const Decomposition& found) { expectTopOfTree(found, *samples); },
        passes);
    EXPECT_LE(1 + 8, passes);
    EXPECT_LT(passes, 11);
  }
}

TEST(Decompositions, TakeOnePassOverFew)
{
  const Positions positions = makePositions(512, [](std::uint64_t i) {
    return Position{{at(i, 0), at(i, 1), at(i, 2)}};
  });
  const auto samples = collectSamples(positions);
  int passes = 0;
  decompose(
      positions,
      4,
      3,
      [&](const Decomposition& found) { expectTopOfTree(found, *samples); },
      passes);
  EXPECT_EQ(1, passes);
}

class DecompositionOfEveryShape : public testing::TestWithParam<std::string> {};

TEST_P(DecompositionOfEveryShape, IsTheTopOfTheTree)
{
  Positions positions;
  const auto cloud = uvol_test::makeCloud(GetParam(), 40000, 9);
  for (const auto& point : *cloud)
    if (std::isfinite(point.x + point.y + point.z))
      positions.push_back({{point.x + 0.0f, point.y + 0.0f, point.z + 0.0f}});
  const auto samples = collectSamples(positions);
  positions.assign(samples->getPositions().begin(),
                   samples->getPositions().begin() +
                       static_cast<std::ptrdiff_t>(samples->size()));
  int passes = 0;
  const int most = positions.size() < 4096 ? 5 : 11; // levels
  for (const int levels : {0, 3, most})
    for (const std::size_t ranks : {1, 3})
      decompose(
          positions,
          levels,
          ranks,
          [&](const Decomposition& found) { expectTopOfTree(found, *samples); },
          passes);
}

INSTANTIATE_TEST_SUITE_P(Clouds,
                         DecompositionOfEveryShape,
                         testing::ValuesIn(uvol_test::cloudShapes()),
                         [](const auto& shape) {
                           return uvol_test::testNameOf(shape.param);
                         });

TEST(Decompositions, KeepEqualPositionsTogether)
{
  const Position place{{0.3f, 0.6f, 0.9f}};
  for (const std::size_t size : {500, 200000})
    for (const std::size_t share : {2, 3, 50}) {
      SCOPED_TRACE(testing::Message() << size << " samples, 1 of " << share);
      const Positions positions = makePositions(size, [&](std::uint64_t i) {
        return i % share == 0 ? place : Position{{at(i, 0), at(i, 1), at(i, 2)}};
      });
      int passes = 0;
      decompose(
          positions,
          5,
          3,
          [&](const Decomposition& found) {
            std::vector<std::size_t> counts(found.size());
            for (const Position& position : positions)
              ++counts[found.findPiece(position)];
            EXPECT_EQ(positions.size(), found.getSampleCount());
            for (std::size_t piece = 0; piece < found.size(); ++piece)
              EXPECT_EQ(counts[piece], found.getCount(piece)) << piece;
            EXPECT_GE(counts[found.findPiece(place)], positions.size() / share);
          },
          passes);
    }
}

#if defined(__SSE__)
/** As a library linked with -ffast-math makes them count. */
TEST(Decompositions, EndWhereDenormalNumbersCountAsZero)
{
  const Positions positions = makePositions(200000, [&](std::uint64_t i) {
    return i % 2 == 0 ? Position{{0.5f, 0.5f, 0.0f}}
                      : Position{{at(i, 0), at(i, 1), at(i, 2)}};
  });
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040u); // flush them, take them for 0
  int passes = 0;
  decompose(
      positions,
      3,
      1,
      [&](const Decomposition& found) {
        const std::size_t piece = found.findPiece(positions[0]);
        EXPECT_GE(found.getCount(piece), positions.size() / 2);
      },
      passes);
  _mm_setcsr(before);
}
#endif

TEST(Decompositions, FindThePiecesThatBallsMeet)
{
  const Positions positions = makePositions(5000, [](std::uint64_t i) {
    return Position{{at(i, 0), at(i, 1), at(i, 2)}};
  });
  std::vector<Ball> balls;
  for (std::uint64_t i = 0; i < 50; ++i)
    balls.push_back({{{at(i, 3), at(i, 4), at(i, 5)}}, 0.3f * at(i, 6)});
  int passes = 0;
  decompose(
      positions,
      4,
      1,
      [&](const Decomposition& decomposition) {
        std::vector<std::size_t> expected(decomposition.size()), found(expected);
        for (std::size_t piece = 0; piece < expected.size(); ++piece)
          for (const Ball& ball : balls)
            expected[piece] += decomposition.getCell(piece).meets(ball);
        decomposition.findPieces(
            balls, [&](std::size_t piece, const std::vector<Ball>& meeting) {
              found[piece] += meeting.size();
            });
        EXPECT_EQ(expected, found);
        EXPECT_LT(std::accumulate(found.begin(), found.end(), std::size_t(0)),
                  balls.size() * expected.size());
      },
      passes);
}

TEST(Decompositions, RefuseWhatCannotBe)
{
  const Positions positions(3, Position{{1.0f, 2.0f, 3.0f}});
  int passes = 0;
  const auto ignore = [](const Decomposition&) {};
  EXPECT_THROW(decompose(positions, 2, 1, ignore, passes), pcl_uvol::InvalidArgument);
  EXPECT_THROW(decompose(positions, -1, 1, ignore, passes), pcl_uvol::InvalidArgument);
  EXPECT_THROW(decompose(positions, 21, 1, ignore, passes), pcl_uvol::InvalidArgument);
}

} // namespace test_decomposition
