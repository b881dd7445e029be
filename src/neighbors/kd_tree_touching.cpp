// SPDX-License-Identifier: BSD-3-Clause
// Cells of the bit-indexed kd-tree that touch: the surrounding neighbours of one cell
// (thesis 2.2.2 - 2.2.4) and the pairs of touching cells that an isosurface passes
// between.
#include "common/parallel.h"
#include "neighbors/kd_tree.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace pcl_uvol {

namespace {

/** A node number has at most 64 bits. */
constexpr int max_depth = 64;

bool
crosses(const NodeRanges::Range& a, const NodeRanges::Range& b, float isovalue)
{
  const NodeRanges::Range range = a.joined(b);
  return range.min < isovalue && range.max >= isovalue;
}

/** Descends pairs of touching nodes whose common range of values holds the isovalue. */
class CrossingSearch {
public:
  CrossingSearch(const KdTree& tree,
                 const std::vector<Position>& positions,
                 const NodeRanges& ranges,
                 float isovalue)
      : tree_(tree)
      , positions_(positions)
      , ranges_(ranges)
      , isovalue_(isovalue)
      , crossing_((positions.size() + word_bits - 1) / word_bits)
  {
  }

  /** All pairs inside a node: those inside its halves, and those across its plane. */
  void
  within(const KdNode& node, const KdCell& cell)
  {
    if (node.isLeaf() || !crosses(ranges_[node], ranges_[node]))
      return;
    const int axis = tree_.getAxis(node);
    const KdNode left = node.left(), right = node.right();
    KdCell left_cell = cell, right_cell = cell;
    left_cell.high[static_cast<std::size_t>(axis)] = tree_.getPlane(node);
    right_cell.low[static_cast<std::size_t>(axis)] = tree_.getPlane(node);
    const auto search_left = [&] { within(left, left_cell); };
    const auto search_right = [&] { within(right, right_cell); };
    if (node.count < task_samples) {
      search_left();
      search_right();
    }
    else
      TaskGroup::fork(search_left, search_right);
    if (crosses(ranges_[left], ranges_[right]))
      across(left, left_cell, right, right_cell, axis);
  }

  std::vector<std::uint32_t>
  collect() const
  {
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < crossing_.size(); ++i)
      for (std::uint64_t word = crossing_[i]; word != 0; word &= word - 1)
        found.push_back(
            static_cast<std::uint32_t>(i * word_bits) +
            static_cast<std::uint32_t>(__builtin_ctzll(word))); // its lowest bit
    return found;
  }

private:
  /** Below this many samples a subtree is one task. */
  static constexpr std::uint32_t task_samples = 1u << 14;
  static constexpr std::size_t word_bits = 64;

  void
  mark(std::uint32_t sample)
  {
    std::atomic<std::uint64_t>& word = crossing_[sample / word_bits];
    const std::uint64_t bit = std::uint64_t(1) << (sample % word_bits);
    if ((word.load(std::memory_order_relaxed) & bit) == 0)
      word.fetch_or(bit, std::memory_order_relaxed);
  }

  bool
  crosses(const NodeRanges::Range& a, const NodeRanges::Range& b) const
  {
    return pcl_uvol::crosses(a, b, isovalue_);
  }

  /** All pairs of a sample in lower and one in upper, two touching nodes that a plane
   * of the given axis parts and whose common range holds the isovalue. The larger node
   * is split; halves that do not touch the other node are left out by the same tests as
   * in Table 2.3. Cells are as they were when it returns. */
  void
  across(const KdNode& lower,
         KdCell& lower_cell,
         const KdNode& upper,
         KdCell& upper_cell,
         int separating_axis)
  {
    if (lower.isLeaf() && upper.isLeaf()) {
      mark(lower.begin);
      mark(upper.begin);
      return;
    }
    const bool split_lower = lower.count >= upper.count;
    const KdNode& node = split_lower ? lower : upper;
    const KdNode& other = split_lower ? upper : lower;
    KdCell& cell = split_lower ? lower_cell : upper_cell;
    const KdCell& other_cell = split_lower ? upper_cell : lower_cell;
    const int axis = tree_.getAxis(node);
    const auto a = static_cast<std::size_t>(axis);
    const SplitPlane& plane = tree_.getPlane(node);
    const bool parallel = axis == separating_axis;
    const auto visit = [&](const KdNode& half, SplitPlane& bound) {
      if (!crosses(ranges_[half], ranges_[other]))
        return;
      const SplitPlane outer = bound;
      bound = plane;
      if (split_lower)
        across(half, lower_cell, upper, upper_cell, separating_axis);
      else
        across(lower, lower_cell, half, upper_cell, separating_axis);
      bound = outer;
    };
    // Parallel to the separating plane only the half next to it touches.
    if (parallel ? !split_lower
                 : tree_.isBelow(positions_, axis, other_cell.low[a], plane))
      visit(node.left(), cell.high[a]);
    if (parallel ? split_lower
                 : tree_.isBelow(positions_, axis, plane, other_cell.high[a]))
      visit(node.right(), cell.low[a]);
  }

  const KdTree& tree_;
  const std::vector<Position>& positions_;
  const NodeRanges& ranges_;
  float isovalue_;
  std::vector<std::atomic<std::uint64_t>> crossing_; // a bit per sample
};

/** Descends a tree to its samples that touch one of another tree on the other side. */
class BorderSearch {
public:
  BorderSearch(const KdTree& tree,
               const std::vector<Position>& positions,
               const NodeRanges& ranges,
               float isovalue,
               const KdTree& other,
               std::vector<std::uint32_t>& crossing)
      : tree_(tree)
      , positions_(positions)
      , ranges_(ranges)
      , isovalue_(isovalue)
      , other_(other)
      , crossing_(crossing)
  {
    const float* const first = ranges.values + other.getRoot().begin;
    const auto [min, max] = std::minmax_element(first, first + other.getRoot().count);
    other_range_ = {*min, *max};
  }

  void
  descend(const KdNode& node, KdCell& cell)
  {
    if (!crosses(ranges_[node], other_range_, isovalue_) ||
        !KdTree::touch(positions_, cell, other_.getCell()))
      return;
    if (node.isLeaf()) {
      examine(node.begin, cell);
      return;
    }
    const auto axis = static_cast<std::size_t>(tree_.getAxis(node));
    const SplitPlane low = cell.low[axis], high = cell.high[axis];
    cell.high[axis] = tree_.getPlane(node);
    descend(node.left(), cell);
    cell.low[axis] = cell.high[axis];
    cell.high[axis] = high;
    descend(node.right(), cell);
    cell.low[axis] = low;
  }

private:
  void
  examine(std::uint32_t sample, const KdCell& cell)
  {
    touching_.clear();
    other_.findTouching(positions_, cell, touching_);
    const bool is_above = ranges_.values[sample] >= isovalue_;
    if (std::any_of(touching_.begin(), touching_.end(), [&](std::uint32_t y) {
          return (ranges_.values[y] >= isovalue_) != is_above;
        }))
      crossing_.push_back(sample);
  }

  const KdTree& tree_;
  const std::vector<Position>& positions_;
  const NodeRanges& ranges_;
  float isovalue_;
  const KdTree& other_;
  NodeRanges::Range other_range_;
  std::vector<std::uint32_t>& crossing_;
  std::vector<std::uint32_t> touching_;
};

} // namespace

void
KdTree::searchSubtree(const std::vector<Position>& positions,
                      const KdNode& subtree,
                      int separating_axis,
                      bool subtree_is_above,
                      const KdCell& cell,
                      std::vector<std::uint32_t>& touching) const
{
  // Parallel to the separating plane only the half next to it can touch. An infinite
  // extent of the cell says so without a branch: beyond all planes, or before them.
  constexpr float infinity = std::numeric_limits<float>::infinity();
  KdCell extent = cell;
  const auto separating = static_cast<std::size_t>(separating_axis);
  extent.low[separating] =
      extent.high[separating] = {subtree_is_above ? -infinity : infinity, 0};
  // A path leaves at most one half behind per level, and one more that is put down but
  // not counted.
  KdNode left_behind[max_depth + 1];
  int size = 0;
  for (KdNode node = subtree;;) {
    while (!node.isLeaf()) {
      const int axis = getAxis(node);
      const auto a = static_cast<std::size_t>(axis);
      const SplitPlane& plane = getPlane(node);
      // One of the halves touches at least.
      const bool visit_right = isBelow(positions, axis, plane, extent.high[a]);
      const bool visit_left = isBelow(positions, axis, extent.low[a], plane);
      left_behind[size] = node.right();
      size += static_cast<int>(visit_left & visit_right);
      node = visit_left ? node.left() : node.right();
    }
    touching.push_back(node.begin);
    if (size == 0)
      return;
    node = left_behind[--size];
  }
}

void
KdTree::findTouching(const std::vector<Position>& positions,
                     std::uint32_t sample,
                     std::vector<std::uint32_t>& touching) const
{
  touching.clear();
  // The path from the root: bit d of the leaf's number says on which side of the plane
  // at depth d the cell lies. Per axis the last 0 bit names the plane above the cell
  // and the last 1 bit the plane below it (Example 2.5); an axis without one lies at
  // the border.
  KdNode path[max_depth];
  int last_below[3] = {-1, -1, -1}, last_above[3] = {-1, -1, -1};
  KdNode node = getRoot();
  while (!node.isLeaf()) {
    path[node.depth] = node;
    const int axis = getAxis(node);
    const KdNode left = node.left();
    if (sample < left.begin + left.count) {
      last_above[axis] = node.depth;
      node = left;
    }
    else {
      last_below[axis] = node.depth;
      node = node.right();
    }
  }
  KdCell cell = cell_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (last_below[axis] >= 0)
      cell.low[axis] = getPlane(path[last_below[axis]]);
    if (last_above[axis] >= 0)
      cell.high[axis] = getPlane(path[last_above[axis]]);
  }
  // Cells beyond no bounding plane cannot touch, and the plane at which two paths part
  // is unique: every touching cell is found, and once. Direct neighbours (2.2.3) are
  // those beyond the last three planes, indirect ones (2.2.4) those beyond the others.
  for (int axis = 0; axis < 3; ++axis) {
    if (last_below[axis] >= 0)
      searchSubtree(
          positions, path[last_below[axis]].left(), axis, false, cell, touching);
    if (last_above[axis] >= 0)
      searchSubtree(
          positions, path[last_above[axis]].right(), axis, true, cell, touching);
  }
}

KdCell
KdTree::findCell(std::uint32_t sample) const
{
  KdCell cell = cell_;
  for (KdNode node = root_; !node.isLeaf();) {
    const auto axis = static_cast<std::size_t>(getAxis(node));
    const SplitPlane& plane = getPlane(node);
    const KdNode left = node.left();
    const bool is_below = sample < left.begin + left.count;
    (is_below ? cell.high : cell.low)[axis] = plane;
    node = is_below ? left : node.right();
  }
  return cell;
}

void
KdTree::findTouching(const std::vector<Position>& positions,
                     const KdCell& cell,
                     std::vector<std::uint32_t>& touching) const
{
  if (!touch(positions, cell, cell_))
    return;
  // The plane at which the paths of touching cells part bounds both.
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const bool is_above = !isBelow(positions, axis, cell_.low[a], cell.high[a]);
    if (is_above || !isBelow(positions, axis, cell.low[a], cell_.high[a])) {
      searchSubtree(positions, root_, axis, is_above, cell, touching);
      return;
    }
  }
}

bool
KdTree::touch(const std::vector<Position>& positions, const KdCell& a, const KdCell& b)
{
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (isBelow(positions, axis, a.high[i], b.low[i]) ||
        isBelow(positions, axis, b.high[i], a.low[i]))
      return false;
  }
  return true;
}

std::vector<std::uint32_t>
KdTree::findCrossing(const std::vector<Position>& positions,
                     const NodeRanges& ranges,
                     float isovalue,
                     unsigned threads) const
{
  CrossingSearch search(*this, positions, ranges, isovalue);
  TaskGroup::run(threads, [&] { search.within(getRoot(), getCell()); });
  return search.collect();
}

void
KdTree::findCrossing(const std::vector<Position>& positions,
                     const NodeRanges& ranges,
                     float isovalue,
                     const KdTree& other,
                     std::vector<std::uint32_t>& crossing) const
{
  KdCell cell = cell_;
  BorderSearch(*this, positions, ranges, isovalue, other, crossing)
      .descend(root_, cell);
}

} // namespace pcl_uvol
