// SPDX-License-Identifier: BSD-3-Clause
// Building the kd-tree against sorting the samples of every node, at every instruction
// set.
#include "src/neighbors/kd_tree.h"
#include "src/neighbors/kernel_tables.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace test_tree_kernel {

using namespace pcl_uvol;

using Records = SampleRecords;

/** Distinct positions, the coordinates of which take so many values. */
Records
makeRecords(std::size_t count, std::uint32_t values, std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  std::vector<Position> positions;
  const auto less = [](const Position& a, const Position& b) {
    return lessAlong(0, a, b);
  };
  const auto equal = [](const Position& a, const Position& b) {
    return !lessAlong(0, a, b) && !lessAlong(0, b, a);
  };
  while (positions.size() < count) {
    for (std::size_t i = positions.size(); i < count; ++i) {
      Position position;
      for (float& x : position.x)
        x = static_cast<float>(engine() % values) / static_cast<float>(values) - 0.5f;
      positions.push_back(stretched(position, {{1.0f, 1.0f, 1.0f}}));
    }
    std::sort(positions.begin(), positions.end(), less);
    positions.erase(std::unique(positions.begin(), positions.end(), equal),
                    positions.end());
  }
  std::shuffle(positions.begin(), positions.end(), engine);
  Records records(count);
  for (std::size_t i = 0; i < count; ++i)
    records[i] = {positions[i], static_cast<std::uint32_t>(i)};
  return records;
}

/** What a tree is made of, by sorting. */
struct PlainTree {
  AxisCycle cycle;
  std::vector<int> axis_of_depth; // the same
  std::vector<SplitPlane> planes; // with input indices
  std::vector<int> axes;

  void
  build(Records& records, const KdNode& node, KdBox cell, SplitRule rule)
  {
    if (node.isLeaf())
      return;
    int axis = axis_of_depth[static_cast<std::size_t>(node.depth)];
    if (rule == SplitRule::LongestSide) {
      axis = 0;
      for (int other = 1; other < 3; ++other)
        if (cell.high[other] - cell.low[other] > cell.high[axis] - cell.low[axis])
          axis = other;
    }
    const auto begin = records.begin() + node.begin;
    std::sort(begin, begin + node.count, [axis](const auto& a, const auto& b) {
      return lessAlong(axis, a.position, b.position);
    });
    const SampleRecord &below = records[node.right().begin - 1],
                       &above = records[node.right().begin];
    planes[node.number] = {midway(below.position[axis], above.position[axis]),
                           below.input_index};
    axes[node.number] = axis;
    KdBox lower = cell, upper = cell;
    lower.high[axis] = upper.low[axis] = planes[node.number].coordinate;
    build(records, node.left(), lower, rule);
    build(records, node.right(), upper, rule);
  }
};

KdBox
boxAround(const Records& records)
{
  KdBox box{records[0].position, records[0].position};
  for (const SampleRecord& record : records)
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], record.position[axis]);
      box.high[axis] = std::max(box.high[axis], record.position[axis]);
    }
  return box;
}

PlainTree
buildPlainly(Records& records, SplitRule rule)
{
  std::size_t numbers = 1;
  while (numbers < records.size())
    numbers *= 2;
  const KdBox box = boxAround(records);
  PlainTree tree;
  tree.cycle = KdTree::cycleOver(
      {box.low[0] < box.high[0], box.low[1] < box.high[1], box.low[2] < box.high[2]});
  tree.axis_of_depth.assign(tree.cycle.begin(), tree.cycle.end());
  tree.planes.resize(numbers);
  tree.axes.resize(numbers, -1);
  tree.build(records, {1, 0, static_cast<std::uint32_t>(records.size()), 0}, box, rule);
  return tree;
}

TEST(TreeKernel, ValueAtRankIsThatOfTheSortedNumbers)
{
  std::mt19937_64 engine(3);
  uvol_test::forLevels(tree_kernel_table, [&](const TreeKernels* kernel) {
    for (int count = 1; count <= TreeKernels::most_values; ++count)
      for (const std::uint64_t values : {1u, 3u, 1000000u}) {
        std::vector<float> numbers(TreeKernels::most_values, -7.0f);
        for (int i = 0; i < count; ++i)
          numbers[static_cast<std::size_t>(i)] =
              static_cast<float>(engine() % values) - 1.0f;
        std::vector<float> sorted(numbers.begin(), numbers.begin() + count);
        std::sort(sorted.begin(), sorted.end());
        for (int rank = 0; rank < count; ++rank)
          EXPECT_EQ(kernel->valueAtRank(numbers.data(), count, rank),
                    sorted[static_cast<std::size_t>(rank)])
              << count << " numbers, rank " << rank;
      }
  });
}

TEST(TreeKernel, SubtreesInRegistersAreThoseBySorting)
{
  uvol_test::forLevels(tree_kernel_table, [](const TreeKernels* kernel) {
    for (std::uint32_t count = 2; count <= kernel->most_in_registers; ++count)
      for (const std::uint32_t values : {3u, 5u, 1u << 20})
        for (const SplitRule rule : {SplitRule::Cycle, SplitRule::LongestSide}) {
          Records records = makeRecords(count, values, count + values);
          Records expected = records;
          const PlainTree plain = buildPlainly(expected, rule);
          const KdBox cell = boxAround(records);
          const bool by_cell = rule == SplitRule::LongestSide;
          // Levels of a subtree that has fewer samples stay as they are.
          std::vector<SplitPlane> planes(32, SplitPlane{7.0f, 7});
          std::vector<std::int8_t> axes(32, -1);
          EXPECT_TRUE(kernel->build({records.front().position.x,
                                     static_cast<int>(count),
                                     1,
                                     plain.cycle.data(),
                                     by_cell ? cell.low.x : nullptr,
                                     by_cell ? cell.high.x : nullptr,
                                     planes.data(),
                                     axes.data()}));
          for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_EQ(records[i].input_index, expected[i].input_index)
                << count << " samples, " << values << " values";
          for (std::size_t number = 1; number < plain.planes.size(); ++number) {
            if (plain.axes[number] < 0)
              continue;
            EXPECT_EQ(planes[number].coordinate, plain.planes[number].coordinate);
            EXPECT_EQ(planes[number].below_sample, plain.planes[number].below_sample);
            if (by_cell) {
              EXPECT_EQ(axes[number], plain.axes[number]);
            }
          }
        }
  });
}

TEST(TreeKernel, SubtreesInRegistersNoticeEqualPositions)
{
  uvol_test::forLevels(tree_kernel_table, [](const TreeKernels* kernel) {
    for (std::uint32_t count = 2; count <= kernel->most_in_registers; ++count)
      for (std::uint32_t copy = 1; copy < count; ++copy) {
        Records records = makeRecords(count, 1u << 20, count);
        records[copy].position = records[copy / 2].position;
        const AxisCycle cycle = KdTree::cycleOver({true, true, true});
        std::vector<SplitPlane> planes(32);
        EXPECT_FALSE(kernel->build({records.front().position.x,
                                    static_cast<int>(count),
                                    1,
                                    cycle.data(),
                                    nullptr,
                                    nullptr,
                                    planes.data(),
                                    nullptr}));
        std::vector<bool> is_there(count);
        for (const SampleRecord& record : records)
          is_there[record.input_index] = true;
        EXPECT_EQ(static_cast<std::ptrdiff_t>(count),
                  std::count(is_there.begin(), is_there.end(), true));
      }
  });
}

TEST(KdTree, IsThatBySortingForAnyNumberOfSamplesAndThreads)
{
  // Some more than a task has, so that planes of several tasks are joined; few values
  // make lattices, most samples of which have equal coordinates.
  for (const std::size_t count : {1u, 2u, 3u, 17u, 33u, 100u, 1000u, 50000u})
    for (const std::uint32_t values : {40u, 1u << 20})
      for (const SplitRule rule : {SplitRule::Cycle, SplitRule::LongestSide})
        for (const unsigned threads : {1u, 3u}) {
          SCOPED_TRACE(std::to_string(count) + " samples");
          Records records = makeRecords(count, values, count);
          Records expected = records;
          const PlainTree plain = buildPlainly(expected, rule);
          Report report;
          StepTimer step(report, "tree", count);
          KdTree tree;
          ASSERT_TRUE(tree.build(records, threads, step, rule));
          for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(records[i].input_index, expected[i].input_index) << i;
          std::vector<KdNode> open{tree.getRoot()};
          while (!open.empty()) {
            const KdNode node = open.back();
            open.pop_back();
            if (node.isLeaf())
              continue;
            const SplitPlane &plane = tree.getPlane(node),
                             &other = plain.planes[node.number];
            ASSERT_EQ(plane.coordinate, other.coordinate) << node.number;
            ASSERT_EQ(records[plane.below_sample].input_index, other.below_sample)
                << node.number;
            ASSERT_EQ(tree.getAxis(node), plain.axes[node.number]);
            open.push_back(node.left());
            open.push_back(node.right());
          }
        }
}

#if defined(__SSE__)
/** As a library linked with -ffast-math makes them count. */
TEST(KdTree, EndsWhereDenormalNumbersCountAsZero)
{
  Records records = makeRecords(2000, 1u << 20, 5);
  for (SampleRecord& record : records)
    record.position[0] = std::abs(record.position[0]);
  for (std::size_t i = 0; i < 1500; ++i)
    records[i].position[0] = 0.0f;
  Report report;
  StepTimer step(report, "tree", records.size());
  KdTree tree;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040u); // flush them, take them for 0
  const bool is_built = tree.build(records, 1, step);
  _mm_setcsr(before);
  EXPECT_TRUE(is_built);
}
#endif

TEST(KdTree, EqualPositionsComeOutSideBySide)
{
  for (const std::size_t count : {2u, 40u, 1000u, 50000u})
    for (const std::size_t copies : {1u, 7u, 30000u}) {
      if (copies >= count)
        continue;
      Records records = makeRecords(count, 1u << 20, count + copies);
      for (std::size_t i = 0; i < copies; ++i)
        records[count - 1 - i].position = records[0].position;
      const Position position = records[0].position;
      Report report;
      StepTimer step(report, "tree", count);
      KdTree tree;
      EXPECT_FALSE(tree.build(records, 2, step));
      const auto isCopy = [&](const SampleRecord& record) {
        return !lessAlong(0, record.position, position) &&
               !lessAlong(0, position, record.position);
      };
      const auto first = std::find_if(records.begin(), records.end(), isCopy);
      const auto end = std::find_if_not(first, records.end(), isCopy);
      EXPECT_EQ(end - first, static_cast<std::ptrdiff_t>(copies + 1));
    }
}

} // namespace test_tree_kernel
