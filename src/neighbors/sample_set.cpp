// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/parallel.h>
#include <pcl_uvol/neighbors/length_unit.h>
#include <pcl_uvol/neighbors/sample_set.h>

#include <algorithm>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_samples = 1u << 14;

/** What became of points of a block. */
struct Gathered {
  std::size_t records = 0, non_finite = 0;
  Strays strays;
};

/** Records of the points that are samples. \param all gets what became of the others */
std::vector<SampleRecord>
gatherRecords(const float* xyz,
              std::size_t stride,
              const std::vector<std::uint32_t>& use,
              const LengthUnit& unit,
              unsigned threads,
              Gathered& all)
{
  std::vector<SampleRecord> records(use.size());
  std::vector<Gathered> blocks((use.size() + block_samples - 1) / block_samples);
  parallelBlocks(
      use.size(), block_samples, threads, [&](std::size_t begin, std::size_t end) {
        Gathered& block = blocks[begin / block_samples];
        for (std::size_t i = begin; i < end; ++i) {
          const float* const point = xyz + use[i] * stride;
          const Position raw{{point[0], point[1], point[2]}};
          const Position position = unit.apply(raw);
          if (unit.isWithin(position))
            records[begin + block.records++] = {position, use[i]};
          else if (isFinite(raw))
            block.strays.add(use[i], raw);
          else
            ++block.non_finite;
        }
      });
  auto end = records.begin();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto begin = records.begin() + static_cast<std::ptrdiff_t>(i * block_samples);
    const auto last = begin + static_cast<std::ptrdiff_t>(blocks[i].records);
    end = begin == end ? last : std::move(begin, last, end);
    all.non_finite += blocks[i].non_finite;
    all.strays.add(blocks[i].strays);
  }
  records.erase(end, records.end());
  return records;
}

bool
samePosition(const SampleRecord& a, const SampleRecord& b)
{
  return a.position[0] == b.position[0] && a.position[1] == b.position[1] &&
         a.position[2] == b.position[2];
}

/** Leave one record, that of the lowest input index, per position; members of the
 * others are told by the representative's input index. */
std::vector<SampleSet::Merged>
mergeDuplicates(std::vector<SampleRecord>& records)
{
  std::sort(
      records.begin(), records.end(), [](const SampleRecord& a, const SampleRecord& b) {
        if (samePosition(a, b))
          return a.input_index < b.input_index;
        return lessAlong(0, a.position, b.position);
      });
  std::vector<SampleSet::Merged> merged;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < records.size();) {
    std::size_t end = i + 1;
    while (end < records.size() && samePosition(records[i], records[end]))
      ++end;
    if (end - i > 1) {
      merged.push_back({records[i].input_index, {}});
      for (std::size_t k = i; k < end; ++k)
        merged.back().members.push_back(records[k].input_index);
    }
    records[kept++] = records[i];
    i = end;
  }
  records.resize(kept);
  return merged;
}

/** Turn input indices of representatives into sample indices. */
void
renumberMerged(std::vector<SampleSet::Merged>& merged,
               const std::vector<SampleRecord>& records)
{
  const auto by_sample = [](const SampleSet::Merged& a, const SampleSet::Merged& b) {
    return a.sample < b.sample;
  };
  std::sort(merged.begin(), merged.end(), by_sample);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const SampleSet::Merged key{records[i].input_index, {}};
    const auto found = std::lower_bound(
        merged.begin(), merged.end(), key, [](const auto& a, const auto& b) {
          return a.members.front() < b.sample;
        });
    if (found != merged.end() && found->members.front() == records[i].input_index)
      found->sample = static_cast<std::uint32_t>(i);
  }
  std::sort(merged.begin(), merged.end(), by_sample);
}

} // namespace

SampleSet::ConstPtr
SampleSet::build(const float* xyz,
                 std::size_t stride,
                 const std::vector<std::uint32_t>& use,
                 const Position& scale,
                 unsigned threads,
                 Report& report)
{
  const auto position_at = [&](std::size_t i) -> Position {
    const float* const point = xyz + use[i] * stride;
    return {{point[0], point[1], point[2]}};
  };
  const LengthUnit unit =
      countMagnitudes(use.size(), position_at, scale, threads).findUnit(scale);
  return buildInUnit(xyz, stride, use, unit, threads, report);
}

SampleSet::ConstPtr
SampleSet::buildInUnit(const float* xyz,
                       std::size_t stride,
                       const std::vector<std::uint32_t>& use,
                       const LengthUnit& unit,
                       unsigned threads,
                       Report& report)
{
  StepTimer step(report, "tree", use.size());
  Gathered gathered;
  std::vector<SampleRecord> records =
      gatherRecords(xyz, stride, use, unit, threads, gathered);
  report.count("non_finite", gathered.non_finite);
  if (gathered.strays.count > 0)
    report.count("strays", gathered.strays.count);
  gathered.strays.warn(report);
  if (records.empty())
    throw InvalidArgument("The cloud has no usable sample: all " +
                          std::to_string(use.size()) +
                          " given have a non-finite coordinate.");

  // Not make_shared: the constructor is private.
  const std::shared_ptr<SampleSet> set(new SampleSet);
  Parts& parts = set->parts_;
  parts.unit = unit;
  KdTree& tree = parts.trees.emplace_back();
  const std::size_t finite = records.size();
  if (!tree.build(records, threads, step)) {
    set->merged_ = mergeDuplicates(records);
    tree.build(records, threads, step);
    renumberMerged(set->merged_, records);
  }
  report.count("duplicates", finite - records.size());

  parts.size = records.size();
  parts.positions.resize(records.size());
  set->input_indices_.resize(records.size());
  parallelBlocks(
      records.size(), block_samples, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          parts.positions[i] = records[i].position;
          set->input_indices_[i] = records[i].input_index;
        }
      });
  return set;
}

} // namespace pcl_uvol
