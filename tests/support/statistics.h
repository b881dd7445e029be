// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numeric>
#include <vector>

namespace uvol_test {

inline double
computeMean(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(values.size());
}

} // namespace uvol_test
