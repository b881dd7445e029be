// SPDX-License-Identifier: BSD-3-Clause
// Building the bit-indexed kd-tree (thesis Table 2.2), boxes around samples and the
// range of a scalar per node.
#include "neighbors/kd_tree.h"

#include "common/parallel.h"
#include "neighbors/kernel_tables.h"
#include "neighbors/record_partition.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

namespace pcl_uvol {

namespace {

/** Below this many samples a subtree is one task: large enough to hide the cost of a
 * fork, and small enough for the cache. Ranges cost a hundredth of the tree. */
constexpr std::uint32_t task_samples = 1u << 14, range_task_samples = 1u << 18;

/** Smallest power of two of parts that leaves no part more than that many samples:
 * nodes that hold more have lower numbers. */
std::size_t
countParts(std::uint32_t count, std::uint32_t most)
{
  std::size_t parts = 1;
  while (parts * most < count)
    parts <<= 1;
  return parts;
}

KdBox
boxAroundRecords(const SampleRecord* records, std::size_t count)
{
  using RecordRegister =
      float __attribute__((vector_size(sizeof(SampleRecord)), aligned(4), may_alias));
  const auto* const first = reinterpret_cast<const RecordRegister*>(records);
  RecordRegister low = *first, high = *first;
  for (std::size_t i = 1; i < count; ++i) {
    low = first[i] < low ? first[i] : low;
    high = first[i] > high ? first[i] : high;
  }
  return {{{low[0], low[1], low[2]}}, {{high[0], high[1], high[2]}}};
}

/** Split axes by depth: cells need not be known. */
class CycledAxes {
public:
  struct Cell {};

  explicit CycledAxes(const AxisCycle& axes)
      : axes_(axes)
  {
  }

  int
  choose(const KdNode& node, const Cell&) const
  {
    return getAxis(node);
  }

  int
  getAxis(const KdNode& node) const
  {
    return axes_[static_cast<std::size_t>(node.depth)];
  }

  /** Say how a subtree in registers is split. */
  void
  setSplits(const KdNode& node, const Cell&, Subtree& subtree) const
  {
    subtree.cycle = axes_.data() + node.depth;
  }

  static Cell
  cutAbove(const Cell& cell, int, float)
  {
    return cell;
  }

  static Cell
  cutBelow(const Cell& cell, int, float)
  {
    return cell;
  }

private:
  const AxisCycle& axes_;
};

/** Split axes by the longest sides of cells, which are remembered. */
class LongestSides {
public:
  using Cell = KdBox;

  explicit LongestSides(LargeArray<std::int8_t>& axes)
      : axes_(axes)
  {
  }

  int
  choose(const KdNode& node, const Cell& cell) const
  {
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (cell.high[axis] - cell.low[axis] > cell.high[longest] - cell.low[longest])
        longest = axis;
    axes_[node.number] = static_cast<std::int8_t>(longest);
    return longest;
  }

  int
  getAxis(const KdNode& node) const
  {
    return axes_[node.number];
  }

  void
  setSplits(const KdNode&, const Cell& cell, Subtree& subtree) const
  {
    subtree.low = cell.low.x;
    subtree.high = cell.high.x;
    subtree.axes = axes_.data();
  }

  static Cell
  cutAbove(Cell cell, int axis, float plane)
  {
    cell.high[axis] = plane;
    return cell;
  }

  static Cell
  cutBelow(Cell cell, int axis, float plane)
  {
    cell.low[axis] = plane;
    return cell;
  }

private:
  LargeArray<std::int8_t>& axes_; // by node number
};

/** Parts records from the root down to single ones. Equal positions, which no cut can
 * part, are left out and side by side: then there is no tree.
 * \tparam Axes CycledAxes or LongestSides */
template <typename Axes>
class Builder {
public:
  using Cell = typename Axes::Cell;

  Builder(const Axes& axes,
          SampleRecords& records,
          LargeArray<SplitPlane>& planes,
          LargeArray<KdBox>& boxes,
          StepTimer& step)
      : axes_(axes)
      , records_(records)
      , planes_(planes)
      , boxes_(boxes)
      , step_(step)
  {
  }

  /** False if positions are equal. */
  bool
  build(const KdNode& root, const Cell& cell)
  {
    buildByTasks(root, cell);
    return !has_equals_;
  }

private:
  /** What a node is parted into. */
  struct Halves {
    KdNode left, right;
    Cell lower, upper;
    Position below; ///< the last one below the plane
  };

  void
  buildByTasks(const KdNode& node, const Cell& cell)
  {
    if (node.count < task_samples) {
      buildBlock(node, cell);
      step_.advance(node.count);
      return;
    }
    const Halves halves = split(node, cell);
    TaskGroup::fork([&] { buildByTasks(halves.left, halves.lower); },
                    [&] { buildByTasks(halves.right, halves.upper); });
    if (has_equals_)
      return;
    joinBoxes(node);
    planes_[node.number].below_sample = findSample(halves.left, halves.below);
  }

  /** The place of a position that a subtree has. */
  std::uint32_t
  findSample(KdNode node, const Position& position) const
  {
    while (!node.isLeaf()) {
      const std::uint32_t below = planes_[node.number].below_sample;
      const int axis = axes_.getAxis(node);
      node = lessAlong(axis, records_[below].position, position) ? node.right()
                                                                 : node.left();
    }
    return node.begin;
  }

  /** A subtree by one task. While samples move, planes know them by their first places
   * in the block. */
  void
  buildBlock(const KdNode& node, const Cell& cell)
  {
    SampleRecord* const records = records_.data() + node.begin;
    std::vector<std::uint32_t> input_indices(node.count), place_of(node.count);
    for (std::uint32_t i = 0; i < node.count; ++i) {
      input_indices[i] = records[i].input_index;
      records[i].input_index = i;
    }
    // Numbers without a node get a plane as well, since the loop below goes over all.
    for (std::uint64_t first = node.number, nodes = 1; first < planes_.size();
         first *= 2, nodes *= 2)
      std::fill_n(planes_.begin() + static_cast<std::ptrdiff_t>(first),
                  nodes,
                  SplitPlane{0.0f, 0});
    buildAlone(node, cell);
    for (std::uint32_t i = 0; i < node.count; ++i) {
      place_of[records[i].input_index] = node.begin + i;
      records[i].input_index = input_indices[records[i].input_index];
    }
    if (has_equals_)
      return;
    for (std::uint64_t first = node.number, nodes = 1; first < planes_.size();
         first *= 2, nodes *= 2)
      for (std::uint64_t i = first; i < first + nodes; ++i)
        planes_[i].below_sample = place_of[planes_[i].below_sample];
  }

  void
  buildAlone(const KdNode& node, const Cell& cell)
  {
    if (KdTree::isBucket(node)) {
      if (node.count > 0)
        boxes_[node.number] = boxAround(node);
      buildBucket(node, cell);
      return;
    }
    const Halves halves = split(node, cell);
    buildAlone(halves.left, halves.lower);
    buildAlone(halves.right, halves.upper);
    if (!has_equals_) // else halves may be empty
      joinBoxes(node);
  }

  void
  buildBucket(const KdNode& node, const Cell& cell)
  {
    if (node.count < 2)
      return;
    SampleRecord* const first = records_.data() + node.begin;
    if (node.count > kernels_.most_in_registers) {
      const Halves halves = split(node, cell);
      buildBucket(halves.left, halves.lower);
      buildBucket(halves.right, halves.upper);
    }
    else if (!buildInRegisters(node, cell)) {
      has_equals_.store(true, std::memory_order_relaxed);
      std::sort(first, first + node.count, [](const auto& a, const auto& b) {
        return lessAlong(0, a.position, b.position);
      });
    }
  }

  bool
  buildInRegisters(const KdNode& node, const Cell& cell)
  {
    Subtree subtree{};
    subtree.records = records_[node.begin].position.x;
    subtree.count = static_cast<int>(node.count);
    subtree.number = node.number;
    subtree.planes = planes_.data();
    axes_.setSplits(node, cell, subtree);
    return kernels_.build(subtree);
  }

  Halves
  split(const KdNode& node, const Cell& cell)
  {
    SampleRecord* const first = records_.data() + node.begin;
    const int axis = axes_.choose(node, cell);
    const RecordCut cut = partition_.partAtCut(
        first, first + (node.count + 1) / 2, first + node.count, axis);
    const Position below = cut.below->position;
    const float plane = midway(below[axis], cut.above);
    planes_[node.number] = {plane, cut.below->input_index};
    Halves halves{node.left(),
                  node.right(),
                  Axes::cutAbove(cell, axis, plane),
                  Axes::cutBelow(cell, axis, plane),
                  below};
    if (cut.is_among_equals) {
      has_equals_.store(true, std::memory_order_relaxed);
      leaveOut(node, axis, halves);
    }
    return halves;
  }

  /** Bring the records of the position below the plane between the others. */
  void
  leaveOut(const KdNode& node, int axis, Halves& halves)
  {
    const auto first = records_.begin() + node.begin, last = first + node.count;
    const auto less_end = std::partition(first, last, [&](const SampleRecord& record) {
      return lessAlong(axis, record.position, halves.below);
    });
    const auto greater =
        std::partition(less_end, last, [&](const SampleRecord& record) {
          return !lessAlong(axis, halves.below, record.position);
        });
    halves.left.count = static_cast<std::uint32_t>(less_end - first);
    halves.right.begin = static_cast<std::uint32_t>(greater - records_.begin());
    halves.right.count = static_cast<std::uint32_t>(last - greater);
  }

  KdBox
  boxAround(const KdNode& bucket) const
  {
    return boxAroundRecords(records_.data() + bucket.begin, bucket.count);
  }

  /** The box of a node from those of its halves. */
  void
  joinBoxes(const KdNode& node)
  {
    const KdBox &left = boxes_[node.left().number],
                &right = boxes_[node.right().number];
    KdBox& box = boxes_[node.number];
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(left.low[axis], right.low[axis]);
      box.high[axis] = std::max(left.high[axis], right.high[axis]);
    }
  }

  const Axes& axes_;
  SampleRecords& records_;
  LargeArray<SplitPlane>& planes_;
  LargeArray<KdBox>& boxes_;
  StepTimer& step_;
  const TreeKernels& kernels_ = *tree_kernel_table.get();
  RecordPartition partition_{kernels_};
  std::atomic<bool> has_equals_{false};
};

NodeRanges::Range
fillRanges(NodeRanges& ranges, const KdNode& node)
{
  if (node.isLeaf())
    return ranges[node];
  if (node.count == 2) { // half of all inner nodes
    const float first = ranges.values[node.begin],
                second = ranges.values[node.begin + 1];
    return ranges.inner[node.number] = {std::min(first, second),
                                        std::max(first, second)};
  }
  NodeRanges::Range left, right;
  const auto fill_left = [&] { left = fillRanges(ranges, node.left()); };
  const auto fill_right = [&] { right = fillRanges(ranges, node.right()); };
  if (node.count < range_task_samples) {
    fill_left();
    fill_right();
  }
  else
    TaskGroup::fork(fill_left, fill_right);
  return ranges.inner[node.number] = left.joined(right);
}

} // namespace

AxisCycle
KdTree::cycleOver(const std::array<bool, 3>& axes)
{
  std::vector<std::int8_t> used;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    if (axes[axis])
      used.push_back(static_cast<std::int8_t>(axis));
  AxisCycle cycle{};
  for (std::size_t depth = 0; depth < cycle.size() && !used.empty(); ++depth)
    cycle[depth] = used[depth % used.size()];
  return cycle;
}

bool
KdTree::build(SampleRecords& records, unsigned threads, StepTimer& step, SplitRule rule)
{
  // An axis along which all samples agree would only add splits by the other
  // coordinates.
  std::array<bool, 3> varies;
  for (int axis = 0; axis < 3; ++axis)
    varies[static_cast<std::size_t>(axis)] =
        std::any_of(records.begin(), records.end(), [&](const SampleRecord& record) {
          return record.position[axis] != records.front().position[axis];
        });
  return buildBy(rule, records, cycleOver(varies), 0, threads, step);
}

bool
KdTree::build(SampleRecords& records,
              const AxisCycle& axes,
              int depth,
              unsigned threads,
              StepTimer& step)
{
  return buildBy(SplitRule::Cycle, records, axes, depth, threads, step);
}

bool
KdTree::buildBy(SplitRule rule,
                SampleRecords& records,
                const AxisCycle& axes,
                int depth,
                unsigned threads,
                StepTimer& step)
{
  root_ = {1, 0, static_cast<std::uint32_t>(records.size()), depth};
  axis_at_depth_ = axes;
  planes_.resize(countParts(root_.count, 1));
  planes_.front() = {0.0f, 0}; // of no node
  boxes_.resize(2 * countParts(root_.count, bucket_samples));
  const auto buildWith = [&](const auto& chosen, const auto& cell) {
    Builder builder(chosen, records, planes_, boxes_, step);
    bool is_built = false;
    TaskGroup::run(threads, [&] { is_built = builder.build(getRoot(), cell); });
    return is_built;
  };
  axes_.clear();
  bool is_built;
  if (rule == SplitRule::LongestSide) {
    axes_.resize(planes_.size());
    is_built = buildWith(LongestSides(axes_),
                         boxAroundRecords(records.data(), records.size()));
  }
  else
    is_built = buildWith(CycledAxes(axis_at_depth_), CycledAxes::Cell());
  return is_built;
}

void
KdTree::place(std::uint32_t begin, const KdCell& cell)
{
  for (SplitPlane& plane : planes_)
    plane.below_sample += begin - root_.begin; // modulo 2^32
  root_.begin = begin;
  cell_ = cell;
}

KdCell
KdTree::unboundedCell()
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  KdCell cell;
  cell.low.fill({-infinity, 0});
  cell.high.fill({infinity, 0});
  return cell;
}

NodeRanges
KdTree::computeRanges(const std::vector<float>& values, unsigned threads) const
{
  NodeRanges ranges;
  ranges.values = values.data();
  ranges.inner.resize(planes_.size());
  TaskGroup::run(threads, [&] { fillRanges(ranges, getRoot()); });
  return ranges;
}

} // namespace pcl_uvol
