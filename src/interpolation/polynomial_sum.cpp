// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/polynomial_sum.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

struct ValueAndGradient {
  double value;
  std::array<double, 3> gradient;
};

/** A cubic, see PolynomialFit, by nested products. */
ValueAndGradient
evaluateCubic(const double* c, const std::array<double, 3>& u)
{
  const double x = u[0], y = u[1], z = u[2];
  const double xx = x * x, xy = x * y, xz = x * z, yy = y * y, yz = y * z, zz = z * z;
  ValueAndGradient at;
  at.value = c[0] +
             x * (c[1] + c[4] * x + c[5] * y + c[6] * z + c[10] * xx + c[11] * xy +
                  c[12] * xz + c[13] * yy + c[14] * yz + c[15] * zz) +
             y * (c[2] + c[7] * y + c[8] * z + c[16] * yy + c[17] * yz + c[18] * zz) +
             z * (c[3] + c[9] * z + c[19] * zz);
  at.gradient = {c[1] + 2.0 * (c[4] * x + c[11] * xy + c[12] * xz) + c[5] * y +
                     c[6] * z + 3.0 * c[10] * xx + c[13] * yy + c[14] * yz + c[15] * zz,
                 c[2] + c[5] * x + 2.0 * (c[7] * y + c[13] * xy + c[17] * yz) +
                     c[8] * z + c[11] * xx + c[14] * xz + 3.0 * c[16] * yy + c[18] * zz,
                 c[3] + c[6] * x + c[8] * y +
                     2.0 * (c[9] * z + c[15] * xz + c[18] * yz) + c[12] * xx +
                     c[14] * xy + c[17] * yy + 3.0 * c[19] * zz};
  return at;
}

} // namespace

PolynomialSum::PolynomialSum(std::size_t fields)
    : sums_(fields)
{
}

void
PolynomialSum::clear()
{
  weight_ = 0.0;
  weight_gradient_ = {};
  is_empty_ = true;
  std::fill(sums_.begin(), sums_.end(), Sums{});
}

void
PolynomialSum::add(const Part& part)
{
  for (std::size_t f = 0; f < sums_.size(); ++f) {
    const auto at =
        evaluateCubic(part.polynomial.coefficients + f * polynomial_terms, part.offset);
    addValues(f, part, at.value, at.gradient);
  }
  weight_ += part.weight;
  for (std::size_t axis = 0; axis < 3; ++axis)
    weight_gradient_[axis] += part.weight_gradient[axis];
  is_empty_ = false;
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
  for (std::size_t f = 0; f < sums_.size(); ++f) {
    const auto at =
        evaluateCubic(part.polynomial.coefficients + f * polynomial_terms, end);
    double value = at.value;
    for (std::size_t axis = 0; axis < 3; ++axis)
      value += at.gradient[axis] * (part.offset[axis] - end[axis]);
    addValues(f, part, value, at.gradient);
  }
  weight_ += part.weight;
  is_empty_ = false;
}

void
PolynomialSum::addValues(std::size_t field,
                         const Part& part,
                         double value,
                         const std::array<double, 3>& gradient)
{
  Sums& sums = sums_[field];
  if (is_empty_)
    sums.reference = value;
  const double relative = value - sums.reference;
  const double error = part.polynomial.errors[field];
  sums.value += part.weight * relative;
  sums.square += part.weight * relative * relative;
  sums.sq_error += part.weight * error * error;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sums.gradient[axis] += part.weight * gradient[axis] / part.polynomial.radius +
                           part.weight_gradient[axis] * relative;
}

void
PolynomialSum::finish(std::size_t query, const Estimates& estimates) const
{
  for (std::size_t f = 0; f < sums_.size(); ++f) {
    const Sums& sums = sums_[f];
    const std::size_t place = query * sums_.size() + f;
    const double mean = sums.value / weight_;
    estimates.values[place] = sums.reference + mean;
    if (estimates.errors)
      estimates.errors[place] = std::sqrt(
          sums.sq_error / weight_ + std::max(0.0, sums.square / weight_ - mean * mean));
    if (estimates.gradients)
      for (std::size_t axis = 0; axis < 3; ++axis)
        estimates.gradients[3 * place + axis] =
            (sums.gradient[axis] - mean * weight_gradient_[axis]) / weight_;
  }
}

} // namespace pcl_uvol::detail
