// SPDX-License-Identifier: BSD-3-Clause
// The origin that float coordinates need, from what the coordinates in double are like.
#pragma once

#include <pcl_uvol/common/export.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pcl_uvol {

/** \brief Takes coordinates one after another and tells the origin of them all. */
class PCL_UVOL_EXPORTS CoordinateRange {
public:
  /** \brief Take a coordinate of an axis (0 to 2); one that is not finite counts for
   * nothing. */
  void
  add(std::size_t axis, double value)
  {
    if (!std::isfinite(value))
      return;
    Axis& range = axes_[axis];
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
    const double error =
        std::abs(static_cast<double>(static_cast<float>(value)) - value);
    range.float_error = std::max(range.float_error, error);
  }

  /** \brief Take what another range has taken. */
  void
  add(const CoordinateRange& other)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Axis& range = axes_[axis];
      range.low = std::min(range.low, other.axes_[axis].low);
      range.high = std::max(range.high, other.axes_[axis].high);
      range.float_error = std::max(range.float_error, other.axes_[axis].float_error);
    }
  }

  /** \brief What setCoordinates() promises of an origin.
   * \throws InvalidArgument for a coordinate beyond float */
  std::array<double, 3>
  origin() const;

private:
  struct Axis {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double float_error = 0.0; ///< largest distance from a coordinate to its float

    double
    extent() const
    {
      return high > low ? high - low : 0.0;
    }

    double
    largest() const
    {
      return high >= low ? std::max(std::abs(low), std::abs(high)) : 0.0;
    }
  };
  std::array<Axis, 3> axes_;
};

} // namespace pcl_uvol
