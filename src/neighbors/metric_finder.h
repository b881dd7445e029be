// SPDX-License-Identifier: BSD-3-Clause
// The k nearest samples of a point in a metric of its own: distances are those of a
// linear image of the space.
#pragma once

#include "neighbors/sample_set.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Nearest samples of one point after another; one object per thread.
 *
 * Depth first through the boxes of the tree, whatever the metric, the nearer half
 * first: a microsecond or two per point, where NearestFinder shares its work among
 * close points. */
class MetricFinder {
public:
  /** \param samples must outlive the finder
   * \param k >= 1 */
  MetricFinder(const SampleSet& samples, std::size_t k)
      : samples_(samples)
      , k_(k)
  {
  }

  /** \brief The k nearest by the length of metric * (x - point), all samples where
   * there are no more; of equally far ones those of lower index. In leaf order. Valid
   * until the next call.
   * \param metric regular */
  const std::vector<std::uint32_t>&
  find(const Position& point, const Eigen::Matrix3d& metric);

  /** \brief The result depends on no sample farther than this, as distances are in
   * space. */
  double
  getReach() const
  {
    return reach_;
  }

private:
  /** \return a squared distance in the metric that no sample in a box is nearer than */
  double
  sqBound(const KdBox& box) const;

  /** Whether a node has to be looked at. */
  bool
  mayHold(double sq_bound) const;

  void
  descend(const KdTree& tree, const KdNode& node);

  void
  measureBucket(const KdNode& bucket);

  const SampleSet& samples_;
  std::size_t k_;
  Position point_{};
  Eigen::Matrix3d metric_;
  Eigen::Matrix3d bounds_;    ///< the same metric, with rows at right angles
  Eigen::Vector3d sq_extent_; ///< per axis, of the ball of radius 1 in the metric
  double reach_ = 0.0;
  /** Squared distances and samples; more than k only while a bucket is looked at. */
  std::vector<std::pair<double, std::uint32_t>> nearest_;
  double sq_farthest_ = 0.0; ///< of these; infinite while there are fewer than k
  std::vector<std::uint32_t> found_;
};

} // namespace pcl_uvol
