// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/sample_values.h"

#include "common/large_array.h"
#include "common/parallel.h"
#include "common/sample_checks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr std::size_t value_block = 1u << 14;

} // namespace

std::vector<float>
readValues(const CloudView& cloud,
           const ScalarField& field,
           const ValueFrame& frame,
           unsigned threads)
{
  std::vector<float> values;
  resizeLarge(values, cloud.count);
  const FieldComponent& first = field.getComponents().front();
  const bool is_plain = !field.isLength() &&
                        first.datatype == pcl::PCLPointField::FLOAT32 &&
                        frame == ValueFrame();
  parallelBlocks(
      cloud.count, value_block, threads, [&](std::size_t begin, std::size_t end) {
        if (is_plain) // most fields: without a call per value
          for (std::size_t i = begin; i < end; ++i)
            std::memcpy(&values[i], cloud.point(i) + first.offset, sizeof(float));
        else
          for (std::size_t i = begin; i < end; ++i)
            values[i] = static_cast<float>(frame.apply(field.read(cloud.point(i))));
        // Adding zero turns -0 into 0, so that medians do not depend on its sign.
        for (std::size_t i = begin; i < end; ++i)
          values[i] = std::isfinite(values[i])
                          ? values[i] + 0.0f
                          : std::numeric_limits<float>::quiet_NaN();
      });
  return values;
}

SampleValues
gatherValues(const SampleSet& samples,
             const std::vector<float>& input_values,
             unsigned threads,
             Report& report)
{
  SampleValues scalar;
  resizeLarge(scalar.values, samples.size());
  resizeLarge(scalar.sources, samples.size());
  parallelBlocks(
      samples.size(), value_block, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          scalar.sources[i] = samples.getInputIndex(i);
          scalar.values[i] = input_values[scalar.sources[i]];
        }
      });
  std::uint64_t conflicting = 0;
  std::vector<std::uint32_t> members;
  for (const SampleSet::Merged& merged : samples.getMerged()) {
    members.assign(merged.members.begin(), merged.members.end());
    const auto found = findRepresentative(
        members, [&](auto member) { return input_values[member]; }, conflicting);
    scalar.values[merged.sample] = found.value;
    scalar.sources[merged.sample] = found.source;
  }
  report.countSamples("conflicting_duplicates", conflicting);
  warnOfConflicts(conflicting, samples.size(), report);
  return scalar;
}

} // namespace pcl_uvol
