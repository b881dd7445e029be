// SPDX-License-Identifier: BSD-3-Clause
// Makes the polynomials of a bucket of samples: eight at a time by the vector kernel,
// by a rank-revealing factorisation where that fails.
#pragma once

#include "derivatives/polynomial_kernel.h"
#include "interpolation/field_model.h"
#include "interpolation/sample_fits.h"
#include "interpolation/sample_metrics.h"
#include "neighbors/empty_cone.h"
#include "neighbors/metric_finder.h"
#include "neighbors/nearest_finder.h"

#include <Eigen/Core>

#include <vector>

namespace pcl_uvol::detail {

/** \brief Fits of consecutive samples. */
class BucketFitter {
public:
  /** \brief Samples with a weight in a fit; the next farther one sets the radius of the
   * support. Twice the 20 terms of a cubic, as for isopoints. */
  static constexpr std::size_t fitted_samples = 40;

  /** \brief A fit has a weight where the sample would be among that many nearest ones.
   */
  static constexpr std::size_t blended_samples = 14;

  /** \param metrics that neighbours and fits are those of
   *
   * Polynomials that run away, steep along a direction in which samples lie on too few
   * layers for their degree, are fitted anew: of the degrees whose terms the samples
   * determine well the best is taken, a linear function at least. */
  BucketFitter(const SampledFields& sampled, const SampleMetrics& metrics);

  BucketFits
  fit(std::uint32_t begin, std::uint32_t count);

private:
  void
  fitLanes(std::uint32_t begin, std::size_t first, std::size_t lanes, BucketFits& fits);

  void
  gather(std::uint32_t sample, std::size_t lane, std::size_t place, BucketFits& fits);

  /** Find the neighbours of a sample, itself one of them, and their offsets, in its
   * metric. */
  void
  findNeighbors(std::uint32_t sample, const StretchedMetric* metric);

  void
  clear(std::size_t lane, std::size_t from);

  void
  fitReduced(std::uint32_t sample,
             std::size_t lane,
             std::size_t place,
             bool is_determined,
             BucketFits& fits) const;

  bool
  hasRunAway(std::size_t lane) const;

  bool
  isInner(std::size_t lane, std::size_t neighbors);

  struct alignas(64) LaneValues {
    double value[polynomial_lanes];
  };

  alignas(64) float directions_[3][64];
  const SampledFields& sampled_;
  const SampleMetrics& metrics_;
  NearestFinder finder_;
  MetricFinder stretched_finder_;
  EmptyCone cone_;
  PolynomialKernel kernel_;
  std::vector<PolynomialSample> samples_; ///< [neighbour]
  std::vector<LaneValues> values_;        ///< [field][neighbour]
  std::vector<PolynomialFit> results_;
  std::vector<std::uint32_t> near_;
  std::vector<Eigen::Vector3d> offsets_; ///< of these
  std::vector<double> sq_dists_;         ///< of these
  int weighted_[polynomial_lanes] = {};
  float length_ = 1.0f; ///< of the search before
};

} // namespace pcl_uvol::detail
