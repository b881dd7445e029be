// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/sample_metrics.h"

#include "common/parallel.h"
#include "neighbors/local_metric.h"

#include <algorithm>
#include <cstddef>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t metric_block = 1024;

/** Samples out of all parts of a set that are looked at first, and the share of them
 * that must be stretched: of uniform random samples less than one in a hundred is. */
constexpr std::size_t most_looks = 1024;
constexpr double least_stretched = 0.02;

bool
hasStretched(const SampleSet& samples)
{
  const std::size_t step = (samples.size() + most_looks - 1) / most_looks;
  LocalMetricFinder finder(samples);
  std::size_t looks = 0, stretched = 0;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    const std::uint32_t anchor = finder.findAnchor(static_cast<std::uint32_t>(i));
    stretched += finder.find(anchor, SampleMetrics::least_ratio);
    ++looks;
  }
  return static_cast<double>(stretched) > least_stretched * static_cast<double>(looks);
}

} // namespace

SampleMetrics::SampleMetrics(const SampleSet& samples, unsigned threads)
{
  if (!hasStretched(samples))
    return;
  const std::size_t count = samples.size();
  metric_of_.assign(count, even);
  std::vector<std::vector<StretchedMetric>> of_blocks((count + metric_block - 1) /
                                                      metric_block);
  parallelBlocks(count, metric_block, threads, [&](auto begin, auto end) {
    LocalMetricFinder finder(samples);
    std::vector<StretchedMetric>& found = of_blocks[begin / metric_block];
    std::uint32_t last = even;
    bool is_stretched = false;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t anchor = finder.findAnchor(static_cast<std::uint32_t>(i));
      if (anchor != last) {
        last = anchor;
        is_stretched = finder.find(anchor, least_ratio);
        if (is_stretched)
          found.push_back({finder.getRatio() * finder.getMetric(), finder.getRatio()});
      }
      if (is_stretched)
        metric_of_[i] = static_cast<std::uint32_t>(found.size() - 1);
    }
  });
  // Indices are those in the block until now.
  std::size_t before = 0;
  for (std::size_t block = 0; block < of_blocks.size(); ++block) {
    const std::size_t end = std::min(count, (block + 1) * metric_block);
    for (std::size_t i = block * metric_block; i < end; ++i)
      if (metric_of_[i] != even)
        metric_of_[i] += static_cast<std::uint32_t>(before);
    metrics_.insert(metrics_.end(), of_blocks[block].begin(), of_blocks[block].end());
    before = metrics_.size();
  }
}

} // namespace pcl_uvol::detail
