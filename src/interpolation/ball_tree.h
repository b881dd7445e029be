// SPDX-License-Identifier: BSD-3-Clause
// Finds balls around samples that reach a place: a hierarchy over the buckets of the
// tree, with the largest radius below every node.
#pragma once

#include "neighbors/sample_set.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Least squared distance between two boxes. */
double
sqGap(const std::array<double, 3>& low,
      const std::array<double, 3>& high,
      const KdBox& box);

/** \brief The buckets of a tree of samples, and how far balls around their samples
 * reach. */
class BallTree {
public:
  /** \brief Consecutive samples. */
  struct Bucket {
    std::uint32_t begin, count;
    KdBox box;
  };

  /** \brief How far balls around the samples of a bucket reach at most; called from
   * several threads. */
  using FindReach = std::function<double(const Bucket&)>;

  /** \param reach of every bucket
   * \param closer a smaller bound for buckets that some place is within the reach of,
   * if that one is worth some work; kept once it is found */
  BallTree(const SampleSet& samples,
           const FindReach& reach,
           unsigned threads,
           FindReach closer = nullptr);
  BallTree(const BallTree&) = delete;
  BallTree&
  operator=(const BallTree&) = delete;

  const std::vector<Bucket>&
  getBuckets() const
  {
    return buckets_;
  }

  /** \brief The bucket that holds a sample. */
  std::size_t
  findBucket(std::uint32_t sample) const;

  /** \brief Append the buckets of which a ball, its radius times a factor, may reach
   * into a box, ascending; false, and not all of them, if they are more than most. */
  bool
  findReaching(const std::array<double, 3>& low,
               const std::array<double, 3>& high,
               double factor,
               std::size_t most,
               std::vector<std::uint32_t>& buckets) const;

private:
  /** Buckets below a node of the tree. */
  struct Node {
    KdBox box;
    std::uint32_t bucket;      ///< of a leaf
    std::uint32_t left, right; ///< 0: a leaf
    std::uint32_t parent;      ///< of the root itself
  };

  double
  largestBelow(const Node& node) const;

  /** Finds the closer bound of a leaf, which its parents may have smaller bounds by. */
  void
  boundCloser(std::uint32_t leaf) const;

  std::uint32_t
  addNode(const KdTree& tree, const KdNode& node, std::uint32_t parent);

  const FindReach closer_;
  std::vector<Bucket> buckets_;
  std::vector<Node> nodes_;
  /** The largest reach of the buckets of each node. Bounds only fall, and of those that
   * threads write at once any may stay: all of them are bounds. */
  mutable std::vector<std::atomic<double>> reaches_;
  mutable std::vector<std::atomic<bool>> is_close_; ///< by bucket
};

} // namespace pcl_uvol::detail
