// SPDX-License-Identifier: BSD-3-Clause
// Ranges, histograms and isovalues by sorting, spacing by nearest neighbours.
#include "pipeline/dataset_info.h"

#include "common/parallel.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/sampling.h"
#include <pcl_uvol/common/cloud_view.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t info_block = 1u << 12;
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

/** Points with finite coordinates. */
std::vector<std::uint32_t>
listFinite(const CloudView& cloud)
{
  std::vector<std::uint32_t> finite;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const float* const p = cloud.xyz(i);
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
      finite.push_back(static_cast<std::uint32_t>(i));
  }
  return finite;
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
                  const detail::Stretch& stretch,
                  unsigned threads,
                  const ProgressCallback& progress)
{
  const CloudView cloud = viewOf(dataset.cloud);
  PositionStatistics statistics;
  const std::vector<std::uint32_t> finite = listFinite(cloud);
  statistics.non_finite = cloud.count - finite.size();
  if (finite.empty())
    return statistics;
  Report report;
  report.progress = progress;
  const CloudView turned = detail::StretchAxes(stretch.rotation).turn(cloud);
  const auto samples = SampleSet::build(turned.xyz(0),
                                        turned.stride(),
                                        finite,
                                        toPosition(stretch.scale),
                                        threads,
                                        report);
  for (const SampleSet::Merged& merged : samples->getMerged())
    statistics.duplicates += merged.members.size() - 1;
  statistics.warnings = report.warnings;
  const auto& positions = samples->getPositions();
  const LengthUnit& unit = samples->getUnit();
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < samples->size(); ++i)
    box.extend(Eigen::Vector3f(cloud.xyz(samples->getInputIndex(i))));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    statistics.lower[axis] = dataset.origin[axis] + static_cast<double>(box.min()[a]);
    statistics.upper[axis] = dataset.origin[axis] + static_cast<double>(box.max()[a]);
  }
  if (positions.size() < 2)
    return statistics;
  std::vector<float> spacing(positions.size());
  StepTimer step(report, "spacing", positions.size());
  parallelBlocks(
      positions.size(), info_block, threads, [&](std::size_t begin, std::size_t end) {
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

void
addSamplingFields(Dataset& dataset,
                  const detail::Stretch& stretch,
                  unsigned threads,
                  const ProgressCallback& progress)
{
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const std::size_t count = dataset.cloud.width;
  std::vector<std::int32_t> dimension(count, -1);
  std::vector<float> along(count, none), across(count, none);
  const CloudView cloud = viewOf(dataset.cloud);
  if (const auto finite = listFinite(cloud); !finite.empty()) {
    Report report;
    report.progress = progress;
    const CloudView turned = detail::StretchAxes(stretch.rotation).turn(cloud);
    const auto samples = SampleSet::build(turned.xyz(0),
                                          turned.stride(),
                                          finite,
                                          toPosition(stretch.scale),
                                          threads,
                                          report);
    const std::vector<LocalSampling> found =
        diagnoseSampling(*samples, threads, progress);
    const auto assign = [&](std::uint32_t point, const LocalSampling& sampling) {
      dimension[point] = static_cast<std::int32_t>(sampling.dimension);
      along[point] = std::isfinite(sampling.along) ? sampling.along : none;
      across[point] = std::isfinite(sampling.across) ? sampling.across : none;
    };
    for (std::size_t i = 0; i < found.size(); ++i)
      assign(samples->getInputIndex(i), found[i]);
    for (const SampleSet::Merged& merged : samples->getMerged())
      for (const std::uint32_t member : merged.members)
        assign(member, found[merged.sample]);
  }
  setField(dataset, "local_dimension", dimension);
  dataset.labels["local_dimension"] = {"isolated", "line", "sheet", "volume"};
  setField(dataset, "spacing_along", along);
  setField(dataset, "spacing_across", across);
}

} // namespace pcl_uvol
