// SPDX-License-Identifier: BSD-3-Clause
// Local polynomials as a partition of unity (Renka 1988, Algorithm 661, whose
// polynomials are quadratic): the mean of the fits around near samples, with weights
// that end smoothly.
#pragma once

#include "interpolation/field_model.h"
#include "interpolation/kriging_model.h"
#include "interpolation/sample_fits.h"

#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The blend of the fits of all samples whose ball holds the query, weighted by
 * (1 - d^2 / r^2)^2, r the radius of the ball: continuously differentiable, and what
 * all fits reproduce it reproduces.
 *
 * Where these weights fade, as between clusters of different density, those of larger
 * balls fade in. Beyond these the nearest fit is continued along a straight line. The
 * standard error combines those of the fits and the spread of their values.
 *
 * Kriging answers instead where that error is too large, and where a value is farther
 * from those of the samples around it than its error and half of their range: between
 * lines and layers of samples, where that may be a small part of what values differ by
 * over a ball. */
class BlendedFits : public FieldModel {
public:
  /** \param frames,names of the fields, see KrigingModel */
  BlendedFits(const SampledFields& sampled,
              const std::vector<ValueFrame>& frames,
              const std::vector<std::string>& names,
              unsigned threads);

  void
  evaluate(const Query* queries,
           std::size_t count,
           const Estimates& estimates) const override;

  void
  addTo(Report& report) const override;

private:
  const SampledFields& sampled_;
  std::vector<Position> sparse_;
  SampleFits fits_;
  KrigingModel kriging_;
};

} // namespace pcl_uvol::detail
