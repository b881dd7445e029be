// SPDX-License-Identifier: BSD-3-Clause
// How far apart samples lie around a point, direction by direction: slices, stretched
// cells and layers at a wall are as dense as a cubic lattice in a metric of their own.
#pragma once

#include "neighbors/metric_finder.h"
#include "neighbors/nearest_finder.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Lines from samples to their natural neighbours: the sums of their second
 * moments, and of those of their directions. Their quotient along a direction is the
 * squared spacing there.
 *
 * Natural neighbours as the angle criterion has them (thesis 2.3), but lines, without a
 * head: an axis counts by the nearer of its two sides, so that neither the border of a
 * gap nor that of the cloud looks like a stretched sampling. */
struct LineMoments {
  Eigen::Matrix3d lengths = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();

  /** \param offsets of samples, from anywhere: all x, all y, all z
   * \param central how many of the first ones lines start from; the others are there to
   * be found */
  LineMoments(const std::vector<float> (&offsets)[3], std::size_t central);
};

/** \brief Local metrics of one sample after another; one object per thread. */
class LocalMetricFinder {
public:
  /** \brief Between the longest and the shortest spacing: a metric is as good as
   * another one up to here. Of uniform random samples, whose spacings scatter, nine in
   * ten estimates stay below. */
  static constexpr double even_ratio = 1.5;

  /** \param samples must outlive the finder */
  explicit LocalMetricFinder(const SampleSet& samples)
      : samples_(samples)
      , first_finder_(samples, pool)
      , finder_(samples, pool)
  {
  }

  /** \brief Find the metric around a sample.
   * \return false, and no metric, if spacings differ by less than a ratio, or if no
   * metric shows samples on all sides, as on a plane or a line */
  bool
  find(std::uint32_t sample, double least_ratio = even_ratio);

  /** \brief Of the last sample: x -> metric * x makes spacings equal. 1 where samples
   * lie densest. */
  const Eigen::Matrix3d&
  getMetric() const
  {
    return metric_;
  }

  /** \brief Its eigenvectors are the directions, its eigenvalues the squared spacings
   * along them. Undefined where the ratio is infinite. */
  const Eigen::Matrix3d&
  getSpacings() const
  {
    return spacings_;
  }

  /** \brief Of the longest and the shortest spacing; infinite where no metric shows
   * samples on all sides. */
  double
  getRatio() const
  {
    return ratio_;
  }

  /** \brief The result depends on no sample farther from this one. */
  double
  getReach() const
  {
    return reach_;
  }

private:
  /** Samples that a metric is made from: those in the middle have their neighbours
   * among them. */
  static constexpr std::size_t pool = 41;

  bool
  search(std::uint32_t sample, double least_ratio);

  /** Look at some samples, by distance in the metric, from one of them. */
  void
  gather(std::uint32_t sample, const std::uint32_t* neighbors, std::size_t count);

  /** Let the metric look farther where no line leads, as across layers.
   * \return false if lines lead everywhere */
  bool
  stretchAcross(const LineMoments& lines);

  const SampleSet& samples_;
  NearestFinder first_finder_;
  MetricFinder finder_;
  Eigen::Matrix3d metric_, spacings_;
  std::vector<std::pair<double, Eigen::Vector3d>> nearest_;
  std::vector<float> offsets_[3];
  double reach_ = 0.0, ratio_ = 1.0;
  double typical_reach_ = 1.0; ///< of the sample before: where a search starts

  // Edges of a sample follow one another.
  bool has_last_ = false, last_found_ = false;
  std::uint32_t last_ = 0;
  double last_ratio_ = 0.0;
};

} // namespace pcl_uvol
