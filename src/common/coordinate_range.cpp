// SPDX-License-Identifier: BSD-3-Clause
// Where float holds no coordinate well enough, an origin is chosen amid them.
#include <pcl_uvol/common/coordinate_range.h>
#include <pcl_uvol/common/exceptions.h>

namespace pcl_uvol {
namespace {

/** Relative to the extent: what float may lose of a coordinate. */
constexpr double coordinate_tolerance = 1e-7;
/** An axis thinner than this part of the cloud is flat, and noise across it no extent.
 */
constexpr double flat_extent = 0x1p-13;
/** The extent of a single place, as part of its largest coordinate. */
constexpr double place_extent = 0x1p-20;

} // namespace

std::array<double, 3>
CoordinateRange::origin() const
{
  double extent = 0.0, largest = 0.0;
  for (const Axis& range : axes_) {
    if (range.largest() > std::numeric_limits<float>::max())
      throw InvalidArgument("A coordinate is larger than float can hold (3.4e38): "
                            "scale the coordinates down.");
    extent = std::max(extent, range.extent());
    largest = std::max(largest, range.largest());
  }
  if (extent == 0.0)
    extent = place_extent * largest;
  std::array<double, 3> origin{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Axis& range = axes_[axis];
    const double scale =
        range.extent() > flat_extent * extent ? range.extent() : extent;
    if (range.float_error <= coordinate_tolerance * scale)
      continue;
    const double step = std::exp2(std::floor(std::log2(scale)));
    origin[axis] = std::round(0.5 * (range.low + range.high) / step) * step;
  }
  return origin;
}

} // namespace pcl_uvol
