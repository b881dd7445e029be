// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/polynomial_sum.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

PolynomialSum::PolynomialSum(std::size_t fields,
                             bool gradients,
                             const BlendKernels& kernels)
    : kernels_(kernels)
    , fields_(fields)
    , values_(fields)
    , gradients_(3 * fields)
    , references_(fields)
    , value_sums_(fields)
    , square_sums_(fields)
    , sq_error_sums_(fields)
    , gradient_sums_(gradients ? 3 * fields : 0)
{
}

void
PolynomialSum::clear()
{
  weight_ = 0.0;
  weight_gradient_ = {};
  is_empty_ = true;
  for (auto* const sums :
       {&value_sums_, &square_sums_, &sq_error_sums_, &gradient_sums_})
    std::fill(sums->begin(), sums->end(), 0.0);
}

void
PolynomialSum::add(const Part& part)
{
  kernels_.evaluateCubics(part.polynomial.coefficients,
                          fields_,
                          part.offset.data(),
                          values_.data(),
                          gradient_sums_.empty() ? nullptr : gradients_.data());
  leaveMetric(part);
  addValues(part);
  for (std::size_t axis = 0; axis < 3; ++axis)
    weight_gradient_[axis] += part.weight_gradient[axis];
}

void
PolynomialSum::addStraight(const Part& part, double farthest)
{
  const double distance = std::hypot(part.offset[0], part.offset[1], part.offset[2]);
  if (distance <= farthest) {
    add(part);
    return;
  }
  std::array<double, 3> end = part.offset;
  for (double& along : end)
    along *= farthest / distance;
  kernels_.evaluateCubics(part.polynomial.coefficients,
                          fields_,
                          end.data(),
                          values_.data(),
                          gradients_.data());
  for (std::size_t f = 0; f < fields_; ++f)
    for (std::size_t axis = 0; axis < 3; ++axis)
      values_[f] += gradients_[3 * f + axis] * (part.offset[axis] - end[axis]);
  leaveMetric(part);
  addValues(part);
}

void
PolynomialSum::leaveMetric(const Part& part)
{
  if (!part.polynomial.metric || gradient_sums_.empty())
    return;
  for (std::size_t f = 0; f < fields_; ++f) {
    Eigen::Map<Eigen::Vector3d> gradient(&gradients_[3 * f]);
    gradient = (part.polynomial.metric->matrix.transpose() * gradient).eval();
  }
}

void
PolynomialSum::addValues(const Part& part)
{
  if (is_empty_)
    references_ = values_;
  is_empty_ = false;
  weight_ += part.weight;
  for (std::size_t f = 0; f < fields_; ++f) {
    const double relative = values_[f] - references_[f];
    const double error = part.polynomial.errors[f];
    value_sums_[f] += part.weight * relative;
    square_sums_[f] += part.weight * relative * relative;
    sq_error_sums_[f] += part.weight * error * error;
  }
  if (gradient_sums_.empty())
    return;
  const double per_radius = part.weight / part.polynomial.radius;
  for (std::size_t f = 0; f < fields_; ++f) {
    const double relative = values_[f] - references_[f];
    for (std::size_t axis = 0; axis < 3; ++axis)
      gradient_sums_[3 * f + axis] +=
          per_radius * gradients_[3 * f + axis] + part.weight_gradient[axis] * relative;
  }
}

double
PolynomialSum::computeError(std::size_t field) const
{
  const double mean = value_sums_[field] / weight_;
  return std::sqrt(sq_error_sums_[field] / weight_ +
                   std::max(0.0, square_sums_[field] / weight_ - mean * mean));
}

void
PolynomialSum::finish(std::size_t query, const Estimates& estimates) const
{
  for (std::size_t f = 0; f < fields_; ++f) {
    const std::size_t place = query * fields_ + f;
    const double mean = value_sums_[f] / weight_;
    estimates.values[place] = references_[f] + mean;
    if (estimates.errors)
      estimates.errors[place] = computeError(f);
    if (!gradient_sums_.empty())
      for (std::size_t axis = 0; axis < 3; ++axis)
        estimates.gradients[3 * place + axis] =
            (gradient_sums_[3 * f + axis] - mean * weight_gradient_[axis]) / weight_;
  }
}

} // namespace pcl_uvol::detail
