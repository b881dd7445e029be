// SPDX-License-Identifier: BSD-3-Clause
#include "median_search.h"

#include "../common/byte_stream.h"
#include <pcl_uvol/common/parallel.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/** A coordinate has three digits, a position nine. */
constexpr int digit_bits[3] = {11, 11, 10}, digit_shifts[3] = {21, 10, 0};
constexpr int position_digits = 9;
constexpr std::size_t digit_values = 1u << 11;

/** As few candidates of all processes are compared one by one, over all nodes of a
 * depth and for one of many. */
constexpr std::uint64_t few_candidates = 1u << 16, fewest_candidates = 16;

/** Of as many samples of a process their nodes are remembered, which takes 64 MB: walks
 * down the levels would be half of the work. */
constexpr std::uint64_t most_remembered = 1u << 24;

/** Samples that a thread takes at once. */
constexpr std::size_t block_samples = 1u << 14;

/** Whole numbers that are ordered as coordinates. */
std::uint32_t
orderedBits(float coordinate)
{
  std::uint32_t bits;
  std::memcpy(&bits, &coordinate, sizeof(bits));
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

/** A position in the total order along an axis (lessAlong), as three numbers. */
std::array<std::uint32_t, 3>
keyOf(int axis, const Position& position)
{
  return {orderedBits(position[axis]),
          orderedBits(position[(axis + 1) % 3]),
          orderedBits(position[(axis + 2) % 3])};
}

std::uint32_t
digitOf(const std::array<std::uint32_t, 3>& key, int digit)
{
  const int part = digit % 3;
  return key[static_cast<std::size_t>(digit / 3)] >> digit_shifts[part] &
         ((1u << digit_bits[part]) - 1u);
}

/** What is known of the median of a node. */
struct Median {
  std::uint64_t count = 0;                        ///< candidates left
  std::uint64_t rank = 0;                         ///< of the median among them
  int digits = 0;                                 ///< of it that are known
  std::array<std::uint32_t, 3> prefix{};          ///< those digits, zeros behind them
  Position below{{infinity, infinity, infinity}}; ///< the median
  Position above = below;                         ///< the next one

  bool
  isOpen(std::uint64_t few) const
  {
    return count > few && digits < position_digits;
  }

  /** Below, at or above the known digits: -1, 0, 1. */
  int
  compare(const std::array<std::uint32_t, 3>& key) const
  {
    for (int part = 0; part < 3; ++part) {
      const int known = std::clamp(digits - 3 * part, 0, 3);
      if (known == 0)
        return 0;
      const int shift = digit_shifts[known - 1];
      const auto i = static_cast<std::size_t>(part);
      const std::uint32_t a = key[i] >> shift, b = prefix[i] >> shift;
      if (a != b)
        return a < b ? -1 : 1;
    }
    return 0;
  }

  void
  append(std::uint32_t digit)
  {
    prefix[static_cast<std::size_t>(digits / 3)] |= digit << digit_shifts[digits % 3];
    ++digits;
  }
};

/** The position whose digits are all known. */
Position
positionOf(int axis, const std::array<std::uint32_t, 3>& key)
{
  Position position;
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t ordered = key[static_cast<std::size_t>(i)];
    const std::uint32_t bits =
        (ordered & 0x80000000u) != 0 ? ordered & 0x7fffffffu : ~ordered;
    std::memcpy(&position[(axis + i) % 3], &bits, sizeof(bits));
  }
  return position;
}

void
take(Position& least, int axis, const Position& position)
{
  if (lessAlong(axis, position, least))
    least = position;
}

/** A sample that may be the median of a node. */
struct Candidate {
  std::uint32_t node; // from the first one of the depth
  Position position;
};

/** The medians of one depth. */
class Level {
public:
  Level(const PositionScan& scan,
        RankGroup& ranks,
        unsigned threads,
        int depth,
        const AxisCycle& axes,
        const std::vector<PlaneKey>& planes,
        std::vector<std::uint32_t>& nodes)
      : scan_(scan)
      , ranks_(ranks)
      , threads_(resolveThreads(threads))
      , depth_(depth)
      , axis_(axes[static_cast<std::size_t>(depth)])
      , axes_(axes)
      , planes_(planes)
      , nodes_(nodes)
      , few_(std::max(few_candidates >> depth, fewest_candidates))
      , medians_(std::size_t(1) << depth)
  {
  }

  const std::vector<Median>&
  find()
  {
    do
      narrow();
    while (std::any_of(medians_.begin(), medians_.end(), [this](const Median& m) {
      return m.isOpen(few_);
    }));
    select();
    return medians_;
  }

private:
  /** One more digit of all medians that have many candidates. */
  void
  narrow()
  {
    std::vector<std::vector<std::uint64_t>> counts(
        threads_, std::vector<std::uint64_t>(medians_.size() * digit_values));
    scan([&](std::size_t thread, std::size_t node, const Position& position) {
      const Median& median = medians_[node];
      const auto key = keyOf(axis_, position);
      if ((median.digits == 0 || median.isOpen(few_)) && median.compare(key) == 0)
        ++counts[thread][node * digit_values + digitOf(key, median.digits)];
    });
    for (std::size_t thread = 1; thread < threads_; ++thread)
      for (std::size_t i = 0; i < counts[0].size(); ++i)
        counts[0][i] += counts[thread][i];
    ranks_.sum(counts[0]);
    for (std::size_t node = 0; node < medians_.size(); ++node)
      narrow(medians_[node], &counts[0][node * digit_values]);
  }

  void
  narrow(Median& median, const std::uint64_t* counts) const
  {
    if (median.digits == 0) {
      for (std::size_t digit = 0; digit < digit_values; ++digit)
        median.count += counts[digit];
      median.rank = median.count == 0 ? 0 : (median.count + 1) / 2 - 1;
    }
    else if (!median.isOpen(few_))
      return;
    std::uint32_t digit = 0;
    while (digit + 1 < digit_values && median.rank >= counts[digit])
      median.rank -= counts[digit++];
    median.count = counts[digit];
    median.append(digit);
  }

  /** Compare the candidates that are left. */
  void
  select()
  {
    std::vector<std::vector<Candidate>> found(threads_);
    std::vector<std::vector<Position>> above(
        threads_, std::vector<Position>(medians_.size(), Median().above));
    scan([&](std::size_t thread, std::size_t node, const Position& position) {
      const int side = medians_[node].compare(keyOf(axis_, position));
      if (side == 0 && medians_[node].digits < position_digits)
        found[thread].push_back({static_cast<std::uint32_t>(node), position});
      else if (side > 0)
        take(above[thread][node], axis_, position);
    });
    std::vector<Candidate> mine;
    for (auto& part : found)
      mine.insert(mine.end(), part.begin(), part.end());
    std::vector<Candidate> candidates = gatherItems(ranks_, mine);
    for (std::size_t thread = 1; thread < threads_; ++thread)
      for (std::size_t node = 0; node < medians_.size(); ++node)
        take(above[0][node], axis_, above[thread][node]);
    takeAbove(above[0]);
    for (Median& median : medians_)
      if (median.digits == position_digits)
        median.below = positionOf(axis_, median.prefix);
    choose(candidates);
  }

  /** The least position of all processes above each median. Each process compares
   * those of some nodes, so that nobody gets what all have of all nodes. */
  void
  takeAbove(const std::vector<Position>& mine)
  {
    const std::size_t nodes = medians_.size();
    const auto share = [&](std::size_t rank) { return nodes * rank / ranks_.size(); };
    std::vector<Bytes> messages(ranks_.size());
    for (std::size_t rank = 0; rank < ranks_.size(); ++rank) {
      ByteWriter writer(messages[rank]);
      for (std::size_t node = share(rank); node < share(rank + 1); ++node)
        if (mine[node][axis_] < infinity)
          writer.put(Candidate{static_cast<std::uint32_t>(node), mine[node]});
    }
    const std::size_t first = share(ranks_.rank());
    std::vector<Position> least(share(ranks_.rank() + 1) - first, Median().above);
    for (const Bytes& bytes : ranks_.exchange(std::move(messages)))
      for (ByteReader reader(bytes); !reader.atEnd();) {
        const auto found = reader.get<Candidate>();
        take(least[found.node - first], axis_, found.position);
      }
    const std::vector<Position> next = gatherItems(ranks_, least);
    for (std::size_t node = 0; node < nodes; ++node)
      take(medians_[node].above, axis_, next[node]);
  }

  void
  choose(std::vector<Candidate>& candidates)
  {
    std::sort(candidates.begin(),
              candidates.end(),
              [axis = axis_](const Candidate& a, const Candidate& b) {
                if (a.node != b.node)
                  return a.node < b.node;
                return lessAlong(axis, a.position, b.position);
              });
    for (std::size_t begin = 0; begin < candidates.size();) {
      const std::uint32_t node = candidates[begin].node;
      std::size_t end = begin;
      while (end < candidates.size() && candidates[end].node == node)
        ++end;
      Median& median = medians_[node];
      median.below = candidates[begin + median.rank].position;
      if (begin + median.rank + 1 < end)
        median.above = candidates[begin + median.rank + 1].position;
      begin = end;
    }
  }

  /** The node of a sample, which is remembered from depth to depth. */
  std::size_t
  findNode(std::size_t sample, const Position& position) const
  {
    if (nodes_.empty())
      return nodeOf(position, depth_, axes_, planes_);
    std::uint32_t& node = nodes_[sample];
    if (node < medians_.size()) // at the depth above
      node = static_cast<std::uint32_t>(childOf(
          node, position, axes_[static_cast<std::size_t>(depth_ - 1)], planes_));
    return node;
  }

  /** Call visit(thread, node from the first of the depth, position) for all samples of
   * this process. */
  template <typename Visit>
  void
  scan(const Visit& visit) const
  {
    const std::size_t first = medians_.size();
    std::size_t passed = 0;
    scan_([&](const Position* positions, std::size_t count) {
      parallelBlocks(threads_, 1, threads_, [&](std::size_t thread, std::size_t) {
        for (std::size_t begin = thread * block_samples; begin < count;
             begin += threads_ * block_samples)
          for (std::size_t i = begin; i < std::min(begin + block_samples, count); ++i)
            visit(thread, findNode(passed + i, positions[i]) - first, positions[i]);
      });
      passed += count;
    });
  }

  const PositionScan& scan_;
  RankGroup& ranks_;
  std::size_t threads_;
  int depth_, axis_;
  const AxisCycle& axes_;
  const std::vector<PlaneKey>& planes_;
  std::vector<std::uint32_t>& nodes_; // by sample, or empty
  std::uint64_t few_;
  std::vector<Median> medians_;
};

} // namespace

std::array<bool, 3>
MedianSearch::findExtent()
{
  std::vector<Position> extent{{{infinity, infinity, infinity}},
                               {{-infinity, -infinity, -infinity}}};
  const auto extend = [&](const Position& low, const Position& high) {
    for (int axis = 0; axis < 3; ++axis) {
      extent[0][axis] = std::min(extent[0][axis], low[axis]);
      extent[1][axis] = std::max(extent[1][axis], high[axis]);
    }
  };
  std::vector<std::uint64_t> count{0};
  scan_([&](const Position* positions, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      extend(positions[i], positions[i]);
    count[0] += size;
  });
  if (count[0] <= most_remembered)
    nodes_.assign(static_cast<std::size_t>(count[0]), 1);
  ranks_.sum(count);
  count_ = count[0];
  const std::vector<Position> extents = gatherItems(ranks_, extent);
  for (std::size_t i = 0; i < extents.size(); i += 2)
    extend(extents[i], extents[i + 1]);
  std::array<bool, 3> differs;
  for (int axis = 0; axis < 3; ++axis)
    differs[static_cast<std::size_t>(axis)] = extent[0][axis] < extent[1][axis];
  return differs;
}

void
MedianSearch::findMedians(int depth,
                          const AxisCycle& axes,
                          std::vector<PlaneKey>& planes)
{
  Level level(scan_, ranks_, threads_, depth, axes, planes, nodes_);
  const auto& medians = level.find();
  const int axis = axes[static_cast<std::size_t>(depth)];
  for (std::size_t node = 0; node < medians.size(); ++node) {
    const Position &below = medians[node].below, &above = medians[node].above;
    const double middle = 0.5 * (static_cast<double>(below[axis]) + above[axis]);
    planes[medians.size() + node] = {static_cast<float>(middle), below};
  }
}

} // namespace pcl_uvol
