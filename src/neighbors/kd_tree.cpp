// SPDX-License-Identifier: BSD-3-Clause
// Building the bit-indexed kd-tree (thesis Table 2.2), boxes around samples and the
// range of a scalar per node.
#include "neighbors/kd_tree.h"

#include "common/parallel.h"
#include "neighbors/equal_positions.h"
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

constexpr std::size_t block_samples = 1u << 14;

static_assert(task_samples <= EqualPositions::most_records);

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
    return axes_[static_cast<std::size_t>(node.depth)];
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

  explicit LongestSides(std::vector<std::int8_t>& axes)
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
  std::vector<std::int8_t>& axes_; // by node number
};

/** Parts records from the root down to blocks, which tell whether positions are equal;
 * only where none are the rest of the tree is of use.
 * \tparam Axes CycledAxes or LongestSides */
template <typename Axes>
class Builder {
public:
  using Cell = typename Axes::Cell;

  Builder(const Axes& axes,
          std::vector<SampleRecord>& records,
          std::vector<SplitPlane>& planes,
          std::vector<KdBox>& boxes,
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
    partToBlocks(root, cell);
    if (has_equals_)
      return false;
    buildBlocks(root, cell);
    return true;
  }

private:
  /** Where a cut runs through equal positions, they stay together between the others.
   */
  void
  partToBlocks(const KdNode& node, const Cell& cell)
  {
    if (node.count < task_samples) {
      inspectBlock(node);
      return;
    }
    KdNode left = node.left(), right = node.right();
    const int axis = axes_.choose(node, cell);
    if (const SampleRecord* const equal = split(node, axis)) {
      has_equals_.store(true, std::memory_order_relaxed);
      const auto [less_end, greater] = partAround(node, axis, equal->position);
      left.count = less_end - node.begin;
      right.begin = greater;
      right.count = node.begin + node.count - greater;
    }
    const float plane = planes_[node.number].coordinate;
    TaskGroup::fork([&] { partToBlocks(left, Axes::cutAbove(cell, axis, plane)); },
                    [&] { partToBlocks(right, Axes::cutBelow(cell, axis, plane)); });
  }

  /** Records below a position, equal to it and above it; returns the ends of the first
   * two parts. */
  std::pair<std::uint32_t, std::uint32_t>
  partAround(const KdNode& node, int axis, const Position position)
  {
    SampleRecord* const first = records_.data() + node.begin;
    SampleRecord* const last = first + node.count;
    SampleRecord* const less_end =
        std::partition(first, last, [&](const SampleRecord& record) {
          return lessAlong(axis, record.position, position);
        });
    SampleRecord* const greater =
        std::partition(less_end, last, [&](const SampleRecord& record) {
          return !lessAlong(axis, position, record.position);
        });
    return {static_cast<std::uint32_t>(less_end - records_.data()),
            static_cast<std::uint32_t>(greater - records_.data())};
  }

  void
  inspectBlock(const KdNode& block)
  {
    SampleRecord* const first = records_.data() + block.begin;
    if (!EqualPositions(block.count).areAmong(first, block.count))
      return;
    has_equals_.store(true, std::memory_order_relaxed);
    std::sort(first, first + block.count, lessRecord<0>);
  }

  void
  buildBlocks(const KdNode& node, const Cell& cell)
  {
    if (node.count < task_samples) {
      buildAlone(node, cell);
      step_.advance(node.count);
      return;
    }
    const int axis = axes_.choose(node, cell);
    const float plane = planes_[node.number].coordinate;
    TaskGroup::fork(
        [&] { buildBlocks(node.left(), Axes::cutAbove(cell, axis, plane)); },
        [&] { buildBlocks(node.right(), Axes::cutBelow(cell, axis, plane)); });
    joinBoxes(node);
  }

  /** A subtree by one task. */
  void
  buildAlone(const KdNode& node, const Cell& cell)
  {
    if (KdTree::isBucket(node)) {
      boxes_[node.number] = boxAround(node);
      buildBucket(node, cell);
      return;
    }
    const int axis = axes_.choose(node, cell);
    split(node, axis);
    const float plane = planes_[node.number].coordinate;
    buildAlone(node.left(), Axes::cutAbove(cell, axis, plane));
    buildAlone(node.right(), Axes::cutBelow(cell, axis, plane));
    joinBoxes(node);
  }

  void
  buildBucket(const KdNode& node, const Cell& cell)
  {
    if (node.isLeaf())
      return;
    const int axis = axes_.choose(node, cell);
    split(node, axis);
    const float plane = planes_[node.number].coordinate;
    buildBucket(node.left(), Axes::cutAbove(cell, axis, plane));
    buildBucket(node.right(), Axes::cutBelow(cell, axis, plane));
  }

  /** Returns a record of the position that stands on both sides of the cut, if there is
   * one. */
  const SampleRecord*
  split(const KdNode& node, int axis)
  {
    switch (axis) {
    case 0:
      return split<0>(node);
    case 1:
      return split<1>(node);
    default:
      return split<2>(node);
    }
  }

  template <int axis>
  const SampleRecord*
  split(const KdNode& node)
  {
    SampleRecord* const first = records_.data() + node.begin;
    SampleRecord* const last = first + node.count;
    SampleRecord* const cut = first + (node.count + 1) / 2; // first of the right half
    const auto [below, above] = partAtCut<axis>(first, cut, last);
    if (!lessRecord<axis>(*below, *above))
      return below;
    const double middle = 0.5 * (static_cast<double>(below->position[axis]) +
                                 static_cast<double>(above->position[axis]));
    planes_[node.number] = {static_cast<float>(middle), below->input_index};
    return nullptr;
  }

  KdBox
  boxAround(const KdNode& bucket) const
  {
    const auto* const first =
        reinterpret_cast<const RecordRegister*>(records_.data() + bucket.begin);
    RecordRegister low = *first, high = *first;
    for (std::uint32_t i = 1; i < bucket.count; ++i) {
      low = first[i] < low ? first[i] : low;
      high = first[i] > high ? first[i] : high;
    }
    return {{{low[0], low[1], low[2]}}, {{high[0], high[1], high[2]}}};
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
  std::vector<SampleRecord>& records_;
  std::vector<SplitPlane>& planes_;
  std::vector<KdBox>& boxes_;
  StepTimer& step_;
  std::atomic<bool> has_equals_{false};
};

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
KdTree::build(std::vector<SampleRecord>& records,
              unsigned threads,
              StepTimer& step,
              SplitRule rule)
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
KdTree::build(std::vector<SampleRecord>& records,
              const AxisCycle& axes,
              int depth,
              unsigned threads,
              StepTimer& step)
{
  return buildBy(SplitRule::Cycle, records, axes, depth, threads, step);
}

namespace {

KdBox
boxAround(const std::vector<SampleRecord>& records)
{
  KdBox box{records.front().position, records.front().position};
  for (const SampleRecord& record : records)
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], record.position[axis]);
      box.high[axis] = std::max(box.high[axis], record.position[axis]);
    }
  return box;
}

} // namespace

bool
KdTree::buildBy(SplitRule rule,
                std::vector<SampleRecord>& records,
                const AxisCycle& axes,
                int depth,
                unsigned threads,
                StepTimer& step)
{
  root_ = {1, 0, static_cast<std::uint32_t>(records.size()), depth};
  axis_at_depth_ = axes;
  planes_.assign(countParts(root_.count, 1), SplitPlane{0.0f, 0});
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
    is_built = buildWith(LongestSides(axes_), pcl_uvol::boxAround(records));
  }
  else
    is_built = buildWith(CycledAxes(axis_at_depth_), CycledAxes::Cell());
  if (!is_built)
    return false;

  // Planes were given input indices; the samples' leaf order is known only now.
  std::uint32_t highest = 0;
  for (const SampleRecord& record : records)
    highest = std::max(highest, record.input_index);
  std::vector<std::uint32_t> sample_of(static_cast<std::size_t>(highest) + 1);
  parallelBlocks(
      records.size(), block_samples, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          sample_of[records[i].input_index] = static_cast<std::uint32_t>(i);
      });
  parallelBlocks(
      planes_.size(), block_samples, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          planes_[i].below_sample = sample_of[planes_[i].below_sample];
      });
  return true;
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
