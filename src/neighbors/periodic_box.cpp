// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/periodic_box.h"

#include "common/numbers.h"
#include "neighbors/widest_gap.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {
namespace {

/** Share of a side: samples may lie so far outside of a box that rounding, or the last
 * step of a simulation, has taken them there. */
constexpr double side_slack = 0.01;

/** Share of a side: where samples fill less of it, neighbours across the faces are
 * none. */
constexpr double least_fill = 0.75;

/** The same: unwrapped positions of a simulation lie in a few boxes beside each other,
 * most of them in one. */
constexpr double most_fill = 1.5;

double
chooseLow(const SampleExtents& extents, std::size_t axis, double side, double origin)
{
  const double room = side_slack * side;
  for (const double low : {-origin, -origin - side / 2.0})
    if (extents.low[axis] >= low - room && extents.high[axis] <= low + side + room)
      return low;
  return extents.getLength(axis) <= side ? extents.low[axis] : -origin;
}

void
warnOfMisfit(const SampleExtents& extents,
             std::size_t axis,
             double side,
             Report& report)
{
  const double length = extents.getLength(axis);
  if (length < least_fill * side || length > most_fill * side)
    report.warn(
        length < side ? "unfilled_box" : "samples_beyond_box",
        {{"length", length}, {"side", side}, {"axis", std::string(1, "xyz"[axis])}});
}

std::uint64_t
countOutside(const CloudView& cloud, const PeriodicBox& box)
{
  std::uint64_t outside = 0;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    bool is_outside = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from_low = static_cast<double>(cloud.xyz(i)[axis]) - box.low[axis];
      is_outside = is_outside || (box.sides[axis] > 0.0 &&
                                  (from_low < 0.0 || from_low > box.sides[axis]));
    }
    outside += is_outside;
  }
  return outside;
}

} // namespace

void
warnOfUnusedBox(const Dataset& samples,
                const std::array<double, 3>& sides,
                Report& report)
{
  if (!isPeriodic(sides) && isPeriodic(samples.box))
    report.warn("box_in_file", {{"sides", joinNumbers(samples.box)}});
}

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
      throw InvalidArgument("periodic_side_not_allowed", {{"side", side}});
}

void
SampleExtents::add(const float* xyz)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(xyz[axis]))
      continue;
    low[axis] = std::min(low[axis], static_cast<double>(xyz[axis]));
    high[axis] = std::max(high[axis], static_cast<double>(xyz[axis]));
  }
}

void
SampleExtents::add(const SampleExtents& other)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], other.low[axis]);
    high[axis] = std::max(high[axis], other.high[axis]);
  }
}

SampleExtents
findExtents(const CloudView& cloud)
{
  SampleExtents extents;
  for (std::size_t i = 0; i < cloud.count; ++i)
    extents.add(cloud.xyz(i));
  return extents;
}

PeriodicBox
findPeriodicBox(const Dataset& samples,
                const std::array<double, 3>& sides,
                Report& report)
{
  return findPeriodicBox(samples, findExtents(viewOf(samples.cloud)), sides, report);
}

PeriodicBox
findPeriodicBox(const Dataset& part,
                const SampleExtents& extents,
                const std::array<double, 3>& sides,
                Report& report)
{
  checkPeriodic(sides);
  PeriodicBox box;
  box.sides = sides;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(sides[axis] > 0.0) || !(extents.low[axis] <= extents.high[axis]))
      continue;
    box.low[axis] = chooseLow(extents, axis, sides[axis], part.origin[axis]);
    warnOfMisfit(extents, axis, sides[axis], report);
  }
  if (const auto outside = countOutside(viewOf(part.cloud), box); outside > 0)
    report.count("moved_into_box", outside);
  return box;
}

PeriodicBox
cutAtWidestGap(const Dataset& samples, const PeriodicBox& box, unsigned threads)
{
  const CloudView cloud = viewOf(samples.cloud);
  PeriodicBox cut = box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.sides[axis] > 0.0))
      continue;
    const std::vector<double> places = sortPlaces(cloud, box, axis, threads);
    if (places.empty())
      continue;
    std::vector<Gap> gaps =
        listGaps(places, places.front() + box.sides[axis] - places.back());
    const std::size_t count = gaps.size(), compared = std::min(count, most_compared);
    gaps.insert(
        gaps.end(), gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(compared));
    cut.low[axis] += gaps[findWidestGap(gaps, count, compared)].place;
  }
  return cut;
}

} // namespace pcl_uvol
