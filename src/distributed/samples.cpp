// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/samples.h"

#include "common/large_array.h"
#include "common/parallel.h"
#include "distributed/byte_stream.h"
#include "neighbors/sample_values.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr std::size_t scatter_block = 1u << 14;

} // namespace

void
Samples::reserve(std::size_t count)
{
  reserveLarge(positions, count);
  reserveLarge(values, count);
  reserveLarge(sources, count);
}

void
Samples::resize(std::size_t count)
{
  resizeLarge(positions, count);
  resizeLarge(values, count);
  resizeLarge(sources, count);
}

void
Samples::append(const SampleSpan& others)
{
  const auto copy = [&](const auto* from, auto& to) {
    to.insert(to.end(), from, from + others.size);
  };
  copy(others.positions, positions);
  copy(others.values, values);
  copy(others.sources, sources);
}

FarPoints
Samples::normalize(const LengthUnit& unit)
{
  FarPoints far_points;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const Position position = unit.apply(positions[i]);
    if (!LengthUnit::isWithin(position)) {
      far_points.add(sources[i], positions[i]);
      continue;
    }
    positions[kept] = position;
    values[kept] = values[i];
    sources[kept++] = sources[i];
  }
  resize(kept);
  return far_points;
}

ValueFrame
findValueFrame(const CloudView& cloud,
               const ScalarField& field,
               Communicator& communicator,
               unsigned threads)
{
  const std::vector<ValueRange> own{findValueRange(cloud, field, threads)};
  ValueRange all;
  for (const ValueRange& other : allGatherItems(communicator, own))
    all.add(other);
  return all.findFrame();
}

Samples
readSamples(const CloudView& cloud,
            const ScalarField& field,
            const ValueFrame& frame,
            std::uint64_t first_source,
            unsigned threads,
            Report& report)
{
  const StepTimer timer(report, "scalar");
  const std::vector<float> values = readValues(cloud, field, frame, threads);
  const auto position_of = [&](std::size_t i) -> Position {
    const float* const xyz = cloud.xyz(i);
    return {{xyz[0], xyz[1], xyz[2]}};
  };
  const auto is_sample = [&](std::size_t i, const Position& position) {
    return !std::isnan(values[i]) && isFinite(position);
  };
  struct Counts {
    std::size_t samples, no_value, non_finite;
  };
  std::vector<Counts> counts((cloud.count + scatter_block - 1) / scatter_block);
  const auto for_each_block = [&](const auto& visit) {
    parallelBlocks(cloud.count, scatter_block, threads, [&](auto begin, auto end) {
      visit(begin, end, counts[begin / scatter_block]);
    });
  };
  for_each_block([&](std::size_t begin, std::size_t end, Counts& count) {
    count = {};
    for (std::size_t i = begin; i < end; ++i)
      if (is_sample(i, position_of(i)))
        ++count.samples;
      else if (std::isnan(values[i]))
        ++count.no_value;
      else
        ++count.non_finite;
  });
  std::size_t total = 0;
  for (Counts& count : counts) {
    if (count.no_value > 0)
      report.count("no_value", count.no_value);
    if (count.non_finite > 0)
      report.count("non_finite", count.non_finite);
    total += std::exchange(count.samples, total); // the first one of the block
  }
  Samples samples;
  samples.resize(total);
  for_each_block([&](std::size_t begin, std::size_t end, const Counts& count) {
    std::size_t next = count.samples;
    for (std::size_t i = begin; i < end; ++i) {
      const Position position = position_of(i);
      if (!is_sample(i, position))
        continue;
      samples.positions[next] = position;
      samples.values[next] = values[i];
      samples.sources[next++] = first_source + i;
    }
  });
  return samples;
}

LengthUnit
normalizeTogether(Samples& samples,
                  const Position& scale,
                  Communicator& communicator,
                  unsigned threads,
                  Report& report)
{
  const auto position_at = [&](std::size_t i) { return samples.positions[i]; };
  MagnitudeCounts counts = countMagnitudes(samples.size(), position_at, scale, threads);
  communicator.allReduce(counts.getCounts());
  const LengthUnit unit = counts.findUnit(scale);
  const std::vector<FarPoints> own{samples.normalize(unit)};
  if (own[0].count > 0)
    report.count("far_points", own[0].count);
  FarPoints all;
  for (const FarPoints& far_points : allGatherItems(communicator, own))
    all.add(far_points);
  all.warn(report);
  return unit;
}

MergedSamples
mergeDuplicates(Samples& samples, unsigned threads)
{
  std::vector<std::uint32_t> order(samples.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto& positions = samples.positions;
  parallelSort(order.begin(), order.end(), threads, [&](auto a, auto b) {
    if (lessAlong(0, positions[a], positions[b]))
      return true;
    return !lessAlong(0, positions[b], positions[a]) &&
           samples.sources[a] < samples.sources[b];
  });
  Samples merged;
  std::uint64_t conflicting = 0;
  std::vector<std::uint32_t> members;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() &&
           !lessAlong(0, positions[order[begin]], positions[order[end]]))
      ++end;
    members.assign(order.begin() + static_cast<std::ptrdiff_t>(begin),
                   order.begin() + static_cast<std::ptrdiff_t>(end));
    const auto found = findRepresentative(
        members, [&](auto member) { return samples.values[member]; }, conflicting);
    merged.append(samples.span(found.source, 1));
    merged.values.back() = found.value;
    begin = end;
  }
  const std::uint64_t duplicates = samples.size() - merged.size();
  samples = std::move(merged);
  return {duplicates, conflicting};
}

} // namespace pcl_uvol
