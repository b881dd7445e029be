// SPDX-License-Identifier: BSD-3-Clause
// Where float holds no coordinate well enough, an origin is chosen amid them.
#include "common/coordinate_range.h"

#include "common/median.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <limits>

namespace pcl_uvol {
namespace {

/** Relative to the extent: what float may lose of a coordinate. */
constexpr double coordinate_tolerance = 1e-7;
/** An axis thinner than this part of the cloud is flat, and noise across it no extent.
 */
constexpr double flat_extent = 0x1p-13;
/** The extent of a single place, as part of its largest coordinate. */
constexpr double place_extent = 0x1p-20;

/** Share of the distance between neighbours: what nobody needs to know of. */
constexpr double unnoticed_rounding = 1e-3;
/** Points that distances are measured among, and as many times fewer for a second look.
 */
constexpr std::size_t measured_points = 1024, fewer = 8;
/** One point in eight may be far from the others. */
constexpr std::size_t far_part = 8;

double
squaredDistance(const CoordinateRange::Point& a, const CoordinateRange::Point& b)
{
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

/** Median distance to the nearest other one, of the first points. */
double
medianNearest(const std::vector<CoordinateRange::Point>& points, std::size_t count)
{
  std::vector<double> nearest(count, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double sq_dist = squaredDistance(points[i], points[j]);
      nearest[i] = std::min(nearest[i], sq_dist);
      nearest[j] = std::min(nearest[j], sq_dist);
    }
  return std::sqrt(computeMedian(nearest));
}

/** Estimates the spacing of all points, by how distances grow in random parts of them.
 */
double
estimateSpacing(const std::vector<CoordinateRange::Point>& sketch, std::uint64_t total)
{
  const std::size_t count = std::min(sketch.size(), measured_points);
  const double spacing = medianNearest(sketch, count);
  if (count < measured_points)
    return spacing; // those are all there are
  // As the root of their number: points fill a line, a sheet or space.
  const double growth = medianNearest(sketch, count / fewer) / spacing;
  const double dimension =
      growth > 1.0 ? std::clamp(std::round(std::log(static_cast<double>(fewer)) /
                                           std::log(growth)),
                                1.0,
                                3.0)
                   : 3.0;
  return spacing * std::pow(static_cast<double>(count) / static_cast<double>(total),
                            1.0 / dimension);
}

} // namespace

void
CoordinateRange::add(const CoordinateRange& other)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    axes_[axis].add(other.axes_[axis]);
  sketch_.add(other.sketch_);
  count_ += other.count_;
  beyond_ += other.beyond_;
}

std::vector<double>
CoordinateRange::getSketch(std::size_t axis) const
{
  std::vector<double> coordinates;
  for (const Point& point : sketch_.getItems())
    coordinates.push_back(point[axis]);
  return coordinates;
}

CoordinateRange::Point
CoordinateRange::findOrigin() const
{
  if (count_ == 0 && beyond_ > 0)
    throw InvalidArgument("coordinates_beyond_float", {});
  std::array<NumberRange, 3> ranges;
  double extent = 0.0, largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ranges[axis] = findTypicalRange(axes_[axis], getSketch(axis));
    extent = std::max(extent, ranges[axis].getExtent());
    largest = std::max(largest, ranges[axis].getLargest());
  }
  if (extent == 0.0)
    extent = place_extent * largest;
  Point origin{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const NumberRange& range = ranges[axis];
    const double scale =
        range.getExtent() > flat_extent * extent ? range.getExtent() : extent;
    if (range.float_error > coordinate_tolerance * scale)
      origin[axis] = roundedMiddle(range, scale);
  }
  return origin;
}

std::optional<Message>
CoordinateRange::describeBeyond() const
{
  if (beyond_ == 0)
    return std::nullopt;
  return Message("points_beyond_float", {{"points", beyond_}});
}

std::optional<Message>
CoordinateRange::describeRounding(const Point& origin) const
{
  const auto rounding = [&](double coordinate, std::size_t axis) {
    return floatError(coordinate - origin[axis]);
  };
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (axes_[axis].high >= axes_[axis].low)
      largest = std::max(
          {largest, rounding(axes_[axis].low, axis), rounding(axes_[axis].high, axis)});
  std::vector<double> errors;
  const std::vector<Point> points = sketch_.getItems();
  for (const Point& point : points) {
    errors.push_back(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis)
      errors.back() = std::max(errors.back(), rounding(point[axis], axis));
    largest = std::max(largest, errors.back());
  }
  if (points.size() < 2 || largest == 0.0)
    return std::nullopt;
  const double spacing = estimateSpacing(points, count_);
  if (!(largest > unnoticed_rounding * spacing))
    return std::nullopt;
  const auto usual =
      errors.end() - 1 - static_cast<std::ptrdiff_t>(errors.size() / far_part);
  std::nth_element(errors.begin(), usual, errors.end());
  const bool is_usual = *usual > unnoticed_rounding * spacing;
  return Message(
      is_usual ? "rounded_coordinates" : "rounded_far_points",
      {{"rounding", largest}, {"spacings", largest / spacing}, {"spacing", spacing}});
}

} // namespace pcl_uvol
