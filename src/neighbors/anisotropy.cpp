// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/anisotropy.h"

#include "neighbors/local_metric.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr double low_percentile = 0.05;
constexpr double high_percentile = 0.95;

/** Samples around which spacings are looked at: medians of so many are good to 2 %. */
constexpr std::size_t most_places = 4096;

float
percentile(std::vector<float>& values, double fraction)
{
  const auto rank =
      static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/** Median spacings along the axes; nothing for samples on a plane or a line. */
std::optional<Eigen::Array3f>
findSpacings(const SampleSet& samples)
{
  const std::size_t step = (samples.size() + most_places - 1) / most_places;
  LocalMetricFinder metrics(samples);
  std::vector<float> spacings[3];
  for (std::size_t i = 0; i < samples.size(); i += step) {
    metrics.find(static_cast<std::uint32_t>(i));
    if (!std::isfinite(metrics.getRatio()))
      continue;
    for (int axis = 0; axis < 3; ++axis)
      spacings[axis].push_back(
          static_cast<float>(std::sqrt(metrics.getSpacings()(axis, axis))));
  }
  if (spacings[0].empty())
    return std::nullopt;
  Eigen::Array3f medians;
  for (int axis = 0; axis < 3; ++axis)
    medians[axis] = percentile(spacings[axis], 0.5);
  return medians;
}

} // namespace

Eigen::Array3f
findSpread(const CloudView& cloud, const std::vector<std::uint32_t>& use)
{
  Eigen::Array3f spread;
  std::vector<float> values(use.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(use.begin(), use.end(), values.begin(), [&](std::uint32_t i) {
      return cloud.xyz(i)[axis];
    });
    spread[axis] =
        percentile(values, high_percentile) - percentile(values, low_percentile);
  }
  return spread;
}

Eigen::Array3f
equalizeSpread(const Eigen::Array3f& spread)
{
  return (spread > 0.0f).select(spread.maxCoeff() / spread, Eigen::Array3f::Ones());
}

Eigen::Array3f
equalizingScale(const CloudView& cloud)
{
  std::vector<std::uint32_t> use;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (const float* const xyz = cloud.xyz(i);
        std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]))
      use.push_back(static_cast<std::uint32_t>(i));
  if (use.empty())
    throw InvalidArgument("no_sample_for_scale", {});
  const Eigen::Array3f scale = equalizeSpread(findSpread(cloud, use));
  Report report;
  const auto samples = SampleSet::build(cloud.xyz(0),
                                        cloud.stride(),
                                        use,
                                        Position{{scale[0], scale[1], scale[2]}},
                                        0,
                                        report);
  const auto spacings = findSpacings(*samples);
  if (!spacings)
    return scale;
  const Eigen::Array3f factors = scale / *spacings;
  return factors / factors.minCoeff();
}

} // namespace pcl_uvol
