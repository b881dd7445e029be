// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/point_tree.h"

#include "common/constants.h"
#include "common/parallel.h"
#include "multivariate/point_order.h"

#include <algorithm>
#include <utility>

namespace pcl_uvol {

namespace {

/** Queries of a block of a parallel loop. */
constexpr std::size_t block_queries = 1u << 10;

std::size_t
blocksOf(std::size_t items)
{
  return (items + PointTree::lanes - 1) / PointTree::lanes;
}

} // namespace

PointTree::PointTree(const std::vector<float>& values,
                     std::size_t columns,
                     unsigned threads)
    : columns_(columns)
{
  PointOrder order = orderPoints(values, columns, lanes, threads);
  points_ = std::move(order.points);
  addPoints(order.rows);
  while (levels_.back().items > lanes)
    addBoxes(threads);
}

void
PointTree::addPoints(const std::vector<float>& rows)
{
  Level level{size(), {}, {}};
  level.low.assign(blocksOf(level.items) * columns_ * lanes, infinity<float>);
  for (std::size_t i = 0; i < level.items; ++i)
    for (std::size_t axis = 0; axis < columns_; ++axis)
      level.low[(i / lanes * columns_ + axis) * lanes + i % lanes] =
          rows[i * columns_ + axis];
  levels_.push_back(std::move(level));
}

void
PointTree::addBoxes(unsigned threads)
{
  const Level& below = levels_.back();
  const std::vector<float>& below_high = below.high.empty() ? below.low : below.high;
  Level level{blocksOf(below.items), {}, {}};
  level.low.assign(blocksOf(level.items) * columns_ * lanes, infinity<float>);
  level.high = level.low;
  parallelBlocks(level.items, block_queries, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t axis = 0; axis < columns_; ++axis) {
        const std::size_t children = (i * columns_ + axis) * lanes;
        const std::size_t used = std::min(lanes, below.items - i * lanes);
        const std::size_t item = (i / lanes * columns_ + axis) * lanes + i % lanes;
        level.low[item] =
            *std::min_element(&below.low[children], &below.low[children] + used);
        level.high[item] =
            *std::max_element(&below_high[children], &below_high[children] + used);
      }
  });
  levels_.push_back(std::move(level));
}

void
PointTree::copyItem(const std::vector<float>& level,
                    std::size_t item,
                    float* coordinates) const
{
  for (std::size_t axis = 0; axis < columns_; ++axis)
    coordinates[axis] = level[(item / lanes * columns_ + axis) * lanes + item % lanes];
}

/** Points and boxes are summed up in the same order of the axes: rounding is monotone,
 * so that no point is found nearer than its box. */
inline PointTree::Lanes<float>
PointTree::measureBlock(std::size_t level, std::size_t block, const Query& query) const
{
  Lanes<float> sq_dists{};
  const float* low = &levels_[level].low[block * columns_ * lanes];
  if (level == 0 && query.low == query.high) {
    for (std::size_t axis = 0; axis < columns_; ++axis, low += lanes)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const float difference = low[lane] - query.low[axis];
        sq_dists[lane] += difference * difference;
      }
    return sq_dists;
  }
  const std::vector<float>& highs = level == 0 ? levels_[0].low : levels_[level].high;
  const float* high = &highs[block * columns_ * lanes];
  for (std::size_t axis = 0; axis < columns_; ++axis, low += lanes, high += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const float beyond =
          std::max(low[lane] - query.high[axis], query.low[axis] - high[lane]);
      const float difference = std::max(beyond, 0.0f);
      sq_dists[lane] += difference * difference;
    }
  return sq_dists;
}

template <typename Visitor>
void
PointTree::visitBlock(std::size_t level,
                      std::size_t block,
                      const Query& query,
                      Visitor& visitor) const
{
  const Lanes<float> sq_dists = measureBlock(level, block, query);
  const std::size_t first = block * lanes;
  const std::size_t used = std::min(lanes, levels_[level].items - first);
  if (level == 0) {
    for (std::size_t lane = 0; lane < used; ++lane)
      if (visitor.reaches(0, first + lane, sq_dists[lane]))
        visitor.accept(first + lane, sq_dists[lane]);
    return;
  }
  Lanes<std::uint8_t> order;
  std::size_t reached = 0;
  for (std::size_t lane = 0; lane < used; ++lane) {
    if (!visitor.reaches(level, first + lane, sq_dists[lane]))
      continue;
    std::size_t rank = reached++;
    for (; rank > 0 && sq_dists[lane] < sq_dists[order[rank - 1]]; --rank)
      order[rank] = order[rank - 1];
    order[rank] = static_cast<std::uint8_t>(lane);
  }
  for (std::size_t i = 0; i < reached; ++i) {
    const std::size_t item = first + order[i];
    if (i == 0 || visitor.reaches(level, item, sq_dists[order[i]]))
      visitBlock(level - 1, item, query, visitor);
  }
}

namespace {

/** Keeps the nearest points but the one asked for. */
struct NearestVisitor {
  std::size_t self;
  std::size_t count;
  std::uint32_t* places;
  float* sq_dists;
  std::size_t found = 0;
  float sq_reach = infinity<float>;

  bool
  reaches(std::size_t, std::size_t, float sq_dist) const
  {
    return sq_dist < sq_reach;
  }

  void
  accept(std::size_t place, float sq_dist)
  {
    if (place == self)
      return;
    std::size_t rank = found < count ? found++ : count - 1;
    for (; rank > 0 && sq_dist < sq_dists[rank - 1]; --rank) {
      sq_dists[rank] = sq_dists[rank - 1];
      places[rank] = places[rank - 1];
    }
    sq_dists[rank] = sq_dist;
    places[rank] = static_cast<std::uint32_t>(place);
    if (found == count)
      sq_reach = sq_dists[count - 1];
  }
};

} // namespace

NearestPlaces
PointTree::findNearest(std::size_t count, unsigned threads, StepTimer& step) const
{
  NearestPlaces nearest{count, {}, {}};
  if (count == 0)
    return nearest;
  nearest.places.resize(size() * count);
  nearest.sq_dists.resize(size() * count);
  parallelBlocks(size(), block_queries, threads, [&](auto begin, auto end) {
    std::vector<float> query(columns_);
    for (std::size_t i = begin; i < end; ++i) {
      copyLow(0, i, query.data());
      NearestVisitor visitor{
          i, count, &nearest.places[i * count], &nearest.sq_dists[i * count]};
      visit({query.data(), query.data()}, visitor);
    }
    step.advance(end - begin);
  });
  return nearest;
}

OutsideSearch::OutsideSearch(const PointTree& tree, const std::vector<float>& sq_cores)
    : tree_(tree)
    , sq_cores_(sq_cores)
    , least_sq_cores_(tree.levels())
    , shared_components_(tree.levels())
{
  for (std::size_t level = 1; level < tree.levels(); ++level) {
    const std::vector<float>& below =
        level == 1 ? sq_cores_ : least_sq_cores_[level - 1];
    std::vector<float>& least = least_sq_cores_[level];
    least.assign(tree.items(level), infinity<float>);
    for (std::size_t i = 0; i < below.size(); ++i) {
      float& box = least[i / PointTree::lanes];
      box = std::min(box, below[i]);
    }
  }
}

void
OutsideSearch::setComponents(const std::vector<std::uint32_t>& components)
{
  components_ = &components;
  for (std::size_t level = 1; level < tree_.levels(); ++level) {
    const std::vector<std::uint32_t>& below =
        level == 1 ? components : shared_components_[level - 1];
    std::vector<std::uint32_t>& shared = shared_components_[level];
    shared.resize(tree_.items(level));
    for (std::size_t i = 0; i < below.size(); ++i) {
      std::uint32_t& box = shared[i / PointTree::lanes];
      if (i % PointTree::lanes == 0)
        box = below[i];
      else if (box != below[i])
        box = none;
    }
  }
}

/** The order of visits depends on distances only: of equally near points the first one
 * is kept, which no bound that is at least as large hides. */
struct OutsideSearch::FindVisitor {
  const OutsideSearch& search;
  std::uint32_t own;
  float sq_core;
  std::atomic<float>& sq_bound;
  Found found;

  float
  leastWeight(std::size_t level, std::size_t item, float sq_dist) const
  {
    return std::max(std::max(sq_dist, sq_core), search.leastCore(level, item));
  }

  bool
  reaches(std::size_t level, std::size_t item, float sq_dist) const
  {
    if (search.isOf(own, level, item))
      return false;
    const float least = leastWeight(level, item, sq_dist);
    return least < found.sq_weight && least <= sq_bound.load(std::memory_order_relaxed);
  }

  void
  accept(std::size_t place, float sq_dist)
  {
    found = {static_cast<std::uint32_t>(place), leastWeight(0, place, sq_dist)};
    lowerTo(sq_bound, found.sq_weight);
  }
};

OutsideSearch::Found
OutsideSearch::find(std::size_t place,
                    const PointTree::Query& query,
                    std::atomic<float>& sq_bound) const
{
  FindVisitor visitor{
      *this, (*components_)[place], sq_cores_[place], sq_bound, Found()};
  tree_.visit(query, visitor);
  return visitor.found;
}

/** Ends with the first point that is near enough. */
struct OutsideSearch::ReachVisitor {
  const OutsideSearch& search;
  std::uint32_t own;
  float sq_core;
  const std::atomic<float>& sq_bound;
  bool is_reached = false;

  bool
  reaches(std::size_t level, std::size_t item, float sq_dist) const
  {
    return !is_reached && !search.isOf(own, level, item) &&
           std::max(std::max(sq_dist, sq_core), search.leastCore(level, item)) <=
               sq_bound.load(std::memory_order_relaxed);
  }

  void
  accept(std::size_t, float)
  {
    is_reached = true;
  }
};

bool
OutsideSearch::mayReach(std::size_t level,
                        std::size_t item,
                        const PointTree::Query& query,
                        const std::atomic<float>& sq_bound) const
{
  ReachVisitor visitor{
      *this, sharedComponent(level, item), leastCore(level, item), sq_bound};
  tree_.visit(query, visitor);
  return visitor.is_reached;
}

} // namespace pcl_uvol
