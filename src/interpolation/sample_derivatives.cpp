// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/sample_derivatives.h"

#include "common/memory.h"
#include "common/parallel.h"
#include "common/value_frame.h"
#include "interpolation/derivative_fitter.h"
#include "interpolation/memory_need.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

using Columns = std::vector<std::vector<double>>;

/** Samples that are fitted together: near one another, and a multiple of the lanes. */
constexpr std::size_t derivative_block = 256;

/** A linear function in space has so many coefficients. */
constexpr std::size_t least_samples = 4;

std::vector<std::uint32_t>
pointsWithValues(const Columns& columns, std::size_t points)
{
  std::vector<std::uint32_t> use;
  for (std::size_t i = 0; i < points; ++i)
    if (std::all_of(columns.begin(), columns.end(), [&](const auto& column) {
          return std::isfinite(column[i]);
        }))
      use.push_back(static_cast<std::uint32_t>(i));
  return use;
}

std::vector<ValueFrame>
findFrames(const Columns& columns)
{
  std::vector<ValueFrame> frames;
  for (const auto& column : columns) {
    ValueRange range;
    for (const double value : column)
      range.add(value);
    frames.push_back(range.findFrame());
  }
  return frames;
}

/** Values of all fields in leaf order and their frames. */
SampledFields
gatherFields(SampleSet::ConstPtr samples,
             const Columns& columns,
             const std::vector<ValueFrame>& frames,
             Report& report)
{
  SampledFields sampled;
  sampled.samples = std::move(samples);
  sampled.fields = columns.size();
  sampled.values.resize(sampled.samples->size() * columns.size());
  const auto put = [&](std::size_t sample, std::size_t field, double value) {
    // Adding zero turns -0 into 0, so that medians do not depend on its sign.
    sampled.values[sample * columns.size() + field] = frames[field].apply(value) + 0.0;
  };
  for (std::size_t i = 0; i < sampled.samples->size(); ++i)
    for (std::size_t f = 0; f < columns.size(); ++f)
      put(i, f, columns[f][sampled.samples->getInputIndex(i)]);
  std::uint64_t conflicting = 0;
  for (const SampleSet::Merged& merged : sampled.samples->getMerged())
    for (std::size_t f = 0; f < columns.size(); ++f) {
      std::vector<std::uint32_t> members(merged.members.begin(), merged.members.end());
      put(merged.sample,
          f,
          findRepresentative(
              members, [&](auto member) { return columns[f][member]; }, conflicting)
              .value);
    }
  report.count("conflicting_duplicates", conflicting);
  return sampled;
}

/** From the unit and frame of a sample set to those of the cloud and the field.
 * \param per_length the unit of the samples by that of the cloud */
PointDerivatives
toInput(PointDerivatives derivatives, double per_length, double factor)
{
  derivatives.gradient *= per_length / factor;
  derivatives.hessian *= per_length * per_length / factor;
  return derivatives;
}

/** The points that a sample stands for. */
template <typename Visit>
void
forPointsOf(const SampleSet& samples, std::size_t sample, const Visit& visit)
{
  const auto& merged = samples.getMerged();
  const auto found = std::lower_bound(
      merged.begin(), merged.end(), sample, [](const auto& one, std::size_t other) {
        return one.sample < other;
      });
  if (found == merged.end() || found->sample != sample)
    visit(samples.getInputIndex(sample));
  else
    for (const std::uint32_t member : found->members)
      visit(member);
}

} // namespace

std::uint64_t
computeDerivatives(const CloudView& cloud,
                   const Columns& columns,
                   unsigned threads,
                   const TakeDerivatives& take,
                   Report& report)
{
  const auto use = pointsWithValues(columns, cloud.count);
  if (use.size() < least_samples)
    throw InvalidArgument("few_samples_for_derivatives", {{"samples", use.size()}});
  checkMemoryOf(
      "Derivatives", use.size(), derivativeBytes(static_cast<double>(use.size())));
  const auto frames = findFrames(columns);
  const SampledFields sampled =
      gatherFields(SampleSet::build(cloud.xyz(0),
                                    cloud.stride(),
                                    use,
                                    Position{{1.0f, 1.0f, 1.0f}},
                                    threads,
                                    report),
                   columns,
                   frames,
                   report);
  const SampleSet& samples = *sampled.samples;
  if (samples.size() < least_samples)
    throw InvalidArgument("few_places_for_derivatives", {{"places", samples.size()}});
  std::atomic<std::uint64_t> reduced{0}, unknown{0};
  const auto per_length = static_cast<double>(samples.getUnit().factor);
  StepTimer step(report, "derivatives", samples.size());
  parallelBlocks(samples.size(), derivative_block, threads, [&](auto begin, auto end) {
    const BlockDerivatives found = DerivativeFitter(sampled).fit(
        static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin));
    reduced += found.reduced;
    unknown += found.unknown;
    std::vector<PointDerivatives> derivatives(sampled.fields);
    for (std::size_t i = 0; i < end - begin; ++i) {
      for (std::size_t f = 0; f < sampled.fields; ++f)
        derivatives[f] = toInput(
            found.derivatives[i * sampled.fields + f], per_length, frames[f].factor);
      forPointsOf(samples, begin + i, [&](std::uint32_t point) {
        take(point, derivatives.data());
      });
    }
    step.advance(end - begin);
  });
  report.count("reduced_fits", reduced);
  report.count("unknown_derivatives", unknown);
  return reduced;
}

} // namespace pcl_uvol::detail
