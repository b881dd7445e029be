// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/value_ties.h"

#include <algorithm>
#include <cstddef>

namespace pcl_uvol {

double
shareOfCommonest(const std::vector<float>& values,
                 const std::vector<std::uint32_t>& samples)
{
  std::vector<float> sorted;
  sorted.reserve(samples.size());
  for (const std::uint32_t sample : samples)
    sorted.push_back(values[sample]);
  std::sort(sorted.begin(), sorted.end());
  std::size_t most = 0;
  for (auto begin = sorted.begin(); begin != sorted.end();) {
    const auto end = std::upper_bound(begin, sorted.end(), *begin);
    most = std::max(most, static_cast<std::size_t>(end - begin));
    begin = end;
  }
  return static_cast<double>(most) / static_cast<double>(samples.size());
}

} // namespace pcl_uvol
