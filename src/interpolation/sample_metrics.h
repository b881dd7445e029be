// SPDX-License-Identifier: BSD-3-Clause
// The local metrics of all samples of a set, where the sampling is stretched.
#pragma once

#include "neighbors/sample_set.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Makes spacings equal along all directions by stretching the shorter ones: no
 * length in the metric is shorter than in space, so that a ball in the metric lies in
 * the ball of the same radius in space. */
struct StretchedMetric {
  Eigen::Matrix3d matrix; ///< from offsets in space to offsets in the metric
  double ratio; ///< of the longest to the shortest spacing: largest stretching
};

/** \brief An offset between samples, in the metric of one of them; null: in space. */
inline Eigen::Vector3d
offsetIn(const StretchedMetric* metric, const Position& from, const Position& to)
{
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis)
    offset[axis] = static_cast<double>(to[axis]) - static_cast<double>(from[axis]);
  return metric ? Eigen::Vector3d(metric->matrix * offset) : offset;
}

/** \brief Metrics of groups of neighbouring samples, see LocalMetricFinder. Memory: 4
 * bytes per sample, and 80 per stretched group of some 10 samples; none where hardly
 * any sample of a few out of all parts is stretched. */
class SampleMetrics {
public:
  /** \brief Spacings that differ by less may be those of random samples: they are no
   * reason to leave the metric of space. */
  static constexpr double least_ratio = 2.0;

  /** \param samples must outlive the metrics */
  SampleMetrics(const SampleSet& samples, unsigned threads);

  /** \brief The metric around a sample; null where spacings are alike. */
  const StretchedMetric*
  find(std::uint32_t sample) const
  {
    return metric_of_.empty() || metric_of_[sample] == even
               ? nullptr
               : &metrics_[metric_of_[sample]];
  }

private:
  static constexpr std::uint32_t even = 0xffffffffu;

  std::vector<std::uint32_t> metric_of_; ///< [sample]; empty: all are even
  std::vector<StretchedMetric> metrics_;
};

} // namespace pcl_uvol::detail
