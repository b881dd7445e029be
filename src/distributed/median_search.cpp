// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/median_search.h"

#include "common/constants.h"
#include "common/parallel.h"
#include "common/random.h"
#include "distributed/bernoulli_sampler.h"
#include "distributed/byte_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr Position below_all{{-infinity<float>, -infinity<float>, -infinity<float>}};
constexpr Position above_all{{infinity<float>, infinity<float>, infinity<float>}};

/** Positions that are drawn: per n^(2/3) of n samples, at most 32 MB of them or as many
 * per node. As many are left between the bounds of some ten medians, so that these take
 * one pass. */
constexpr double drawn_rate = 8.0;
constexpr double most_drawn = 1u << 21;
constexpr double most_drawn_per_node = 256.0;

/** Positions that a process keeps from one pass to the next at most: 25 MB. */
constexpr std::size_t most_kept_of_all = 1u << 21;

/** A median lies farther from that of s drawn positions, in sqrt(s) of these, once in
 * 2000 nodes: 3.5 standard deviations. */
constexpr double bound_distance = 1.75;

/** Samples that a thread takes at once. */
constexpr std::size_t median_block = 1u << 14;

/** Call visit(thread, index, position) for all samples of this process. */
template <typename Visit>
void
forEachSample(const PositionSource& source, std::size_t threads, const Visit& visit)
{
  const auto work = [&](std::size_t thread, std::size_t) {
    std::vector<Position> buffer(median_block);
    for (std::uint64_t begin = thread * median_block; begin < source.count;
         begin += threads * median_block) {
      const std::size_t count =
          std::min<std::uint64_t>(source.count - begin, median_block);
      const Position* const positions = source.read(begin, count, buffer.data());
      for (std::size_t i = 0; i < count; ++i)
        visit(thread, begin + i, positions[i]);
    }
  };
  parallelBlocks(threads, 1, static_cast<unsigned>(threads), work);
}

std::vector<NodePosition>
gather(Communicator& communicator, std::vector<std::vector<NodePosition>>&& parts)
{
  for (std::size_t thread = 1; thread < parts.size(); ++thread) {
    parts[0].insert(parts[0].end(), parts[thread].begin(), parts[thread].end());
    parts[thread] = {};
  }
  return allGatherItems(communicator, parts[0]);
}

/** The position before another one in the order along an axis; none lies between them.
 */
Position
before(int axis, Position position)
{
  float& last = position[(axis + 2) % 3];
  last = std::nextafter(last, -infinity<float>);
  return position;
}

bool
isSame(const Position& a, const Position& b)
{
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/** The median of a node: it lies above low and not above high. */
struct Median {
  std::uint64_t rank = 0; ///< among all samples of the node
  bool is_found = false;
  Position low = below_all, high = above_all;
  std::uint64_t up_to_low = 0; ///< samples
  std::uint64_t up_to_high = 0;

  /** Bounds within, for the next pass; once it is found, nothing lies between them. */
  Position lower = above_all, upper = above_all;
  bool is_one = false; ///< position between them

  Position below = above_all, above = above_all; ///< the median, and the next position
  std::uint64_t up_to_median = 0;                ///< samples

  void
  find(Position median, Position next, std::uint64_t up_to)
  {
    is_found = true;
    lower = upper = above_all;
    below = median;
    above = next;
    up_to_median = up_to;
  }
};

/** What a pass finds in a node; threads write their own at each sample. */
struct alignas(64) Tally {
  std::uint64_t up_to_lower = 0, between = 0; ///< samples
  Position above_upper = above_all;           ///< the least
};

void
take(Position& least, int axis, const Position& position)
{
  if (lessAlong(axis, position, least))
    least = position;
}

/** The medians of one depth. */
class Level {
public:
  using Iterator = std::vector<NodePosition>::iterator;

  /** \param counts of samples, by node from the first one of the depth */
  Level(const PositionSource& source,
        Communicator& communicator,
        unsigned threads,
        std::uint64_t drawn_limit,
        int depth,
        const AxisCycle& axes,
        const std::vector<PlaneKey>& planes,
        const std::uint64_t* counts)
      : source_(source)
      , communicator_(communicator)
      , threads_(resolveThreads(threads))
      , drawn_limit_(drawn_limit)
      , depth_(depth)
      , axis_(static_cast<int>(axisAt(axes, depth)))
      , axes_(axes)
      , planes_(planes)
      , medians_(std::size_t(1) << depth)
  {
    for (std::size_t node = 0; node < medians_.size(); ++node) {
      Median& median = medians_[node];
      median.rank = counts[node] == 0 ? 0 : (counts[node] + 1) / 2 - 1;
      median.up_to_high = counts[node];
      median.is_found = counts[node] == 0;
    }
  }

  /** \param drawn some positions of each node, or all */
  const std::vector<Median>&
  find(std::vector<NodePosition> drawn, bool all_drawn)
  {
    const auto is_found = [](const Median& median) { return median.is_found; };
    if (all_drawn)
      forEachNode(drawn, [&](Median& median, Iterator begin, Iterator end) {
        choose(median, begin, end, 0, above_all);
      });
    while (!std::all_of(medians_.begin(), medians_.end(), is_found))
      drawn = narrow(std::move(drawn));
    return medians_;
  }

private:
  /** Order positions by node, and call visit for each node that is not found. */
  template <typename Visit>
  void
  forEachNode(std::vector<NodePosition>& positions, const Visit& visit)
  {
    // No total order, but of those of a node only ranks matter.
    const auto by_node = [](const auto& a, const auto& b) { return a.node < b.node; };
    if (!std::is_sorted(positions.begin(), positions.end(), by_node))
      parallelSort(
          positions.begin(), positions.end(), static_cast<unsigned>(threads_), by_node);
    auto begin = positions.begin();
    for (std::size_t node = 0; node < medians_.size(); ++node) {
      auto end = std::find_if(
          begin, positions.end(), [&](const auto& p) { return p.node != node; });
      if (!medians_[node].is_found)
        visit(medians_[node], begin, end);
      begin = end;
    }
  }

  /** One pass.
   * \return positions that were drawn, for the next one */
  std::vector<NodePosition>
  narrow(std::vector<NodePosition>&& drawn)
  {
    double expected = 0.0;
    forEachNode(drawn, [&](Median& median, Iterator begin, Iterator end) {
      expected += setBounds(median, begin, end);
    });
    const BernoulliSampler sampler(
        expected, drawn_limit_, communicator_.rank(), ++pass_);
    std::vector<NodePosition> between;
    const std::vector<Tally> tallies = tally(sampler, between);
    // What was drawn before and lies beyond the bounds is known.
    const auto is_beyond = [&](const NodePosition& p) {
      const Median& median = medians_[p.node];
      const Tally& found = tallies[p.node];
      if (median.is_found)
        return false;
      return median.rank < found.up_to_lower
                 ? !lessAlong(axis_, median.lower, p.position)
                 : median.rank >= found.up_to_lower + found.between &&
                       lessAlong(axis_, median.upper, p.position);
    };
    drawn.erase(std::remove_if(drawn.begin(),
                               drawn.end(),
                               [&](const auto& p) { return !is_beyond(p); }),
                drawn.end());
    bool is_missed = false;
    forEachNode(between, [&](Median& median, Iterator begin, Iterator end) {
      const Tally& found = tallies[static_cast<std::size_t>(&median - medians_.data())];
      const std::uint64_t up_to_upper = found.up_to_lower + found.between;
      if (median.is_one && found.up_to_lower == median.up_to_high)
        // Only where denormal numbers count as 0: nothing lies before the position.
        median.find(median.upper, found.above_upper, found.up_to_lower);
      else if (median.rank < found.up_to_lower) {
        median.high = median.lower;
        median.up_to_high = found.up_to_lower;
        is_missed = true;
      }
      else if (median.rank >= up_to_upper) {
        median.low = median.upper;
        median.up_to_low = up_to_upper;
        is_missed = true;
      }
      else if (median.is_one)
        median.find(median.upper, found.above_upper, up_to_upper);
      else if (sampler.takesAll())
        choose(median, begin, end, found.up_to_lower, found.above_upper);
      else {
        median.low = median.lower;
        median.up_to_low = found.up_to_lower;
        median.high = median.upper;
        median.up_to_high = up_to_upper;
        drawn.insert(drawn.end(), begin, end);
      }
    });
    are_kept_ = are_kept_ && !is_missed;
    return std::move(drawn);
  }

  /** Bounds between which the median lies, as the positions drawn have it.
   * \return samples expected there */
  double
  setBounds(Median& median, Iterator begin, Iterator end)
  {
    const auto less = [this](const NodePosition& a, const NodePosition& b) {
      return lessAlong(axis_, a.position, b.position);
    };
    const auto samples = static_cast<double>(median.up_to_high - median.up_to_low);
    median.lower = median.low;
    median.upper = median.high;
    median.is_one = false;
    if (begin == end)
      return samples;
    const auto drawn = static_cast<double>(end - begin);
    const double middle =
        static_cast<double>(median.rank - median.up_to_low) * (drawn - 1.0) / samples;
    const double distance =
        std::min(bound_distance * std::sqrt(drawn), (drawn - 1.0) / 4.0);
    const double first = std::floor(middle - distance),
                 last = std::ceil(middle + distance);
    const auto drawn_at = [&](double rank) {
      const auto at = begin + static_cast<std::ptrdiff_t>(rank);
      std::nth_element(begin, at, end, less);
      return at->position;
    };
    if (first >= 0.0)
      median.lower = drawn_at(first);
    Position last_drawn = median.high;
    if (last < drawn) {
      last_drawn = drawn_at(last);
      median.upper = before(axis_, last_drawn);
    }
    if (!lessAlong(axis_, median.lower, median.upper)) {
      // Many equal samples, say, which no bounds part.
      median.is_one = true;
      median.upper = last_drawn;
      median.lower = before(axis_, last_drawn);
      return 0.0;
    }
    return samples * std::min((last - first) / drawn, 1.0);
  }

  /** Count the samples below and between the bounds: all of this process, or, where
   * they were kept, those that lie between the bounds of the pass before.
   * \param between gets positions that lie between the bounds, as they are sampled */
  std::vector<Tally>
  tally(const BernoulliSampler& sampler, std::vector<NodePosition>& between)
  {
    const std::size_t nodes = medians_.size();
    std::vector<std::vector<Tally>> tallies(threads_, std::vector<Tally>(nodes));
    if (are_kept_)
      tallies[0] = beyond_;
    std::vector<std::vector<NodePosition>> chosen(threads_);
    std::vector<std::vector<Position>> kept(threads_);
    const std::size_t most_kept = most_kept_of_all / threads_;
    const auto count = [&](auto thread, auto index, const Position& position) {
      const std::size_t node = findNode(position, depth_, axes_, planes_) - nodes;
      const Median& median = medians_[node];
      Tally& found = tallies[thread][node];
      // Nearly all samples are counted here, without a branch that depends on them.
      const bool is_above = lessAlong(axis_, median.lower, position);
      found.up_to_lower += static_cast<std::uint64_t>(!is_above);
      if (!(is_above & lessAlong(axis_, position, found.above_upper)))
        return;
      if (lessAlong(axis_, median.upper, position)) {
        found.above_upper = position;
        return;
      }
      ++found.between;
      if (median.is_one)
        return;
      if (kept[thread].size() <= most_kept)
        kept[thread].push_back(position);
      if (sampler.takes(index))
        chosen[thread].push_back({static_cast<std::uint32_t>(node), position});
    };
    const auto read_kept = [this](std::uint64_t begin, std::size_t, Position*) {
      return kept_.data() + begin;
    };
    if (are_kept_)
      forEachSample({kept_.size(), read_kept}, threads_, count);
    else
      forEachSample(source_, threads_, count);
    are_kept_ = true;
    kept_.clear();
    for (const auto& part : kept) {
      are_kept_ = are_kept_ && part.size() <= most_kept;
      kept_.insert(kept_.end(), part.begin(), part.end());
    }
    between = gather(communicator_, std::move(chosen));
    return add(tallies);
  }

  /** The sum over all threads and processes. */
  std::vector<Tally>
  add(std::vector<std::vector<Tally>>& tallies)
  {
    std::vector<Tally>& all = tallies[0];
    for (std::size_t thread = 1; thread < threads_; ++thread)
      for (std::size_t node = 0; node < all.size(); ++node) {
        all[node].up_to_lower += tallies[thread][node].up_to_lower;
        all[node].between += tallies[thread][node].between;
        take(all[node].above_upper, axis_, tallies[thread][node].above_upper);
      }
    beyond_ = all;
    for (Tally& tally : beyond_)
      tally.between = 0;
    std::vector<std::uint64_t> counts;
    for (const Tally& tally : all) {
      counts.push_back(tally.up_to_lower);
      counts.push_back(tally.between);
    }
    communicator_.allReduce(counts);
    for (std::size_t node = 0; node < all.size(); ++node) {
      all[node].up_to_lower = counts[2 * node];
      all[node].between = counts[2 * node + 1];
    }
    takeLeast(all);
    return std::move(all);
  }

  /** The least positions of all processes. Each process compares those of some nodes,
   * so that nobody gets what all have of all nodes. */
  void
  takeLeast(std::vector<Tally>& mine) const
  {
    const std::size_t nodes = mine.size();
    const auto share = [&](std::size_t rank) {
      return nodes * rank / communicator_.size();
    };
    std::vector<Bytes> messages(communicator_.size());
    for (std::size_t rank = 0; rank < communicator_.size(); ++rank) {
      ByteWriter writer(messages[rank]);
      for (std::size_t node = share(rank); node < share(rank + 1); ++node)
        if (mine[node].above_upper[axis_] < infinity<float>)
          writer.put(
              NodePosition{static_cast<std::uint32_t>(node), mine[node].above_upper});
    }
    const std::size_t first = share(communicator_.rank());
    std::vector<Position> least(share(communicator_.rank() + 1) - first, above_all);
    for (const Bytes& bytes : communicator_.allToAll(std::move(messages)))
      for (ByteReader reader(bytes); !reader.atEnd();) {
        const auto found = reader.get<NodePosition>();
        take(least[found.node - first], axis_, found.position);
      }
    const std::vector<Position> all = allGatherItems(communicator_, least);
    for (std::size_t node = 0; node < nodes; ++node)
      mine[node].above_upper = all[node];
  }

  /** Find the median among all positions between its bounds.
   * \param up_to_lower samples
   * \param above_upper the least position there */
  void
  choose(Median& median,
         Iterator begin,
         Iterator end,
         std::uint64_t up_to_lower,
         const Position& above_upper) const
  {
    const auto at = begin + static_cast<std::ptrdiff_t>(median.rank - up_to_lower);
    std::nth_element(begin, at, end, [this](const auto& a, const auto& b) {
      return lessAlong(axis_, a.position, b.position);
    });
    Position next = above_upper;
    std::uint64_t up_to_median =
        up_to_lower + static_cast<std::uint64_t>(at - begin) + 1;
    for (auto other = at + 1; other != end; ++other)
      if (isSame(other->position, at->position))
        ++up_to_median;
      else
        take(next, axis_, other->position);
    median.find(at->position, next, up_to_median);
  }

  const PositionSource& source_;
  Communicator& communicator_;
  std::size_t threads_;
  std::uint64_t drawn_limit_;
  int depth_, axis_;
  const AxisCycle& axes_;
  const std::vector<PlaneKey>& planes_;
  std::vector<Median> medians_;
  std::size_t pass_ = 0;

  /** Positions of this process between the bounds of the last pass, if they are few,
   * and what that pass found beyond: the next pass needs no more, unless a median lies
   * elsewhere. */
  std::vector<Position> kept_;
  std::vector<Tally> beyond_;
  bool are_kept_ = false;
};

} // namespace

MedianSearch::MedianSearch(const PositionSource& positions,
                           int levels,
                           Communicator& communicator,
                           unsigned threads)
    : positions_(positions)
    , communicator_(communicator)
    , threads_(resolveThreads(threads))
    , counts_{0, positions.count}
{
  communicator_.allReduce(counts_);
  const auto total = static_cast<double>(counts_[1]);
  const double side = std::cbrt(total);
  drawn_limit_ = static_cast<std::uint64_t>(
      std::min(drawn_rate * side * side,
               std::max(most_drawn, most_drawn_per_node * std::ldexp(1.0, levels))));
  const BernoulliSampler sampler(total, drawn_limit_, communicator_.rank(), 0);
  all_drawn_ = sampler.takesAll();

  struct alignas(64) Extent {
    Position low = above_all, high = below_all;

    void
    add(const Extent& other)
    {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], other.low[axis]);
        high[axis] = std::max(high[axis], other.high[axis]);
      }
    }
  };
  std::vector<Extent> extents(threads_);
  std::vector<std::vector<NodePosition>> chosen(threads_);
  forEachSample(
      positions_, threads_, [&](auto thread, auto index, const Position& position) {
        extents[thread].add({position, position});
        if (sampler.takes(index))
          chosen[thread].push_back({0, position});
      });
  drawn_ = gather(communicator_, std::move(chosen));
  Extent all;
  for (const Extent& extent : allGatherItems(communicator_, extents))
    all.add(extent);
  for (int axis = 0; axis < 3; ++axis)
    extent_[static_cast<std::size_t>(axis)] = all.low[axis] < all.high[axis];
}

void
MedianSearch::findMedians(int depth,
                          const AxisCycle& axes,
                          std::vector<PlaneKey>& planes)
{
  const std::size_t nodes = std::size_t(1) << depth;
  Level level(positions_,
              communicator_,
              threads_,
              drawn_limit_,
              depth,
              axes,
              planes,
              counts_.data() + nodes);
  const auto axis = static_cast<int>(axisAt(axes, depth));
  const auto& medians = level.find(drawn_, all_drawn_);
  for (std::size_t node = 0; node < nodes; ++node) {
    const Position &below = medians[node].below, &above = medians[node].above;
    const double middle = 0.5 * (static_cast<double>(below[axis]) + above[axis]);
    planes[nodes + node] = {static_cast<float>(middle), below};
    counts_.push_back(medians[node].up_to_median);
    counts_.push_back(counts_[nodes + node] - medians[node].up_to_median);
  }
  for (auto begin = drawn_.begin(); begin != drawn_.end();) {
    const std::uint32_t node = begin->node;
    auto end = begin;
    for (; end != drawn_.end() && end->node == node; ++end)
      end->node = static_cast<std::uint32_t>(
          findChild(nodes + node, end->position, axis, planes) - 2 * nodes);
    std::partition(
        begin, end, [&](const NodePosition& p) { return p.node == 2 * node; });
    begin = end;
  }
}

} // namespace pcl_uvol
