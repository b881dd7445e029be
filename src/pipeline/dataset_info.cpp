// SPDX-License-Identifier: BSD-3-Clause
// Ranges, histograms and isovalues by sorting, spacing by nearest neighbours.
#include "pipeline/dataset_info.h"

#include "common/parallel.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/sampling.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_samples = 1u << 12;
/** Samples in leaf order that are looked up in one box. */
constexpr std::size_t expected_together = 8;

/** Quantiles of sorted values strictly between the extremes. */
std::vector<double>
suggestIsovalues(const std::vector<double>& sorted)
{
  const auto first = std::upper_bound(sorted.begin(), sorted.end(), sorted.front());
  const auto last = std::lower_bound(first, sorted.end(), sorted.back());
  std::vector<double> isovalues;
  for (const double quantile : {0.25, 0.5, 0.75, 0.95})
    if (first != last) {
      const auto rank =
          static_cast<std::ptrdiff_t>(quantile * static_cast<double>(last - first - 1));
      isovalues.push_back(first[rank]);
    }
  isovalues.erase(std::unique(isovalues.begin(), isovalues.end()), isovalues.end());
  return isovalues;
}

} // namespace

ValueStatistics
describeValues(const std::vector<double>& values)
{
  ValueStatistics statistics;
  std::vector<double> sorted;
  sorted.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) {
    return std::isfinite(v);
  });
  statistics.finite = sorted.size();
  statistics.missing = values.size() - sorted.size();
  if (sorted.empty())
    return statistics;
  std::sort(sorted.begin(), sorted.end());
  statistics.min = sorted.front();
  statistics.max = sorted.back();
  statistics.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) /
                    static_cast<double>(sorted.size());
  const double width = statistics.max - statistics.min;
  const auto bins = statistics.histogram.size();
  for (const double value : sorted) {
    const double place = width > 0.0 ? (value - statistics.min) / width : 0.0;
    const auto bin = static_cast<std::size_t>(place * static_cast<double>(bins));
    ++statistics.histogram[std::min(bin, bins - 1)];
  }
  statistics.isovalues = suggestIsovalues(sorted);
  return statistics;
}

std::vector<double>
readFieldValues(const Dataset& dataset, const ScalarField& field)
{
  std::vector<double> values(dataset.cloud.width);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = field.read(&dataset.cloud.data[i * dataset.cloud.point_step]);
  return values;
}

PositionStatistics
describePositions(const Dataset& dataset,
                  const Eigen::Array3f& scale,
                  unsigned threads,
                  const ProgressCallback& progress)
{
  const CloudView cloud = viewOf(dataset.cloud);
  PositionStatistics statistics;
  std::vector<std::uint32_t> finite;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const float* const p = cloud.xyz(i);
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
      finite.push_back(static_cast<std::uint32_t>(i));
  }
  statistics.non_finite = cloud.count - finite.size();
  if (finite.empty())
    return statistics;
  Report report;
  report.progress = progress;
  const auto samples = SampleSet::build(
      cloud.xyz(0), cloud.stride(), finite, toPosition(scale), threads, report);
  statistics.duplicates = report.getCount("duplicates");
  statistics.warnings = report.warnings;
  const auto& positions = samples->getPositions();
  const LengthUnit& unit = samples->getUnit();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    const auto [low, high] = std::minmax_element(
        positions.begin(), positions.end(), [&](const Position& p, const Position& q) {
          return p[a] < q[a];
        });
    statistics.lower[axis] =
        dataset.origin[axis] + static_cast<double>((*low)[a]) / unit.scale[a];
    statistics.upper[axis] =
        dataset.origin[axis] + static_cast<double>((*high)[a]) / unit.scale[a];
  }
  if (positions.size() < 2)
    return statistics;
  std::vector<float> spacing(positions.size());
  StepTimer step(report, "spacing", positions.size());
  parallelBlocks(
      positions.size(),
      block_samples,
      threads,
      [&](std::size_t begin, std::size_t end) {
        NearestFinder finder(*samples, 2); // every sample finds itself as well
        for (std::size_t i = begin; i < end; ++i) {
          if (i % expected_together == 0)
            finder.expect(&positions[i], std::min(expected_together, end - i));
          const auto nearest = finder.find(positions[i], 1.0f);
          const Position& other = positions[nearest.samples[nearest.samples[0] == i]];
          spacing[i] = std::hypot(positions[i][0] - other[0],
                                  positions[i][1] - other[1],
                                  positions[i][2] - other[2]);
        }
        step.advance(end - begin);
      });
  std::sort(spacing.begin(), spacing.end());
  statistics.spacing_min = unit.toInput(spacing.front());
  statistics.spacing_median = unit.toInput(spacing[spacing.size() / 2]);
  statistics.spacing_max = unit.toInput(spacing.back());
  statistics.sampling = summarizeSampling(*samples, threads);
  return statistics;
}

} // namespace pcl_uvol
