// SPDX-License-Identifier: BSD-3-Clause
#include "surface/usual_extent.h"

#include <algorithm>
#include <cstddef>

namespace pcl_uvol {

namespace {

/** Points at either end that may lie anywhere: one in a hundred. Tails and handles of
 * surfaces have more, ejecta and noise of a sensor fewer. */
constexpr std::size_t trimmed_part = 100;

/** Share of the side without them. Round and flat surfaces, whose outermost points lie
 * close to the others, have up to 1.05. */
constexpr double most_stretch = 2.0;

/** \param numbers are put into another order */
double
findUsualSide(std::vector<float>& numbers)
{
  const auto at = [&](std::size_t rank) {
    const auto place = numbers.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(numbers.begin(), place, numbers.end());
    return static_cast<double>(*place);
  };
  const std::size_t last = numbers.size() - 1, trimmed = numbers.size() / trimmed_part;
  const double all = at(last) - at(0);
  const double most = at(last - trimmed) - at(trimmed);
  return all > most_stretch * most ? most : all;
}

} // namespace

std::array<double, 3>
findUsualSides(const std::vector<Position>& positions)
{
  std::array<double, 3> sides{};
  if (positions.empty())
    return sides;
  std::vector<float> numbers(positions.size());
  for (std::size_t axis = 0; axis < sides.size(); ++axis) {
    std::transform(positions.begin(), positions.end(), numbers.begin(), [&](auto& p) {
      return p[static_cast<int>(axis)];
    });
    sides[axis] = findUsualSide(numbers);
  }
  return sides;
}

} // namespace pcl_uvol
