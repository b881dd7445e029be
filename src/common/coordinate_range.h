// SPDX-License-Identifier: BSD-3-Clause
// The origin that float coordinates need, from what the coordinates in double are like.
#pragma once

#include "common/number_range.h"
#include "common/sketch.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/message.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief Takes points one after another and tells the origin of them all: the same for
 * any order and division of them. */
class PCL_UVOL_EXPORTS CoordinateRange {
public:
  using Point = std::array<double, 3>;

  /** \brief Take a point; a coordinate that is not finite counts for nothing, and so
   * does one that is not a place, see placeOrNaN(). */
  void
  add(const Point& point)
  {
    bool is_finite = true, is_beyond = false;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (std::isfinite(placeOrNaN(point[axis])))
        axes_[axis].add(point[axis]);
      else {
        is_finite = false;
        is_beyond = is_beyond || std::isfinite(point[axis]);
      }
    beyond_ += is_beyond;
    if (!is_finite)
      return;
    ++count_;
    sketch_.add(point);
  }

  /** \brief Take what another range has taken. */
  void
  add(const CoordinateRange& other);

  /** \brief What setCoordinates() promises of an origin. A few points far from the
   * others, such as (0, 0, 0) for a position that is not known, have no say.
   * \throws InvalidArgument if all points have coordinates beyond float */
  Point
  findOrigin() const;

  /** \brief A message about points with coordinates beyond float; else none. */
  std::optional<Message>
  describeBeyond() const;

  /** \brief A message where float, relative to that origin, rounds coordinates by more
   * than a thousandth of the distance between neighbours, which is estimated from some
   * hundred points; else none. */
  std::optional<Message>
  describeRounding(const Point& origin) const;

private:
  /** One coordinate of the points of the sketch. */
  std::vector<double>
  getSketch(std::size_t axis) const;

  std::array<NumberRange, 3> axes_;
  Sketch<3> sketch_;
  std::uint64_t count_ = 0;  ///< finite points
  std::uint64_t beyond_ = 0; ///< points with a finite coordinate that is not a place
};

} // namespace pcl_uvol
