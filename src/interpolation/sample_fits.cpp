// SPDX-License-Identifier: BSD-3-Clause
#include "sample_fits.h"

#include "bucket_fitter.h"
#include <pcl_uvol/common/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t block_buckets = 64;

/** Room for the rounding of distances. */
constexpr double slack = 1.0001;

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

/** Least squared distance between two boxes. */
double
sqGap(const std::array<double, 3>& low,
      const std::array<double, 3>& high,
      const KdBox& b)
{
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int i = static_cast<int>(axis);
    const double gap = std::max({static_cast<double>(b.low[i]) - high[axis],
                                 low[axis] - static_cast<double>(b.high[i]),
                                 0.0});
    sum += gap * gap;
  }
  return sum;
}

} // namespace

SampleFits::SampleFits(const SampledFields& sampled, unsigned threads)
    : sampled_(sampled)
{
  addNode(sampled.samples->getTree().getRoot());
  parallelBlocks(buckets_.size(), block_buckets, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      buckets_[i].reach = boundReach(buckets_[i]);
  });
  // Children stand behind their parents.
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node)
    node->reach = node->left == 0
                      ? buckets_[node->bucket].reach
                      : std::max(nodes_[node->left].reach, nodes_[node->right].reach);
  fits_.resize(buckets_.size());
  once_ = std::vector<std::once_flag>(buckets_.size());
}

std::uint32_t
SampleFits::addNode(const KdNode& node)
{
  const KdTree& tree = sampled_.samples->getTree();
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({});
  nodes_[index].box = tree.getBox(node);
  if (KdTree::isBucket(node)) {
    nodes_[index].bucket = static_cast<std::uint32_t>(buckets_.size());
    buckets_.push_back({node.begin, node.count, nodes_[index].box, 0.0});
    return index;
  }
  const std::uint32_t left = addNode(node.left()), right = addNode(node.right());
  nodes_[index].left = left;
  nodes_[index].right = right;
  nodes_[index].box = joined(nodes_[left].box, nodes_[right].box);
  return index;
}

double
SampleFits::boundReach(const Bucket& bucket) const
{
  // Neighbours of the same bucket are no nearer than the nearest ones.
  const std::vector<Position>& positions = sampled_.samples->getPositions();
  constexpr std::size_t blended = BucketFitter::blended_samples;
  if (bucket.count <= blended) {
    // Few samples in all: their only bucket.
    double sq_extent = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double extent =
          static_cast<double>(bucket.box.high[axis]) - bucket.box.low[axis];
      sq_extent += extent * extent;
    }
    return slack * std::max(1.0, 2.0 * std::sqrt(sq_extent));
  }
  double sq_reach = 0.0;
  std::vector<double> sq_dists(bucket.count);
  for (std::uint32_t i = bucket.begin; i < bucket.begin + bucket.count; ++i) {
    const Query center{{positions[i][0], positions[i][1], positions[i][2]}};
    for (std::uint32_t j = 0; j < bucket.count; ++j)
      sq_dists[j] = sqDistance(center, positions[bucket.begin + j]);
    std::nth_element(sq_dists.begin(), sq_dists.begin() + blended, sq_dists.end());
    sq_reach = std::max(sq_reach, sq_dists[blended]);
  }
  return slack * std::sqrt(sq_reach);
}

std::size_t
SampleFits::bucketOf(std::uint32_t sample) const
{
  const auto after = std::upper_bound(
      buckets_.begin(), buckets_.end(), sample, [](std::uint32_t s, const Bucket& b) {
        return s < b.begin;
      });
  return static_cast<std::size_t>(after - buckets_.begin()) - 1;
}

const BucketFits&
SampleFits::getFits(std::size_t bucket) const
{
  std::call_once(once_[bucket], [&] {
    BucketFitter fitter(sampled_);
    fits_[bucket] = std::make_unique<const BucketFits>(
        fitter.fit(buckets_[bucket].begin, buckets_[bucket].count));
  });
  return *fits_[bucket];
}

bool
SampleFits::findReaching(const std::array<double, 3>& low,
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

std::uint64_t
SampleFits::countReduced() const
{
  std::uint64_t count = 0;
  for (const auto& fits : fits_)
    if (fits)
      count += static_cast<std::uint64_t>(
          std::count(fits->is_reduced.begin(), fits->is_reduced.end(), true));
  return count;
}

} // namespace pcl_uvol::detail
