// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of sampled fields at consecutive samples: eight fits at a time by the
// vector kernel, others in the metric of a stretched sampling.
#pragma once

#include "derivatives/polynomial_kernel.h"
#include "interpolation/field_model.h"
#include "interpolation/sample_derivatives.h"
#include "neighbors/local_metric.h"
#include "neighbors/metric_finder.h"
#include "neighbors/nearest_finder.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Derivatives at consecutive samples, in the space of the samples and in the
 * frames of the fields. */
struct BlockDerivatives {
  std::vector<PointDerivatives> derivatives; ///< [sample][field]; NaN where the samples
                                             ///< do not determine them
  std::uint64_t reduced =
      0; ///< samples in sheets or on lines: derivatives across are 0
  std::uint64_t unknown = 0; ///< samples with a field without derivatives
};

/** \brief Fits of samples; one object per thread. */
class DerivativeFitter {
public:
  /** \param sampled must outlive the fitter */
  explicit DerivativeFitter(const SampledFields& sampled);

  BlockDerivatives
  fit(std::uint32_t begin, std::uint32_t count);

private:
  /** A sample whose fit a stretched sampling may have spoilt. */
  struct UncertainFit {
    std::uint32_t sample;
    double pivot; ///< of its fit
    /** Its cubic is close to the values, or well determined and bounded by them. */
    bool is_kept_if_even;
  };

  /** How samples lie around one of them. */
  enum class Spacings {
    Even,      ///< as far apart in all directions
    Stretched, ///< even in the metric of metrics_
    Sheet,     ///< on a sheet or a line, or in few layers
    Unclear
  };

  void
  fitLanes(std::uint32_t begin,
           std::size_t first,
           std::size_t lanes,
           BlockDerivatives& found);

  void
  clear(std::size_t lane, std::size_t from);

  void
  gather(std::uint32_t sample, std::size_t lane);

  /** Whether the fits of a lane are close to the values, and as steep as these allow.
   * \param most_error standard error over the largest difference of values */
  bool
  followsValues(std::size_t lane, double most_error) const;

  Spacings
  findSpacings(const UncertainFit& doubt);

  /** \param derivatives of the sample's fields */
  void
  fitAnew(const UncertainFit& doubt,
          PointDerivatives* derivatives,
          BlockDerivatives& found);

  struct alignas(64) LaneValues {
    double value[polynomial_lanes];
  };

  const SampledFields& sampled_;
  NearestFinder finder_;
  MetricFinder finder_in_metric_;
  LocalMetricFinder metrics_, group_metrics_;
  PolynomialKernel kernel_;
  std::vector<PolynomialSample> samples_; ///< [neighbour]
  std::vector<LaneValues> values_;        ///< [field][neighbour]
  std::vector<PolynomialFit> results_;
  std::vector<double> sq_dists_;
  std::vector<UncertainFit> uncertain_fits_;
  int weighted_[polynomial_lanes] = {};
  double radius_[polynomial_lanes] = {};
  float length_ = 1.0f; ///< of the search before
};

} // namespace pcl_uvol::detail
