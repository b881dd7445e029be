// SPDX-License-Identifier: BSD-3-Clause
// What kernels know of packed bends (surface_bend.h).
#pragma once

namespace pcl_uvol {

/** \brief More than that over a disc is an edge rather than a bend. */
constexpr float most_bend = 0.5f;

/** \brief Packed bends are whole numbers of the inverse of that. */
constexpr float packed_bend_scale = 511.0f / most_bend;

} // namespace pcl_uvol
