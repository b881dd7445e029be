// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/kriged_slopes.h"

#include <cstddef>

namespace pcl_uvol::detail {

namespace {

using Eigen::Array3d;

/** A place, and those to both sides along the axes. */
constexpr std::size_t star = 7;

/** A query of a star: the place itself, then the lower and the upper one of each axis.
 * \param steps along the axes of the original space */
std::array<double, 3>
placeInStar(std::array<double, 3> place, std::size_t query, const Array3d& steps)
{
  if (query == 0)
    return place;
  const std::size_t axis = (query - 1) / 2;
  const double sign = query % 2 == 1 ? -1.0 : 1.0;
  place[axis] += sign * steps[static_cast<Eigen::Index>(axis)];
  return place;
}

} // namespace

std::vector<KrigedSlope>
findKrigedSlopes(const FieldInterpolator& field,
                 const std::vector<std::array<double, 3>>& places,
                 double step,
                 const Array3d& scale,
                 unsigned threads,
                 const ProgressCallback& progress)
{
  Report own;
  own.progress = progress;
  const Array3d steps = step / scale;
  std::vector<KrigedSlope> slopes(places.size());
  const auto take = [&](std::size_t first, const InterpolatedFields& answers) {
    for (std::size_t i = 0; i < answers.size; ++i) {
      KrigedSlope& slope = slopes[(first + i) / star];
      const std::size_t query = (first + i) % star;
      const double value = answers.values[i];
      if (query == 0) {
        slope.value = value;
        slope.deviation = answers.errors[i];
      }
      else if (query % 2 == 1)
        slope.direction[static_cast<Eigen::Index>(query / 2)] = value;
      else {
        double& along = slope.direction[static_cast<Eigen::Index>(query / 2 - 1)];
        along = (value - along) / (2.0 * step);
      }
    }
  };
  field.interpolate(
      star * places.size(),
      [&](std::size_t i) { return placeInStar(places[i / star], i % star, steps); },
      threads,
      own,
      take);
  for (KrigedSlope& slope : slopes) {
    slope.length = slope.direction.matrix().norm();
    slope.direction /= slope.length;
  }
  return slopes;
}

} // namespace pcl_uvol::detail
