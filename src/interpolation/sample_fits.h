// SPDX-License-Identifier: BSD-3-Clause
// Polynomials around every sample, made bucket by bucket of the tree when they are
// first asked for, and kept.
#pragma once

#include "interpolation/ball_tree.h"
#include "interpolation/field_model.h"
#include "interpolation/sample_metrics.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The polynomials of a bucket of samples.
 *
 * Lengths are those of the metric of the sample, see SampleMetrics. Memory per sample:
 * 44 bytes and 168 per field. */
struct BucketFits {
  std::vector<double> radius;   ///< [sample] of the support of the fit: its unit
  std::vector<float> center[3]; ///< [sample] its coordinates; ball_padding more
  std::vector<double> sq_reach; ///< [sample] of the ball in which the fit has a weight;
                                ///< ball_padding more, which are 0
  double largest_sq_reach = 0.0;              ///< of these
  std::vector<const StretchedMetric*> metric; ///< [sample] null: that of space
  std::vector<bool> is_inner;                 ///< [sample] neighbours on all sides
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
  SampleFits(const SampleFits&) = delete;
  SampleFits&
  operator=(const SampleFits&) = delete;

  /** \brief The balls in which fits have a weight. */
  const BallTree&
  getBalls() const
  {
    return balls_;
  }

  const BucketFits&
  getFits(std::size_t bucket) const;

  /** \brief Samples so far whose fits are of lower degree. */
  std::uint64_t
  countReduced() const;

private:
  double
  boundByBox(const BallTree::Bucket& bucket) const;

  double
  boundReach(const BallTree::Bucket& bucket) const;

  const SampledFields& sampled_;
  SampleMetrics metrics_;
  BallTree balls_;
  mutable std::vector<std::unique_ptr<const BucketFits>> fits_;
  mutable std::vector<std::once_flag> once_;
};

} // namespace pcl_uvol::detail
