// SPDX-License-Identifier: BSD-3-Clause
// The k nearest samples of a point in a metric of its own: distances are those of a
// linear image of the space.
#pragma once

#include "neighbors/ball.h"
#include "neighbors/metric_kernel.h"
#include "neighbors/sample_set.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Nearest samples of one point after another; one object per thread.
 *
 * Depth first through the boxes of the tree, whatever the metric, the nearer half
 * first. Points close to one another that share a metric share a copy of the samples
 * around them as well. The answer depends on the point and the metric alone. */
class MetricFinder {
public:
  /** \param samples must outlive the finder
   * \param k >= 1
   * \param shares whether points that share a metric follow one another */
  MetricFinder(const SampleSet& samples, std::size_t k, bool shares = false);

  /** \brief The k nearest by the length of metric * (x - point), all samples where
   * there are no more; of equally far ones those of lower index. In leaf order. Valid
   * until the next call.
   * \param metric regular
   * \param sq_limit a squared distance in the metric within which there are k samples:
   * the search is faster with it, and what it finds within may be kept for points that
   * are looked up next */
  const std::vector<std::uint32_t>&
  find(const Position& point,
       const Eigen::Matrix3d& metric,
       double sq_limit = std::numeric_limits<double>::infinity());

  /** \brief Whether no sample lies within a distance of a point, as distances are in
   * the metric: a cheaper question than which are nearest. Rounding may make it say
   * that one does. */
  bool
  isEmpty(const Position& point, const Eigen::Matrix3d& metric, double distance);

  /** \brief Where the last call looked: its result depends on no sample outside. */
  Ball
  getSearched() const;

private:
  /** A squared distance in the metric from a point, and a sample there. */
  using Candidate = std::pair<double, std::uint32_t>;

  void
  setMetric(const Eigen::Matrix3d& metric);

  /** For both halves of a node, a squared distance in the metric that no sample of
   * theirs is nearer than. */
  void
  findBounds(const KdBox& left, const KdBox& right, double (&sq_bounds)[2]) const;

  /** Whether a node has to be looked at. */
  bool
  mayHold(double sq_bound) const;

  /** Look at the trees until a visit of a bucket ends it. */
  template <typename Visit>
  bool
  visitTrees(const Visit& visit);

  /** \return false if the visit ended it */
  template <typename Visit>
  bool
  descend(const KdTree& tree, const KdNode& node, const Visit& visit);

  /** Search from the trees on, and keep what lies within the limit. */
  void
  search(double sq_limit);

  void
  measureBucket(const KdNode& bucket);

  /** Squared distances of consecutive positions from the point.
   * \return the least of them */
  double
  measure(const Position* positions, std::size_t count, double* sq_dists) const;

  /** Leave the k nearest of those found. */
  void
  keepNearest();

  /** Find the nearest among the copied samples.
   * \return false if others may be nearer */
  bool
  selectFromCopy();

  double
  distanceInMetric(const Position& a, const Position& b) const;

  const SampleSet& samples_;
  std::size_t k_;
  bool shares_;
  const MetricKernels* kernels_;
  Position point_{};
  Eigen::Matrix3d metric_;
  MetricRows rows_;     ///< of it
  MetricBounds bounds_; ///< of the same metric
  bool has_metric_ = false;
  double reach_ = 0.0;             ///< of the last call, in the metric
  std::vector<Candidate> nearest_; ///< more than k only on the way
  double sq_farthest_ = 0.0;       ///< what others must not exceed
  std::vector<std::uint32_t> found_;

  bool has_copy_ = false;
  Position copy_center_{};
  double copy_radius_ = 0.0; ///< in the metric; all samples within are copied
  std::vector<std::uint32_t> copied_;
  std::vector<Position> copied_places_;
  std::vector<double> sq_dists_; ///< room for distances
};

} // namespace pcl_uvol
