// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/periodic_box.h"

#include "common/parallel.h"
#include "common/records.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace pcl_uvol {
namespace {

/** Share of a side: samples may lie so far outside of a box that rounding, or the last
 * step of a simulation, has taken them there. */
constexpr double slack = 0.01;

/** Share of a side: where samples fill less of it, neighbours across the faces are
 * none. */
constexpr double least_fill = 0.75;

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Extent
findExtent(const CloudView& cloud, std::size_t axis)
{
  Extent extent;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double x = static_cast<double>(cloud.xyz(i)[axis]);
    if (!std::isfinite(x))
      continue;
    extent.low = std::min(extent.low, x);
    extent.high = std::max(extent.high, x);
  }
  return extent;
}

double
chooseLow(const Extent& extent, double side, double origin)
{
  const double room = slack * side;
  for (const double low : {-origin, -origin - side / 2.0})
    if (extent.low >= low - room && extent.high <= low + side + room)
      return low;
  return extent.high - extent.low <= side ? extent.low : -origin;
}

/** Where a cyclic sequence is best begun so that it is the greatest of all beginnings:
 * one pass, two candidates that are compared number by number. */
std::size_t
findGreatestRotation(const std::vector<double>& numbers)
{
  const std::size_t n = numbers.size();
  std::size_t first = 0, second = 1, same = 0;
  while (first < n && second < n && same < n) {
    const double a = numbers[(first + same) % n], b = numbers[(second + same) % n];
    if (a == b) {
      ++same;
      continue;
    }
    (a > b ? second : first) += same + 1;
    if (first == second)
      ++second;
    same = 0;
  }
  return std::min(first, second);
}

/** The coordinate that follows the widest gap. */
double
findCut(const CloudView& cloud,
        const PeriodicBox& box,
        std::size_t axis,
        unsigned threads)
{
  std::vector<double> places;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (const float x = cloud.xyz(i)[axis]; std::isfinite(x))
      places.push_back(box.toBox(static_cast<double>(x), axis));
  if (places.empty())
    return 0.0;
  parallelSort(places.begin(), places.end(), threads, std::less<>());
  std::vector<double> gaps(places.size()); // in front of each place
  gaps[0] = places.front() + box.sides[axis] - places.back();
  for (std::size_t i = 1; i < places.size(); ++i)
    gaps[i] = places[i] - places[i - 1];
  return places[findGreatestRotation(gaps)];
}

} // namespace

double
PeriodicBox::toBox(double coordinate, std::size_t axis) const
{
  const double from_low = coordinate - low[axis], side = sides[axis];
  if (!(side > 0.0) || !std::isfinite(from_low) || (from_low >= 0.0 && from_low < side))
    return from_low;
  const double place = std::fmod(from_low, side);
  const double positive = place < 0.0 ? place + side : place;
  return positive < side ? positive : 0.0;
}

std::array<double, 3>
PeriodicBox::toBox(const std::array<double, 3>& place) const
{
  return {toBox(place[0], 0), toBox(place[1], 1), toBox(place[2], 2)};
}

bool
PeriodicBox::holds(const float* place) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (sides[axis] > 0.0 &&
        !(place[axis] >= 0.0f && static_cast<double>(place[axis]) < sides[axis]))
      return false;
  return true;
}

void
checkPeriodic(const std::array<double, 3>& sides)
{
  for (const double side : sides)
    if (!(side >= 0.0) || !std::isfinite(side))
      throw InvalidArgument("A box that repeats needs sides from 0, where 0 stands for "
                            "an axis along which it does not, and " +
                            std::to_string(side) + " is none.");
}

PeriodicBox
findPeriodicBox(const Dataset& samples,
                const std::array<double, 3>& sides,
                Report& report)
{
  checkPeriodic(sides);
  const CloudView cloud = viewOf(samples.cloud);
  PeriodicBox box;
  box.sides = sides;
  std::vector<std::uint8_t> is_outside(cloud.count, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Extent extent = findExtent(cloud, axis);
    if (!(sides[axis] > 0.0) || !(extent.low <= extent.high))
      continue;
    box.low[axis] = chooseLow(extent, sides[axis], samples.origin[axis]);
    if (extent.high - extent.low < least_fill * sides[axis]) {
      std::ostringstream text;
      text << "Samples fill " << extent.high - extent.low << " of the side "
           << sides[axis] << " of the box along "
           << "xyz"[axis] << ": if they should fill it, its side is wrong.";
      report.warnings.push_back(text.str());
    }
    for (std::size_t i = 0; i < cloud.count; ++i) {
      const double from_low = static_cast<double>(cloud.xyz(i)[axis]) - box.low[axis];
      if (from_low < 0.0 || from_low > sides[axis])
        is_outside[i] = 1;
    }
  }
  const auto outside = std::count(is_outside.begin(), is_outside.end(), 1);
  if (outside > 0)
    report.count("moved_into_box", static_cast<std::uint64_t>(outside));
  return box;
}

PeriodicBox
cutAtWidestGap(const Dataset& samples, const PeriodicBox& box, unsigned threads)
{
  const CloudView cloud = viewOf(samples.cloud);
  PeriodicBox cut = box;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.sides[axis] > 0.0)
      cut.low[axis] += findCut(cloud, box, axis, threads);
  return cut;
}

} // namespace pcl_uvol
