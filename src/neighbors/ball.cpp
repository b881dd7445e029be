// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/ball.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pcl_uvol {

namespace {

/** The length of a vector after a linear map. */
double
measure(const Ball::Metric& metric, const std::array<double, 3>& offset)
{
  double sq_length = 0.0;
  for (const auto& row : metric) {
    const double image = row[0] * offset[0] + row[1] * offset[1] + row[2] * offset[2];
    sq_length += image * image;
  }
  return std::sqrt(sq_length);
}

} // namespace

double
Ball::getReach() const
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto& row : metric)
    least = std::min(least, std::hypot(row[0], row[1], row[2]));
  return static_cast<double>(radius) / least;
}

bool
Ball::isConcentric(const Ball& other) const
{
  return std::equal(center.x, center.x + 3, other.center.x) && metric == other.metric;
}

bool
Ball::contains(const Ball& other) const
{
  std::array<double, 3> offset;
  for (std::size_t axis = 0; axis < 3; ++axis)
    offset[axis] =
        static_cast<double>(other.center.x[axis]) - static_cast<double>(center.x[axis]);
  if (metric != other.metric && metric != Ball{}.metric)
    return false;
  const double reach =
      metric == other.metric ? static_cast<double>(other.radius) : other.getReach();
  return measure(metric, offset) + reach <= static_cast<double>(radius);
}

} // namespace pcl_uvol
