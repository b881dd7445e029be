// SPDX-License-Identifier: BSD-3-Clause
// Values along the axes of a box, and their names: where their letters stand.
#pragma once

#include "charts/drawing.h"
#include "charts/seen_box.h"

#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace uvol_tools {

/** \brief How lines and letters look. */
struct MarkStyle {
  int font; ///< size, pixels
  Ink ink;
};

/** \brief Letters about a place of an axis. */
struct AxisLetters {
  TextLine line;
  Pixel place;
};

/** \brief What stands beside an edge of a box. */
struct AxisMarks {
  std::vector<std::array<Pixel, 2>> ticks;
  std::vector<AxisLetters> letters; ///< values, then the name
};

/** \brief The round values of an axis, as many as their letters leave room for, but the
 * outermost two at least, whose letters make room for each other, and its name; nothing
 * without an edge to stand at. */
AxisMarks
layOutAxis(const SeenBox& box, int axis, const MarkStyle& style);

/** \brief The pixels of all letters of a box with axes. */
Eigen::AlignedBox2d
boxAroundLetters(const SeenBox& box, const MarkStyle& style);

/** \brief Pixels that letters of values need beside a box and below it, whichever side
 * it is seen from. */
std::array<double, 2>
findRoomAround(const DataBox& box, const MarkStyle& style);

} // namespace uvol_tools
