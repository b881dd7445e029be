// SPDX-License-Identifier: BSD-3-Clause
// Finds balls around samples that reach a place: a hierarchy over the buckets of the
// tree, with the largest radius below every node.
#pragma once

#include "neighbors/sample_set.h"

#include <array>
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
    double reach; ///< no ball of its samples is larger
  };

  /** \param reach of a bucket whose own is not set yet; called from several threads */
  BallTree(const SampleSet& samples,
           const std::function<double(const Bucket&)>& reach,
           unsigned threads);

  const std::vector<Bucket>&
  getBuckets() const
  {
    return buckets_;
  }

  /** \brief The bucket that holds a sample. */
  std::size_t
  bucketOf(std::uint32_t sample) const;

  /** \brief Append the buckets of which a ball, its radius times a factor, may reach
   * into a box, ascending; false, and not all of them, if they are more than most. */
  bool
  findReaching(const std::array<double, 3>& low,
               const std::array<double, 3>& high,
               double factor,
               std::size_t most,
               std::vector<std::uint32_t>& buckets) const;

private:
  /** Buckets below a node of the tree, and the largest reach among them. */
  struct Node {
    KdBox box;
    double reach;
    std::uint32_t bucket;      ///< of a leaf
    std::uint32_t left, right; ///< 0: a leaf
  };

  std::uint32_t
  addNode(const KdTree& tree, const KdNode& node);

  std::vector<Bucket> buckets_;
  std::vector<Node> nodes_;
};

} // namespace pcl_uvol::detail
