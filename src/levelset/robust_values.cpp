// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/robust_values.h"

#include "common/median.h"
#include "common/parallel.h"
#include "isosurface/spike_test.h"
#include "levelset/constants.h"
#include "neighbors/nearest_finder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr std::size_t spike_block = 256;

constexpr SpikeBounds spike_bounds{level_set.spike_deviations,
                                   level_set.most_companions};

/** The median of |f| at some samples; those at the isovalue itself tell nothing. */
float
medianSize(const std::vector<float>& f, const std::vector<std::uint32_t>& samples)
{
  std::vector<float> sizes;
  for (const std::uint32_t sample : samples)
    if (f[sample] != 0.0f)
      sizes.push_back(std::abs(f[sample]));
  return computeMedian(sizes);
}

/** A value that stands alone, and what its neighbours say instead. */
struct Spike {
  std::uint32_t sample;
  float replacement;
};

std::vector<Spike>
findSpikes(const SampleSet& samples,
           const std::vector<float>& f,
           const std::vector<std::uint32_t>& among,
           std::size_t k,
           unsigned threads)
{
  return parallelGather<Spike>(
      among.size(), spike_block, threads, [&](auto begin, auto end, auto& found) {
        NearestFinder finder(samples, k + 1);
        std::vector<float> others;
        float length = 1.0f;
        for (std::size_t i = begin; i < end; ++i) {
          const auto row = finder.find(samples.getPositions()[among[i]], length);
          length = std::sqrt(*std::max_element(row.sq_dists, row.sq_dists + row.size));
          others.clear();
          for (std::size_t j = 0; j < row.size; ++j)
            if (row.samples[j] != among[i])
              others.push_back(f[row.samples[j]]);
          const float value = settleValue(f[among[i]], others, spike_bounds);
          if (value != f[among[i]])
            found.push_back({among[i], value});
        }
      });
}

} // namespace

std::vector<std::uint32_t>
findCrossing(const SampleSet& samples,
             const std::vector<float>& values,
             unsigned threads)
{
  const KdTree& tree = samples.getTree();
  return tree.findCrossing(
      samples.getPositions(), tree.computeRanges(values, threads), 0.0f, threads);
}

TamedValues
tameValues(const SampleSet& samples,
           std::vector<float>& f,
           std::size_t k,
           unsigned threads,
           Report& report)
{
  auto crossing = findCrossing(samples, f, threads);
  const auto spikes = findSpikes(samples, f, crossing, k, threads);
  const bool had_spikes =
      static_cast<double>(spikes.size()) >
      level_set.warned_outliers * static_cast<double>(crossing.size());
  report.count("outliers", spikes.size());
  if (had_spikes)
    report.warn("outliers",
                {{"percent",
                  100.0 * static_cast<double>(spikes.size()) /
                      static_cast<double>(crossing.size())},
                 {"outliers", spikes.size()}});
  for (const Spike& spike : spikes)
    f[spike.sample] = spike.replacement;
  if (!spikes.empty())
    crossing = findCrossing(samples, f, threads);
  if (crossing.empty())
    return {{}, had_spikes};
  const float median = medianSize(f, crossing);
  const int exponent = -std::ilogb(median);
  const float limit = level_set.farthest_value * std::ldexp(median, exponent);
  for (float& value : f)
    value = std::clamp(std::ldexp(value, exponent), -limit, limit);
  return {std::move(crossing), had_spikes};
}

} // namespace pcl_uvol
