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
  addNode(samples.getTree(), samples.getTree().getRoot());
  closer_reaches_ = std::vector<std::atomic<double>>(closer_ ? buckets_.size() : 0);
  for (std::atomic<double>& unknown : closer_reaches_)
    unknown.store(-1.0, std::memory_order_relaxed);
  std::vector<double> reaches(buckets_.size());
  parallelBlocks(buckets_.size(), block_buckets, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      reaches[i] = reach(buckets_[i]);
  });
  // Children stand behind their parents.
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node)
    node->reach = node->left == 0
                      ? reaches[node->bucket]
                      : std::max(nodes_[node->left].reach, nodes_[node->right].reach);
}

std::uint32_t
BallTree::addNode(const KdTree& tree, const KdNode& node)
{
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({});
  nodes_[index].box = tree.getBox(node);
  if (KdTree::isBucket(node)) {
    nodes_[index].bucket = static_cast<std::uint32_t>(buckets_.size());
    buckets_.push_back({node.begin, node.count, nodes_[index].box});
    return index;
  }
  const std::uint32_t left = addNode(tree, node.left()),
                      right = addNode(tree, node.right());
  nodes_[index].left = left;
  nodes_[index].right = right;
  nodes_[index].box = joined(nodes_[left].box, nodes_[right].box);
  return index;
}

std::size_t
BallTree::bucketOf(std::uint32_t sample) const
{
  const auto after = std::upper_bound(
      buckets_.begin(), buckets_.end(), sample, [](std::uint32_t s, const Bucket& b) {
        return s < b.begin;
      });
  return static_cast<std::size_t>(after - buckets_.begin()) - 1;
}

double
BallTree::findCloserReach(const Node& leaf) const
{
  std::atomic<double>& kept = closer_reaches_[leaf.bucket];
  double reach = kept.load(std::memory_order_relaxed);
  if (reach < 0.0) { // threads that find it at once find the same
    reach = closer_(buckets_[leaf.bucket]);
    kept.store(reach, std::memory_order_relaxed);
  }
  return reach;
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
    const Node& node = nodes_[stack[--depth]];
    const double reach = factor * node.reach;
    if (sqGap(low, high, node.box) > reach * reach)
      continue;
    if (node.left == 0) {
      if (closer_) {
        const double closer = factor * findCloserReach(node);
        if (sqGap(low, high, node.box) > closer * closer)
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
