// SPDX-License-Identifier: BSD-3-Clause
// Building the bit-indexed kd-tree (thesis Table 2.2), boxes around samples and the
// range of a scalar per node.
#include "neighbors/kd_tree.h"

#include "common/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <utility>

namespace pcl_uvol {

namespace {

/** Below this many samples a subtree is one task: large enough to hide the cost of a
 * fork, and small enough for the cache. Ranges cost a hundredth of the tree. */
constexpr std::uint32_t task_samples = 1u << 14, range_task_samples = 1u << 18;

constexpr std::size_t block_samples = 1u << 14;

/** Below this many records a pivot is the median of three, above it comes from a sample
 * of 32, and of 256 among very many. */
constexpr std::ptrdiff_t sampled_pivot_records = 128,
                         well_sampled_pivot_records = 1 << 13;
constexpr std::ptrdiff_t small_sample = 32, large_sample = 256;
/** Ranges this short are sorted by counting. */
constexpr std::ptrdiff_t counted_records = 16;

template <int axis>
bool
lessRecord(const SampleRecord& a, const SampleRecord& b)
{
  return lessAlong(axis, a.position, b.position);
}

/** A record in one register: piece by piece it would move at half the speed. */
using RecordRegister =
    float __attribute__((vector_size(sizeof(SampleRecord)), aligned(4), may_alias));

/** Bring records below the pivot to the front; returns the first of the others. Free of
 * branches that depend on the data: they would be mispredicted every other time. */
template <int axis>
SampleRecord*
partitionBelow(SampleRecord* first, SampleRecord* last, float pivot)
{
  SampleRecord* boundary = first;
  for (SampleRecord* record = first; record != last; ++record) {
    const RecordRegister moved = *reinterpret_cast<RecordRegister*>(record);
    *reinterpret_cast<RecordRegister*>(record) =
        *reinterpret_cast<RecordRegister*>(boundary);
    *reinterpret_cast<RecordRegister*>(boundary) = moved;
    boundary += static_cast<std::ptrdiff_t>(moved[axis] < pivot);
  }
  return boundary;
}

/** A pivot that leaves the cut in the smaller part: sampled at the cut's quantile,
 * moved to the far side by twice the standard error of a median of the sample (Floyd
 * and Rivest 1975). */
template <int axis>
float
choosePivot(const SampleRecord* first,
            const SampleRecord* cut,
            const SampleRecord* last)
{
  const std::ptrdiff_t count = last - first;
  if (count < sampled_pivot_records) {
    const float a = first->position[axis], b = first[count / 2].position[axis],
                c = first[count - 1].position[axis];
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
  }
  const bool many = count >= well_sampled_pivot_records;
  const std::ptrdiff_t size = many ? large_sample : small_sample;
  const std::ptrdiff_t margin = many ? 16 : 5; // root of the size
  float sample[large_sample];
  for (std::ptrdiff_t i = 0; i < size; ++i)
    sample[i] = first[i * count / size].position[axis];
  const std::ptrdiff_t quantile = (cut - first) * size / count;
  const std::ptrdiff_t rank = std::clamp<std::ptrdiff_t>(
      2 * (cut - first) < count ? quantile + margin : quantile - margin, 0, size - 1);
  std::nth_element(sample, sample + rank, sample + size);
  return sample[rank];
}

/** Sort at most that many records by coordinate: each goes to the place that the number
 * of lesser ones names. */
template <int axis, int most>
void
sortByCounting(SampleRecord* first, std::ptrdiff_t count)
{
  SampleRecord record[most];
  float key[most];
  std::fill(key, key + most, std::numeric_limits<float>::infinity());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    record[i] = first[i];
    key[i] = record[i].position[axis];
  }
  for (int i = 0; i < count; ++i) {
    int lesser = 0;
    for (int j = 0; j < most; ++j)
      lesser += static_cast<int>(key[j] < key[i]) |
                (static_cast<int>(key[j] == key[i]) & static_cast<int>(j < i));
    first[lesser] = record[i];
  }
}

template <int axis>
void
sortFew(SampleRecord* first, SampleRecord* last)
{
  const std::ptrdiff_t count = last - first;
  if (count == 2) {
    if (first[1].position[axis] < first[0].position[axis])
      std::swap(first[0], first[1]);
  }
  else if (count <= 4)
    sortByCounting<axis, 4>(first, count);
  else if (count <= 8)
    sortByCounting<axis, 8>(first, count);
  else
    sortByCounting<axis, counted_records>(first, count);
}

/** Part records by the total order along an axis: the cut is the first of the upper
 * part.
 * \return the last record of the lower part and the first of the upper one by that
 * order */
template <int axis>
std::pair<SampleRecord*, SampleRecord*>
partAtCut(SampleRecord* const first, SampleRecord* const cut, SampleRecord* const last)
{
  // All records before low are less, all from high on are not less than those between.
  SampleRecord *low = first, *high = last;
  while (high - low > counted_records) {
    SampleRecord* const boundary =
        partitionBelow<axis>(low, high, choosePivot<axis>(low, cut, high));
    if (boundary == cut)
      return {std::max_element(low, cut, lessRecord<axis>),
              std::min_element(cut, high, lessRecord<axis>)};
    if (boundary == low) // nothing below the pivot: many equal coordinates
      break;
    (boundary < cut ? low : high) = boundary;
  }
  if (high - low <= counted_records) {
    sortFew<axis>(low, high);
    SampleRecord* below = cut - 1;
    while (below > low && below[-1].position[axis] == cut[-1].position[axis])
      --below;
    if (cut[-1].position[axis] < cut->position[axis])
      return {std::max_element(below, cut, lessRecord<axis>),
              std::min_element(cut, high, lessRecord<axis>)};
  }
  // Equal coordinates on both sides of the cut: the other coordinates decide.
  std::nth_element(first, cut - 1, last, lessRecord<axis>);
  return {cut - 1, std::min_element(cut, last, lessRecord<axis>)};
}

/** Finds records of equal positions. One object per block of records. */
class EqualPositions {
public:
  /** \param most records that are looked at */
  explicit EqualPositions(std::size_t most)
  {
    while ((std::size_t(1) << bits_) < 2 * most)
      ++bits_;
    places_.assign(std::size_t(1) << bits_, empty);
  }

  /** \param count less than task_samples */
  bool
  areAmong(const SampleRecord* records, std::uint32_t count)
  {
    const std::size_t last = places_.size() - 1;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Position& position = records[i].position;
      std::size_t place = hash(position);
      for (; places_[place] != empty; place = (place + 1) & last) {
        const Position& other = records[places_[place]].position;
        if (position[0] == other[0] && position[1] == other[1] &&
            position[2] == other[2])
          return true;
      }
      places_[place] = static_cast<std::uint16_t>(i);
    }
    return false;
  }

private:
  static constexpr std::uint16_t empty = std::numeric_limits<std::uint16_t>::max();
  static_assert(task_samples < empty, "places are numbers of records");

  /** Hashes by multiplication with odd numbers, of which the upper bits are the best
   * mixed (Knuth, The Art of Computer Programming 3, 6.4). */
  std::size_t
  hash(const Position& position) const
  {
    std::uint32_t bits[3];
    std::memcpy(bits, position.x, sizeof(bits));
    std::uint32_t mixed =
        bits[0] * 0x9e3779b1u + bits[1] * 0x85ebca77u + bits[2] * 0xc2b2ae3du;
    mixed = (mixed ^ (mixed >> 15)) * 0x2c1b3c6du;
    return mixed >> (32 - bits_);
  }

  unsigned bits_ = 1;
  std::vector<std::uint16_t> places_;
};

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
  for (std::int8_t axis = 0; axis < 3; ++axis)
    if (axes[static_cast<std::size_t>(axis)])
      used.push_back(axis);
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
