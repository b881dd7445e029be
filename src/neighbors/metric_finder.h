// SPDX-License-Identifier: BSD-3-Clause
// The k nearest samples of a point in a metric of its own: distances are those of a
// linear image of the space.
#pragma once

#include "neighbors/sample_set.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Nearest samples of one point after another; one object per thread.
 *
 * Depth first through the tree, whatever the metric: some microseconds per point, where
 * NearestFinder shares its work among close points. */
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
  using Corner = std::array<double, 3>;

  void
  descend(const KdTree& tree, const KdNode& node, Corner& low, Corner& high);

  /** Whether no point of a box, the faces of which along an axis are new, can be one of
   * the nearest. */
  bool
  isTooFar(std::size_t axis, const Corner& low, const Corner& high) const;

  void
  consider(std::uint32_t sample);

  const SampleSet& samples_;
  std::size_t k_;
  Position point_{};
  Eigen::Matrix3d metric_;
  Eigen::Vector3d sq_extent_; ///< per axis, of the ball of radius 1 in the metric
  double reach_ = 0.0;
  std::vector<std::pair<double, std::uint32_t>> nearest_; ///< a heap
  std::vector<std::uint32_t> found_;
};

} // namespace pcl_uvol
