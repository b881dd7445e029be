// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/ball_tree.h"

#include "common/parallel.h"

#include <algorithm>
#include <utility>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t block_buckets = 64;

KdBox
joined(const KdBox& a, const KdBox& b)
{
  KdBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(a.low[axis], b.low[axis]);
    box.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return box;
}

} // namespace

double
sqGap(const std::array<double, 3>& low,
      const std::array<double, 3>& high,
      const KdBox& box)
{
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int i = static_cast<int>(axis);
    const double gap = std::max({static_cast<double>(box.low[i]) - high[axis],
                                 low[axis] - static_cast<double>(box.high[i]),
                                 0.0});
    sum += gap * gap;
  }
  return sum;
}

BallTree::BallTree(const SampleSet& samples,
                   const FindReach& reach,
                   unsigned threads,
                   FindReach closer)
    : closer_(std::move(closer))
{
  addNode(samples.getTree(), samples.getTree().getRoot(), 0);
  is_close_ = std::vector<std::atomic<bool>>(buckets_.size());
  for (std::atomic<bool>& is_close : is_close_)
    is_close.store(!closer_, std::memory_order_relaxed);
  std::vector<double> of_buckets(buckets_.size());
  parallelBlocks(buckets_.size(), block_buckets, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      of_buckets[i] = reach(buckets_[i]);
  });
  reaches_ = std::vector<std::atomic<double>>(nodes_.size());
  // Children stand behind their parents.
  for (std::size_t i = nodes_.size(); i-- > 0;)
    reaches_[i].store(nodes_[i].left == 0 ? of_buckets[nodes_[i].bucket]
                                          : largestBelow(nodes_[i]),
                      std::memory_order_relaxed);
}

double
BallTree::largestBelow(const Node& node) const
{
  return std::max(reaches_[node.left].load(std::memory_order_relaxed),
                  reaches_[node.right].load(std::memory_order_relaxed));
}

std::uint32_t
BallTree::addNode(const KdTree& tree, const KdNode& node, std::uint32_t parent)
{
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({});
  nodes_[index].box = tree.getBox(node);
  nodes_[index].parent = parent;
  if (KdTree::isBucket(node)) {
    nodes_[index].bucket = static_cast<std::uint32_t>(buckets_.size());
    buckets_.push_back({node.begin, node.count, nodes_[index].box});
    return index;
  }
  const std::uint32_t left = addNode(tree, node.left(), index),
                      right = addNode(tree, node.right(), index);
  nodes_[index].left = left;
  nodes_[index].right = right;
  nodes_[index].box = joined(nodes_[left].box, nodes_[right].box);
  return index;
}

std::size_t
BallTree::findBucket(std::uint32_t sample) const
{
  const auto after = std::upper_bound(
      buckets_.begin(), buckets_.end(), sample, [](std::uint32_t s, const Bucket& b) {
        return s < b.begin;
      });
  return static_cast<std::size_t>(after - buckets_.begin()) - 1;
}

void
BallTree::boundCloser(std::uint32_t leaf) const
{
  const std::uint32_t bucket = nodes_[leaf].bucket;
  reaches_[leaf].store(closer_(buckets_[bucket]), std::memory_order_relaxed);
  is_close_[bucket].store(true, std::memory_order_release);
  for (std::uint32_t node = leaf; node != 0;) {
    node = nodes_[node].parent;
    const double reach = largestBelow(nodes_[node]);
    if (reach >= reaches_[node].load(std::memory_order_relaxed))
      break;
    reaches_[node].store(reach, std::memory_order_relaxed);
  }
}

bool
BallTree::findReaching(const std::array<double, 3>& low,
                       const std::array<double, 3>& high,
                       double factor,
                       std::size_t most,
                       std::vector<std::uint32_t>& buckets) const
{
  std::uint32_t stack[64];
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    const double sq_gap = sqGap(low, high, node.box);
    const auto reaches = [&] {
      const double reach = factor * reaches_[index].load(std::memory_order_relaxed);
      return sq_gap <= reach * reach;
    };
    if (!reaches())
      continue;
    if (node.left == 0) {
      if (!is_close_[node.bucket].load(std::memory_order_acquire)) {
        boundCloser(index);
        if (!reaches())
          continue;
      }
      if (buckets.size() == most)
        return false;
      buckets.push_back(node.bucket);
      continue;
    }
    stack[depth++] = node.right;
    stack[depth++] = node.left;
  }
  return true;
}

} // namespace pcl_uvol::detail
