// SPDX-License-Identifier: BSD-3-Clause
// Polynomials around every sample, made bucket by bucket of the tree when they are
// first asked for, and kept.
#pragma once

#include "field_model.h"
#include <pcl_uvol/neighbors/kd_tree.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The polynomials of a bucket of samples.
 *
 * Memory per sample: 24 bytes and 168 per field. */
struct BucketFits {
  std::vector<double> radius;   ///< [sample] of the support of the fit: its unit
  std::vector<double> sq_reach; ///< [sample] of the ball in which the fit has a weight
  std::vector<bool> is_inner;   ///< [sample] neighbours on all sides
  std::vector<bool> is_reduced; ///< [sample] neighbours on few planes or lines, or too
                                ///< few of them: a polynomial of lower degree
  std::vector<double> coefficients; ///< [sample][field][term], see PolynomialFit
  std::vector<double> errors;       ///< [sample][field] standard errors at the sample
};

/** \brief Fits of all samples. Any number of threads may ask for them at once. */
class SampleFits {
public:
  /** \param sampled must outlive the fits */
  SampleFits(const SampledFields& sampled, unsigned threads);

  /** \brief Consecutive samples whose fits are made together. */
  struct Bucket {
    std::uint32_t begin, count;
    KdBox box;
    double reach; ///< no ball of its samples is larger
  };

  const std::vector<Bucket>&
  getBuckets() const
  {
    return buckets_;
  }

  /** \brief The bucket that holds a sample. */
  std::size_t
  bucketOf(std::uint32_t sample) const;

  const BucketFits&
  getFits(std::size_t bucket) const;

  /** \brief Append the buckets of which a ball, its radius times a factor, may reach
   * into a box, ascending; false, and not all of them, if they are more than most. */
  bool
  findReaching(const std::array<double, 3>& low,
               const std::array<double, 3>& high,
               double factor,
               std::size_t most,
               std::vector<std::uint32_t>& buckets) const;

  /** \brief Samples so far whose fits are of lower degree. */
  std::uint64_t
  countReduced() const;

private:
  /** Buckets below a node of the tree, and the largest reach among them. */
  struct Node {
    KdBox box;
    double reach;
    std::uint32_t bucket;      ///< of a leaf
    std::uint32_t left, right; ///< 0: a leaf
  };

  std::uint32_t
  addNode(const KdNode& node);

  double
  boundReach(const Bucket& bucket) const;

  const SampledFields& sampled_;
  std::vector<Bucket> buckets_;
  std::vector<Node> nodes_;
  mutable std::vector<std::unique_ptr<const BucketFits>> fits_;
  mutable std::vector<std::once_flag> once_;
};

} // namespace pcl_uvol::detail
