// SPDX-License-Identifier: BSD-3-Clause
// The middle of some numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl_uvol {

/** \brief The upper one of two in the middle.
 * \param values at least one; their order changes */
template <typename T>
T
computeMedian(std::vector<T>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace pcl_uvol
