// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/sample_set.h"

#include "common/parallel.h"
#include "neighbors/length_unit.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr std::size_t set_block = 1u << 14;

/** What became of points of a block. */
struct Gathered {
  std::size_t records = 0, non_finite = 0;
  FarPoints far_points;
};

/** Records of the points that are samples.
 * \param all gets what became of the others */
SampleRecords
gatherRecords(const float* xyz,
              std::size_t stride,
              const std::vector<std::uint32_t>& use,
              const LengthUnit& unit,
              unsigned threads,
              Gathered& all)
{
  SampleRecords records(use.size());
  std::vector<Gathered> blocks((use.size() + set_block - 1) / set_block);
  parallelBlocks(
      use.size(), set_block, threads, [&](std::size_t begin, std::size_t end) {
        Gathered& block = blocks[begin / set_block];
        for (std::size_t i = begin; i < end; ++i) {
          const float* const point = xyz + use[i] * stride;
          const Position raw{{point[0], point[1], point[2]}};
          const Position position = unit.apply(raw);
          if (unit.isWithin(position))
            records[begin + block.records++] = {position, use[i]};
          else if (isFinite(raw))
            block.far_points.add(use[i], raw);
          else
            ++block.non_finite;
        }
      });
  auto end = records.begin();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto begin = records.begin() + static_cast<std::ptrdiff_t>(i * set_block);
    const auto last = begin + static_cast<std::ptrdiff_t>(blocks[i].records);
    end = begin == end ? last : std::move(begin, last, end);
    all.non_finite += blocks[i].non_finite;
    all.far_points.add(blocks[i].far_points);
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

/** Input points of equal positions. */
struct Duplicates {
  std::vector<std::uint32_t> members; ///< ascending for each position
  std::vector<std::size_t> ends;      ///< of each position's members
};

/** Leave one record, that of the lowest input index, per position.
 * \param records equal ones side by side */
Duplicates
mergeDuplicates(SampleRecords& records)
{
  Duplicates duplicates;
  std::vector<std::uint32_t>& members = duplicates.members;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < records.size(); ++kept) {
    const SampleRecord first = records[i];
    std::size_t end = i + 1;
    while (end < records.size() && samePosition(first, records[end]))
      ++end;
    records[kept] = first;
    if (end - i > 1) {
      const auto begin = static_cast<std::ptrdiff_t>(members.size());
      for (std::size_t k = i; k < end; ++k)
        members.push_back(records[k].input_index);
      std::sort(members.begin() + begin, members.end());
      records[kept].input_index = members[static_cast<std::size_t>(begin)];
      duplicates.ends.push_back(members.size());
    }
    i = end;
  }
  records.resize(kept);
  return duplicates;
}

/** The samples that stand for several points, in leaf order. */
std::vector<SampleSet::Merged>
findMerged(const Duplicates& duplicates, const SampleRecords& records)
{
  // Per input index that stands for others its place among the duplicates.
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const std::uint32_t* const members = duplicates.members.data();
  const auto rowOf = [&](std::size_t place) {
    return NeighborGraph::Row{members + (place == 0 ? 0 : duplicates.ends[place - 1]),
                              members + duplicates.ends[place]};
  };
  std::vector<std::uint32_t> place_of;
  for (std::size_t place = 0; place < duplicates.ends.size(); ++place) {
    const std::uint32_t first = *rowOf(place).begin();
    if (first >= place_of.size())
      place_of.resize(
          std::max<std::size_t>(first + std::size_t{1}, 2 * place_of.size()), none);
    place_of[first] = static_cast<std::uint32_t>(place);
  }
  std::vector<SampleSet::Merged> merged;
  merged.reserve(duplicates.ends.size());
  for (std::size_t i = 0; i < records.size(); ++i)
    if (const std::uint32_t index = records[i].input_index;
        index < place_of.size() && place_of[index] != none)
      merged.push_back({static_cast<std::uint32_t>(i), rowOf(place_of[index])});
  return merged;
}

} // namespace

SampleSet::ConstPtr
SampleSet::build(const float* xyz,
                 std::size_t stride,
                 const std::vector<std::uint32_t>& use,
                 const Position& scale,
                 unsigned threads,
                 Report& report,
                 SplitRule rule)
{
  const auto position_at = [&](std::size_t i) -> Position {
    const float* const point = xyz + use[i] * stride;
    return {{point[0], point[1], point[2]}};
  };
  const LengthUnit unit =
      countMagnitudes(use.size(), position_at, scale, threads).findUnit(scale);
  return buildInUnit(xyz, stride, use, unit, threads, report, rule);
}

SampleSet::ConstPtr
SampleSet::buildInUnit(const float* xyz,
                       std::size_t stride,
                       const std::vector<std::uint32_t>& use,
                       const LengthUnit& unit,
                       unsigned threads,
                       Report& report,
                       SplitRule rule)
{
  StepTimer step(report, "tree", use.size());
  Gathered gathered;
  SampleRecords records = gatherRecords(xyz, stride, use, unit, threads, gathered);
  report.countSamples("non_finite", gathered.non_finite);
  if (gathered.far_points.count > 0)
    report.countSamples("far_points", gathered.far_points.count);
  gathered.far_points.warn(report);
  if (records.empty())
    throw InvalidArgument("no_usable_sample", {{"samples", use.size()}});

  // Not make_shared: the constructor is private.
  const std::shared_ptr<SampleSet> set(new SampleSet);
  Parts& parts = set->parts_;
  parts.unit = unit;
  KdTree& tree = parts.trees.emplace_back();
  const std::size_t finite = records.size();
  if (!tree.build(records, threads, step, rule)) {
    Duplicates duplicates = mergeDuplicates(records);
    tree.build(records, threads, step, rule);
    set->merged_ = findMerged(duplicates, records);
    set->members_ = std::move(duplicates.members);
  }
  report.countSamples("duplicates", finite - records.size());

  parts.size = records.size();
  resizeLarge(parts.positions, records.size());
  resizeLarge(set->input_indices_, records.size());
  parallelBlocks(
      records.size(), set_block, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          parts.positions[i] = records[i].position;
          set->input_indices_[i] = records[i].input_index;
        }
      });
  return set;
}

} // namespace pcl_uvol
