// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/logarithmic_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Values that vary by less are as smooth as their logarithms, or nearly so. */
constexpr double steep_factor = 2.0;

/** Part of the error of the values' fit that the other has at most: of two errors that
 * noise made, the smaller one is the more wrong. */
constexpr double clearly_smaller = 0.8;

/** Standard errors off the isovalue that tell the side. */
constexpr double certain_side = 2.0;

/** Copy what a lane tells of the zero level. */
void
copyLane(const FitResult& from, std::size_t lane, FitResult& to)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    to.offset[axis][lane] = from.offset[axis][lane];
    to.gradient[axis][lane] = from.gradient[axis][lane];
  }
  for (std::size_t entry = 0; entry < 6; ++entry)
    to.hessian[entry][lane] = from.hessian[entry][lane];
  to.error[lane] = from.error[lane];
  to.bias[lane] = from.bias[lane];
  to.slope_error[lane] = from.slope_error[lane];
  to.residual[lane] = from.residual[lane];
  to.order[lane] = from.order[lane];
}

/** \param fit of the logarithms */
bool
isBetter(const FitResult& fit, const FitResult& of_values, std::size_t lane)
{
  return fit.order[lane] != fit_failed &&
         (of_values.order[lane] == fit_failed ||
          errorOfFit(fit, lane) < clearly_smaller * errorOfFit(of_values, lane));
}

double
signalToError(const FitResult& result, std::size_t lane)
{
  return std::abs(result.value[lane]) / result.value_error[lane];
}

} // namespace

LogarithmicFits::LogarithmicFits(FitKernel fit, float isovalue)
    : fit_(fit)
    , isovalue_(isovalue)
{
}

bool
LogarithmicFits::isSteep(const Surroundings& surroundings) const
{
  const ValueSpan& values = surroundings.values;
  const double a = values.lowest / isovalue_, b = values.highest / isovalue_;
  // Ends of a long edge need not be among the fitted samples.
  return std::min({a, b, values.edge[0] / isovalue_, values.edge[1] / isovalue_}) >
             0.0 &&
         std::max(a, b) > steep_factor * std::min(a, b);
}

double
LogarithmicFits::takeLogarithm(double above_isovalue) const
{
  return isovalue_ * std::log1p(above_isovalue / isovalue_);
}

bool
LogarithmicFits::isMoreCertainOfSide(const FitResult& fit,
                                     const FitResult& of_values,
                                     const Surroundings& surroundings,
                                     std::size_t lane) const
{
  const bool has_fallen =
      fit.value[lane] / isovalue_ < 0.0 || of_values.value[lane] / isovalue_ < 0.0;
  const double sure = signalToError(fit, lane);
  return has_fallen &&
         (fit.order[lane] == fit_failed ||
          surroundings.support != IsoSupport::Measured) &&
         sure > std::max(signalToError(of_values, lane), certain_side);
}

void
LogarithmicFits::takeValue(const FitResult& fit,
                           std::size_t lane,
                           FitResult& result) const
{
  const double value = isovalue_ * std::exp(fit.value[lane] / isovalue_);
  result.value[lane] = std::abs(value) <= std::numeric_limits<float>::max()
                           ? fit.value[lane]
                           : std::numeric_limits<double>::infinity();
  result.value_error[lane] = fit.value_error[lane];
}

void
LogarithmicFits::accept(const FitResult& fit,
                        std::size_t lane,
                        Surroundings& surroundings,
                        std::vector<FitSample>& samples,
                        FitResult& result) const
{
  copyLane(fit, lane, result);
  takeValue(fit, lane, result);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i].value[lane] = logarithms_[i].value[lane];
  ValueSpan& values = surroundings.values;
  for (double* const value :
       {&values.lowest, &values.highest, &values.edge[0], &values.edge[1]})
    *value = takeLogarithm(*value - isovalue_);
}

void
LogarithmicFits::improve(const int* weighted,
                         Surroundings* surroundings,
                         std::vector<FitSample>& samples,
                         FitResult& result)
{
  bool is_steep[fit_lanes];
  for (std::size_t lane = 0; lane < fit_lanes; ++lane)
    is_steep[lane] = weighted[lane] > 0 && !surroundings[lane].has_steps &&
                     isSteep(surroundings[lane]);
  if (std::none_of(is_steep, is_steep + fit_lanes, [](bool is) { return is; }))
    return;
  logarithms_ = samples;
  for (FitSample& sample : logarithms_)
    for (std::size_t lane = 0; lane < fit_lanes; ++lane)
      if (is_steep[lane])
        sample.value[lane] = static_cast<float>(takeLogarithm(sample.value[lane]));
  FitResult fit;
  fit_(logarithms_.data(), logarithms_.size(), weighted, fit);
  for (std::size_t lane = 0; lane < fit_lanes; ++lane)
    if (is_steep[lane] && isBetter(fit, result, lane))
      accept(fit, lane, surroundings[lane], samples, result);
    else if (is_steep[lane] &&
             isMoreCertainOfSide(fit, result, surroundings[lane], lane))
      takeValue(fit, lane, result);
}

} // namespace pcl_uvol
