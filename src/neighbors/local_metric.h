// SPDX-License-Identifier: BSD-3-Clause
// How far apart samples lie around a point, direction by direction: slices, stretched
// cells and layers at a wall are as dense as a cubic lattice in a metric of their own.
#pragma once

#include "metric_finder.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Second moment of the lines from samples to their natural neighbours, the mean
 * over the samples in the middle of some: its eigenvectors are the directions, the
 * roots of its eigenvalues the spacings.
 *
 * Natural neighbours as the angle criterion has them (thesis 2.3), but lines, without a
 * head: an axis counts by the nearer of its two sides, so that neither the border of a
 * gap nor that of the cloud looks like a stretched sampling.
 * \param offsets of samples, from the point \param central how many of the first ones
 * are in the middle; two at least */
Eigen::Matrix3d
momentOfLines(const std::vector<Eigen::Vector3d>& offsets, std::size_t central);

/** \brief Local metrics of one point after another; one object per thread. */
class LocalMetricFinder {
public:
  enum class Outcome {
    Even,      ///< the spacings hardly differ
    Stretched, ///< they differ, and a metric was found in which they do not
    None       ///< no metric shows samples on all sides, as on a plane or a line
  };

  /** \param samples must outlive the finder \param k neighbours that a metric is made
   * from */
  LocalMetricFinder(const SampleSet& samples, std::size_t k)
      : finder_(samples, k)
      , samples_(samples)
  {
  }

  /** \brief Between the longest and the shortest spacing: a metric is as good as
   * another one up to here. Of uniform random samples, whose spacings scatter, nine in
   * ten estimates stay below. */
  static constexpr double even_ratio = 1.5;

  /** \brief Find the metric at a point. \param nearest the k nearest samples there
   * \param most_even a ratio below it is Even */
  Outcome
  find(const Position& point,
       const std::uint32_t* nearest,
       std::size_t count,
       double most_even = even_ratio);

  /** \brief Of the last point: x -> metric * x makes spacings equal. Symmetric, and 1
   * where samples lie densest. */
  const Eigen::Matrix3d&
  getMetric() const
  {
    return metric_;
  }

  /** \brief The moment of lines that it was made from, in squared lengths. */
  const Eigen::Matrix3d&
  getMoment() const
  {
    return moment_;
  }

  /** \brief Of the longest and the shortest spacing. */
  double
  getRatio() const
  {
    return ratio_;
  }

  /** \brief The k nearest in that metric, in leaf order. */
  const std::vector<std::uint32_t>&
  getNearest() const
  {
    return nearest_;
  }

  /** \brief The result depends on no sample outside of this ball. */
  double
  getReach() const
  {
    return reach_;
  }

private:
  /** Offsets of the nearest, by distance in the metric. */
  void
  sortOffsets(const Position& point);

  /** Lengthen the reach across samples that lie on a surface or a line. */
  bool
  stretchAcross();

  MetricFinder finder_;
  const SampleSet& samples_;
  Eigen::Matrix3d metric_, moment_;
  std::vector<std::uint32_t> nearest_;
  std::vector<Eigen::Vector3d> offsets_;
  std::vector<std::pair<double, std::uint32_t>> order_;
  double reach_ = 0.0, ratio_ = 1.0;
};

} // namespace pcl_uvol
