// SPDX-License-Identifier: BSD-3-Clause
// Numbers that many sources need.
#pragma once

#include <limits>

namespace pcl_uvol {

constexpr double pi = 3.14159265358979323846;

template <typename T>
constexpr T infinity = std::numeric_limits<T>::infinity();

} // namespace pcl_uvol
