// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/neighbors/anisotropy.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr double low_percentile = 0.05;
constexpr double high_percentile = 0.95;

float
percentile(std::vector<float>& values, double fraction)
{
  const auto rank =
      static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

} // namespace

Eigen::Array3f
equalizingScale(const CloudView& cloud)
{
  Eigen::Array3f spread;
  std::vector<float> values;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (std::size_t i = 0; i < cloud.count; ++i)
      if (const float* const xyz = cloud.xyz(i);
          std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]))
        values.push_back(xyz[axis]);
    if (values.empty())
      throw InvalidArgument("No sample has finite coordinates to find a scale from.");
    spread[axis] =
        percentile(values, high_percentile) - percentile(values, low_percentile);
  }
  const float largest = spread.maxCoeff();
  return (spread > 0.0f).select(largest / spread, Eigen::Array3f::Ones());
}

} // namespace pcl_uvol
