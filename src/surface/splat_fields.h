// SPDX-License-Identifier: BSD-3-Clause
// The names of a splat's fields in clouds and files.
#pragma once

#include <array>

namespace pcl_uvol {

/** \brief Those of PointSplat, in the order in which readSplats() takes them. */
inline constexpr std::array<const char*, 15> splat_fields = {"x",
                                                             "y",
                                                             "z",
                                                             "normal_x",
                                                             "normal_y",
                                                             "normal_z",
                                                             "tangent_x",
                                                             "tangent_y",
                                                             "tangent_z",
                                                             "radius",
                                                             "error",
                                                             "tilt_u",
                                                             "tilt_v",
                                                             "slope_u",
                                                             "slope_v"};

} // namespace pcl_uvol
