// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracing/tree_builder.h"

#include "common/parallel.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/** Places between which the best cut is looked for. */
constexpr int bins = 16;

/** Nodes below this depth cut at the median, so that no tree is deeper than another
 * eight levels. */
constexpr int balanced_depth = 24;

struct Box {
  float low[3] = {infinity, infinity, infinity};
  float high[3] = {-infinity, -infinity, -infinity};

  void
  add(const float* other_low, const float* other_high)
  {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other_low[axis]);
      high[axis] = std::max(high[axis], other_high[axis]);
    }
  }

  /** Half its surface; 0 of an empty one. */
  float
  area() const
  {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x >= 0.0f ? x * y + y * z + z * x : 0.0f;
  }
};

/** Consecutive items. */
struct Range {
  std::uint32_t begin, end;
  Box box;

  std::uint32_t
  count() const
  {
    return end - begin;
  }
};

/** A cut before a bin along an axis. */
struct Cut {
  int axis = -1; ///< none
  int bin = 0;
  float cost = infinity;
};

/** Twice the centre of a box. */
float
middle(const ItemBox& box, int axis)
{
  return box.low[axis] + box.high[axis];
}

/** Which bin the middle of an item falls into. */
struct Binning {
  float offset, scale;

  int
  operator()(float value) const
  {
    return std::min(bins - 1, static_cast<int>((value - offset) * scale));
  }
};

class Builder {
public:
  Builder(const std::vector<ItemBox>& boxes,
          std::vector<std::uint32_t>& items,
          StepTimer& step)
      : boxes_(boxes)
      , items_(items)
      , step_(step)
  {
  }

  Range
  findRange(std::uint32_t begin, std::uint32_t end) const
  {
    Range range{begin, end, {}};
    for (std::uint32_t i = begin; i < end; ++i)
      range.box.add(boxes_[items_[i]].low, boxes_[items_[i]].high);
    return range;
  }

  /** Up to tree_width parts of a range, in its order. */
  std::vector<Range>
  divide(const Range& range, int depth)
  {
    std::vector<Range> parts{range};
    while (parts.size() < tree_width) {
      // The part that most rays would look into in vain.
      std::size_t worst = parts.size();
      float most = -1.0f;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        const float cost = parts[i].box.area() * static_cast<float>(parts[i].count());
        if (parts[i].count() > tree_width && cost > most) {
          most = cost;
          worst = i;
        }
      }
      if (worst == parts.size())
        break;
      const std::uint32_t begin = parts[worst].begin, end = parts[worst].end;
      const std::uint32_t cut = split(parts[worst], depth);
      parts[worst] = findRange(begin, cut);
      parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(worst) + 1,
                   findRange(cut, end));
    }
    return parts;
  }

  /** Append a node with all that is below it. */
  std::uint32_t
  build(const Range& range, int depth, WideTree& tree)
  {
    const auto number = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.push_back(emptyNode());
    std::uint64_t in_leaves = 0;
    const std::vector<Range> parts = divide(range, depth);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool is_leaf = parts[i].count() <= tree_width;
      const std::uint32_t child =
          is_leaf ? addLeaf(parts[i], tree) : build(parts[i], depth + 1, tree);
      setChild(tree.nodes[number], i, parts[i], child);
      in_leaves += is_leaf ? parts[i].count() : 0;
    }
    step_.advance(in_leaves);
    return number;
  }

  static std::uint32_t
  addLeaf(const Range& part, WideTree& tree)
  {
    tree.leaf_begin.push_back(part.begin);
    return static_cast<std::uint32_t>(tree.leaf_begin.size() - 1) | leaf_bit;
  }

  static TreeNode
  emptyNode()
  {
    TreeNode node{};
    for (int axis = 0; axis < 3; ++axis) {
      std::fill(node.low[axis], node.low[axis] + tree_width, infinity);
      std::fill(node.high[axis], node.high[axis] + tree_width, -infinity);
    }
    return node;
  }

  static void
  setChild(TreeNode& node, std::size_t slot, const Range& part, std::uint32_t child)
  {
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][slot] = part.box.low[axis];
      node.high[axis][slot] = part.box.high[axis];
    }
    node.child[slot] = child;
  }

private:
  /** Reorder a range of more than tree_width items;
   * \return where its second part begins. */
  std::uint32_t
  split(const Range& range, int depth)
  {
    std::array<float, 3> low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = infinity;
      high[axis] = -infinity;
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const float value = middle(boxes_[items_[i]], axis);
        low[axis] = std::min(low[axis], value);
        high[axis] = std::max(high[axis], value);
      }
    }
    Cut best;
    Binning best_binning{};
    if (depth < balanced_depth)
      for (int axis = 0; axis < 3; ++axis) {
        const float extent = high[axis] - low[axis];
        const Binning binning{low[axis], bins / extent};
        if (!(extent > 0.0f) || !(binning.scale < infinity))
          continue;
        const Cut cut = bestCut(range, axis, binning);
        if (cut.cost < best.cost) {
          best = cut;
          best_binning = binning;
        }
      }
    const auto first = items_.begin() + range.begin, last = items_.begin() + range.end;
    if (best.axis >= 0) {
      const auto cut = std::stable_partition(first, last, [&](std::uint32_t item) {
        return best_binning(middle(boxes_[item], best.axis)) < best.bin;
      });
      return static_cast<std::uint32_t>(cut - items_.begin());
    }
    int axis = 0;
    for (int other = 1; other < 3; ++other)
      if (range.box.high[other] - range.box.low[other] >
          range.box.high[axis] - range.box.low[axis])
        axis = other;
    const auto half = first + (last - first) / 2;
    std::nth_element(first, half, last, [&](std::uint32_t a, std::uint32_t b) {
      const float x = middle(boxes_[a], axis), y = middle(boxes_[b], axis);
      return x != y ? x < y : a < b;
    });
    return static_cast<std::uint32_t>(half - items_.begin());
  }

  Cut
  bestCut(const Range& range, int axis, const Binning& binning) const
  {
    std::array<Box, bins> box;
    std::array<std::uint32_t, bins> count{};
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const ItemBox& item = boxes_[items_[i]];
      const auto bin = static_cast<std::size_t>(binning(middle(item, axis)));
      box[bin].add(item.low, item.high);
      ++count[bin];
    }
    // From above, then from below.
    std::array<float, bins> cost_above{};
    Box sum;
    std::uint32_t items = 0;
    for (std::size_t bin = bins - 1; bin > 0; --bin) {
      sum.add(box[bin].low, box[bin].high);
      items += count[bin];
      cost_above[bin] = sum.area() * static_cast<float>(items);
    }
    Cut best;
    sum = Box();
    items = 0;
    for (std::size_t bin = 1; bin < bins; ++bin) {
      sum.add(box[bin - 1].low, box[bin - 1].high);
      items += count[bin - 1];
      const float cost = sum.area() * static_cast<float>(items) + cost_above[bin];
      if (items > 0 && items < range.count() && cost < best.cost)
        best = {axis, static_cast<int>(bin), cost};
    }
    return best;
  }

  const std::vector<ItemBox>& boxes_;
  std::vector<std::uint32_t>& items_;
  StepTimer& step_;
};

/** Append the nodes and leaves of a subtree.
 * \return its root */
std::uint32_t
append(const WideTree& subtree, WideTree& tree)
{
  const auto nodes = static_cast<std::uint32_t>(tree.nodes.size());
  const auto leaves = static_cast<std::uint32_t>(tree.leaf_begin.size());
  for (TreeNode node : subtree.nodes) {
    for (std::uint32_t& child : node.child)
      child += (child & leaf_bit) != 0 ? leaves : nodes;
    tree.nodes.push_back(node);
  }
  tree.leaf_begin.insert(
      tree.leaf_begin.end(), subtree.leaf_begin.begin(), subtree.leaf_begin.end());
  return nodes;
}

} // namespace

WideTree
buildWideTree(const std::vector<ItemBox>& boxes, unsigned threads, StepTimer& step)
{
  WideTree tree;
  tree.items.resize(boxes.size());
  std::iota(tree.items.begin(), tree.items.end(), 0u);
  Builder builder(boxes, tree.items, step);
  const std::vector<Range> parts =
      builder.divide(builder.findRange(0, static_cast<std::uint32_t>(boxes.size())), 0);
  std::vector<WideTree> subtrees(parts.size());
  parallelBlocks(parts.size(), 1, threads, [&](std::size_t i, std::size_t) {
    if (parts[i].count() > tree_width)
      builder.build(parts[i], 1, subtrees[i]);
  });
  tree.nodes.push_back(Builder::emptyNode());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::uint32_t child = parts[i].count() > tree_width
                                    ? append(subtrees[i], tree)
                                    : Builder::addLeaf(parts[i], tree);
    Builder::setChild(tree.nodes.front(), i, parts[i], child);
  }
  tree.leaf_begin.push_back(static_cast<std::uint32_t>(boxes.size()));
  return tree;
}

} // namespace pcl_uvol
