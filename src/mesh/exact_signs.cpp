// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/exact_signs.h"

#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_uvol::detail {

namespace {

using Whole = boost::multiprecision::cpp_int;

/** Half of the distance from 1 to the next double. */
constexpr double rounding = std::numeric_limits<double>::epsilon() / 2.0;

/** Share of the sum of the magnitudes of all products (Shewchuk 1997). @{ */
constexpr double volume_rounding = (7.0 + 56.0 * rounding) * rounding,
                 area_rounding = (3.0 + 16.0 * rounding) * rounding;
/** @} */

/** Numbers as whole multiples of a power of two that they have in common. */
std::vector<Whole>
toWhole(const std::vector<double>& numbers)
{
  constexpr int digits = std::numeric_limits<double>::digits;
  std::vector<int> exponents(numbers.size());
  int lowest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::frexp(numbers[i], &exponents[i]);
    if (numbers[i] != 0.0)
      lowest = std::min(lowest, exponents[i]);
  }
  std::vector<Whole> whole;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    int exponent = 0;
    const double mantissa = std::frexp(numbers[i], &exponent);
    whole.emplace_back(static_cast<std::int64_t>(std::ldexp(mantissa, digits)));
    if (numbers[i] != 0.0)
      whole.back() <<= exponents[i] - lowest;
  }
  return whole;
}

int
signOf(const Whole& number)
{
  return number.sign();
}

/** As signOfVolume(), and signOfArea() without its axis, in whole numbers. @{ */
int
exactSignOfVolume(const Eigen::Vector3d& a,
                  const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c,
                  const Eigen::Vector3d& d)
{
  std::vector<double> numbers;
  for (const Eigen::Vector3d* const place : {&a, &b, &c, &d})
    numbers.insert(numbers.end(), place->data(), place->data() + 3);
  std::vector<Whole> x = toWhole(numbers);
  for (std::size_t i = 0; i < 9; ++i)
    x[i] -= x[9 + i % 3];
  return -signOf(x[0] * (x[4] * x[8] - x[5] * x[7]) +
                 x[1] * (x[5] * x[6] - x[3] * x[8]) +
                 x[2] * (x[3] * x[7] - x[4] * x[6]));
}

int
exactSignOfArea(const std::array<double, 6>& xy)
{
  const std::vector<Whole> x = toWhole({xy.begin(), xy.end()});
  return signOf((x[0] - x[4]) * (x[3] - x[5]) - (x[1] - x[5]) * (x[2] - x[4]));
}
/** @} */

} // namespace

int
signOfVolume(const Eigen::Vector3d& a,
             const Eigen::Vector3d& b,
             const Eigen::Vector3d& c,
             const Eigen::Vector3d& d)
{
  const Eigen::Vector3d u = a - d, v = b - d, w = c - d;
  const double volume = u.dot(v.cross(w));
  const Eigen::Vector3d sums(std::abs(v[1] * w[2]) + std::abs(v[2] * w[1]),
                             std::abs(v[2] * w[0]) + std::abs(v[0] * w[2]),
                             std::abs(v[0] * w[1]) + std::abs(v[1] * w[0]));
  const double doubt = volume_rounding * u.cwiseAbs().dot(sums);
  if (volume > doubt)
    return -1;
  if (volume < -doubt)
    return 1;
  return exactSignOfVolume(a, b, c, d);
}

int
signOfArea(const Eigen::Vector3d& a,
           const Eigen::Vector3d& b,
           const Eigen::Vector3d& c,
           int dropped_axis)
{
  const int x = (dropped_axis + 1) % 3, y = (dropped_axis + 2) % 3;
  const double left = (a[x] - c[x]) * (b[y] - c[y]),
               right = (a[y] - c[y]) * (b[x] - c[x]);
  const double doubt = area_rounding * (std::abs(left) + std::abs(right));
  if (left - right > doubt)
    return 1;
  if (left - right < -doubt)
    return -1;
  return exactSignOfArea({a[x], a[y], b[x], b[y], c[x], c[y]});
}

int
findVisibleAxis(const Eigen::Vector3d& a,
                const Eigen::Vector3d& b,
                const Eigen::Vector3d& c)
{
  // The sign of an area of zero takes whole numbers: the largest area comes first.
  int largest = 0;
  (b - a).cross(c - a).cwiseAbs().maxCoeff(&largest);
  for (int i = 0; i < 3; ++i)
    if (const int axis = (largest + i) % 3; signOfArea(a, b, c, axis) != 0)
      return axis;
  return -1;
}

} // namespace pcl_uvol::detail
