// SPDX-License-Identifier: BSD-3-Clause
// What kernels know of packed rim lines (rim_lines.h).
#pragma once

namespace pcl_uvol {

/** \brief The lower bits of a line tell how far it cuts into the disc, in so many steps
 * of the radius. 0: there is no line. @{ */
constexpr int rim_depth_bits = 7, rim_depth_steps = 1 << rim_depth_bits;
/** @} */

/** \brief The upper ones tell its direction, in so many steps counter-clockwise around
 * the square with corners on the axes, from that of the first axis on. */
constexpr int rim_directions = 512;

} // namespace pcl_uvol
