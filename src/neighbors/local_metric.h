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
  Eigen::Matrix3d lengths, directions;

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
  explicit LocalMetricFinder(const SampleSet& samples);

  /** \brief Samples of a small node of the tree, at most: they have metrics that differ
   * little, or none. A piece of a larger set has the nodes of the whole if it has more
   * samples. */
  static constexpr std::uint32_t group_samples = 16;

  /** \brief The sample that stands for all of its node. */
  std::uint32_t
  findAnchor(std::uint32_t sample) const;

  /** \brief Find the metric around a sample.
   * \return false, and no metric, if spacings differ by less than a ratio, or if no
   * metric shows samples on all sides, as on a plane or a line */
  bool
  find(std::uint32_t sample, double least_ratio = even_ratio);

  /** \brief Find the metric around a sample from one that is nearly right.
   * \param nearby what was found around another sample nearby
   * \return false if there is none, or if spacings differ by less than the ratio */
  bool
  refine(std::uint32_t sample, const LocalMetricFinder& nearby, double least_ratio);

  /** \brief Whether a search around the last sample has found no metric, however much
   * spacings differ, or was of no use, as on a plane along axes. */
  bool
  hasFailed() const
  {
    return is_flat_ || (known_ == Known::Searched && !has_metric_);
  }

  /** \brief Whether spacings around the last sample are known, and differ by less than
   * a ratio. */
  bool
  isEven(double ratio) const
  {
    return known_ == Known::Refined ? has_metric_ && ratio_ < ratio
                                    : is_seen_ && first_ratio_ < ratio;
  }

  /** \brief The metric at the last sample: x -> metric * x makes spacings equal. 1
   * where samples lie densest. */
  const Eigen::Matrix3d&
  getMetric() const
  {
    return metric_;
  }

  /** \brief Whether a point lies near the last sample, beside those that its metric was
   * made from, as distances are in the metric: far out, across a gap, it says nothing.
   */
  bool
  reaches(const Position& point) const;

  /** \brief A distance in the metric from a point within which at least
   * getPoolSize() samples lie. */
  double
  findPoolRadius(const Position& point) const;

  std::size_t
  getPoolSize() const
  {
    return nearest_.size();
  }

  /** \brief Its eigenvectors are the directions, its eigenvalues the squared spacings
   * along them. Undefined where the ratio is infinite. */
  const Eigen::Matrix3d&
  getSpacings() const
  {
    return spacings_;
  }

  /** \brief The ratio of the longest and the shortest spacing; infinite where no metric
   * shows samples on all sides. */
  double
  getRatio() const
  {
    return ratio_;
  }

  /** \brief Where was looked for it, one after the other: what lies in one decides
   * where the next one is. The result depends on no sample outside of all; that of
   * refine() on those of the metric nearby, too. */
  const std::vector<Ball>&
  getSearched() const
  {
    return searched_;
  }

private:
  /** Samples that a metric is made from: those in the middle have their neighbours
   * among them. */
  static constexpr std::size_t pool = 41;

  /** Look at the nearest samples of one, which makes a first estimate.
   * \return whether there are samples on all sides of it */
  bool
  lookAround(std::uint32_t sample);

  /** Find the metric from there on.
   * \return false if there is none */
  bool
  search(std::uint32_t sample);

  /** Squared distance in the metric to the farthest of the samples looked at last: as
   * many are within it. */
  double
  sqFarthest() const;

  /** One look in the metric, at samples within a squared distance in it, which corrects
   * it.
   * \return the ratio of the longest to the shortest spacing in the metric before;
   * infinite where samples are not on all sides */
  double
  lookInMetric(std::uint32_t sample, double sq_limit, bool may_stretch);

  /** Let the metric look farther across a single layer.
   * \return false if the samples looked at are more than that */
  bool
  stretchAcrossLayer();

  /** Whether samples lie in three layers at least along the axis of the longest
   * spacing: what is beyond a single gap are no layers. */
  bool
  hasLayers() const;

  /** From the lines between samples, the spacings and the metric that evens them out.
   * \return the ratio of the longest to the shortest spacing in the metric before;
   * infinity, and no metric but the identity, where the lines tell no spacings */
  double
  setMetric(const LineMoments& lines);

  /** Look at some samples, by distance in the metric, from one of them. */
  void
  gather(std::uint32_t sample, const std::uint32_t* neighbors, std::size_t count);

  /** Let the metric look farther where no line leads, as across layers.
   * \return false if lines lead everywhere */
  bool
  stretchAcross(const LineMoments& lines);

  const SampleSet& samples_;
  bool is_flat_; ///< in a plane or a line along axes: there is nothing beside it
  NearestFinder first_finder_;
  MetricFinder finder_;
  Eigen::Matrix3d metric_, spacings_;
  std::vector<std::pair<double, Eigen::Vector3d>> nearest_;
  std::vector<float> offsets_[3];
  std::vector<std::pair<double, std::uint32_t>> order_;
  std::vector<Ball> searched_;
  double ratio_ = 1.0, first_ratio_ = 1.0;
  double typical_reach_ = 1.0; ///< of the sample before: where a search starts

  /** What is known of the last sample: edges of a group follow one another. What one
   * way has found is nothing to the other, so that the answer does not depend on what
   * was asked for before. */
  enum class Known { Nothing, FirstLook, Searched, Refined };
  Known known_ = Known::Nothing;
  std::uint32_t last_ = 0;
  bool is_seen_ = false; ///< samples on all sides at the first look
  bool has_metric_ = false;
};

} // namespace pcl_uvol
