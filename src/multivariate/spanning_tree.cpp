// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/spanning_tree.h"

#include "common/constants.h"
#include "common/parallel.h"
#include "multivariate/point_tree.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <tuple>

namespace pcl_uvol {

namespace {

constexpr std::uint32_t no_point = OutsideSearch::none;

/** Places of a block of a parallel loop. */
constexpr std::size_t block_places = 1u << 10;

/** Nearest points that are looked up at least: the more, the fewer searches in the
 * rounds to come. */
constexpr std::size_t fewest_neighbors = 8;

/** Level of the boxes, of 256 points, that a search starts from. */
constexpr std::size_t group_level = 2;

/** An edge between places. */
struct Candidate {
  float sq_weight = infinity<float>;
  std::uint32_t a = no_point, b = no_point;

  bool
  operator<(const Candidate& other) const
  {
    return std::tie(sq_weight, a, b) < std::tie(other.sq_weight, other.a, other.b);
  }
};

/** Boruvka's method: components get their shortest edges to others, round by round.
 * Large components wait while there are smaller ones to join: their points lie close
 * together and far from the others, where searches take longest. Edges of equal weight
 * close no cycle, since edges are added in the order of their weights and only between
 * what is still apart. */
class SpanningForest {
public:
  SpanningForest(const PointTree& tree,
                 const NearestPlaces& nearest,
                 const std::vector<float>& sq_cores,
                 unsigned threads)
      : tree_(tree)
      , nearest_(nearest)
      , sq_cores_(sq_cores)
      , threads_(threads)
      , search_(tree, sq_cores)
      , parents_(tree.size())
      , components_(tree.size())
      , sizes_(tree.size())
      , outside_(tree.size(), {no_point, 0.0f})
      , sq_bounds_(new std::atomic<float>[tree.size()])
  {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  std::vector<Candidate>
  grow(std::size_t columns, StepTimer& step)
  {
    std::vector<Candidate> edges;
    edges.reserve(tree_.size() - 1);
    while (edges.size() + 1 < tree_.size()) {
      labelComponents();
      recallOutside();
      searchOutside(columns);
      const std::size_t before = edges.size();
      join(shortestPerComponent(), edges);
      step.advance(edges.size() - before);
    }
    return edges;
  }

private:
  std::uint32_t
  findRoot(std::uint32_t place)
  {
    while (parents_[place] != place)
      place = parents_[place] = parents_[parents_[place]];
    return place;
  }

  void
  labelComponents()
  {
    std::fill(sizes_.begin(), sizes_.end(), 0u);
    for (std::uint32_t i = 0; i < components_.size(); ++i) {
      components_[i] = findRoot(i);
      ++sizes_[components_[i]];
      sq_bounds_[i].store(infinity<float>, std::memory_order_relaxed);
    }
    search_.setComponents(components_);
    std::vector<std::uint32_t> sizes;
    std::copy_if(sizes_.begin(),
                 sizes_.end(),
                 std::back_inserter(sizes),
                 [](std::uint32_t size) { return size > 0; });
    const auto median =
        sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) / 2);
    std::nth_element(sizes.begin(), median, sizes.end());
    largest_size_ = *median;
  }

  bool
  isWaiting(std::size_t i) const
  {
    return sizes_[components_[i]] > largest_size_;
  }

  float
  sqWeight(std::size_t i, std::uint32_t j, float sq_dist) const
  {
    return std::max(sq_dist, std::max(sq_cores_[i], sq_cores_[j]));
  }

  /** The nearest outside point among the listed ones, if none beyond them is nearer;
   * else how far at least it is. */
  OutsideSearch::Found
  findListed(std::size_t i) const
  {
    OutsideSearch::Found best;
    const std::size_t first = i * nearest_.per_place;
    const std::size_t end = first + nearest_.per_place;
    for (std::size_t l = first; l < end; ++l) {
      const std::uint32_t j = nearest_.places[l];
      const float sq_weight = sqWeight(i, j, nearest_.sq_dists[l]);
      if (components_[j] != components_[i] && sq_weight < best.sq_weight)
        best = {j, sq_weight};
    }
    const float sq_reach = nearest_.sq_dists[end - 1];
    if (best.sq_weight <= sq_reach)
      return best;
    return {no_point, std::max(sq_reach, outside_[i].sq_weight)};
  }

  /** What is known from the lists, and from former rounds: components only grow, so
   * that a nearest outside point remains one while it is outside, and its distance
   * never falls. */
  void
  recallOutside()
  {
    parallelBlocks(tree_.size(), block_places, threads_, [&](auto begin, auto end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (isWaiting(i))
          continue;
        OutsideSearch::Found& found = outside_[i];
        if (found.place == no_point || components_[found.place] == components_[i]) {
          found.place = no_point;
          if (found.sq_weight <= nearest_.sq_dists[(i + 1) * nearest_.per_place - 1])
            found = findListed(i);
        }
        if (found.place != no_point)
          lowerTo(sq_bounds_[components_[i]], found.sq_weight);
      }
    });
  }

  /** Search for the points that could be nearer to the outside than the others of their
   * component. */
  void
  searchOutside(std::size_t columns)
  {
    const std::size_t level = std::min(group_level, tree_.levels() - 1);
    parallelBlocks(tree_.items(level), 1, threads_, [&](auto begin, auto) {
      std::vector<float> corners(2 * columns);
      searchFrom(level, begin, corners.data(), corners.data() + columns);
    });
  }

  bool
  needsSearch(std::size_t i) const
  {
    return !isWaiting(i) && outside_[i].place == no_point &&
           outside_[i].sq_weight <=
               sq_bounds_[components_[i]].load(std::memory_order_relaxed);
  }

  /** Points that lie together deep inside their component are done at once.
   * \param low, high room for the corners of a box */
  void
  searchFrom(std::size_t level, std::size_t item, float* low, float* high)
  {
    if (level == 0) {
      if (needsSearch(item))
        searchFromPoint(item, low);
      return;
    }
    std::size_t span = 1;
    for (std::size_t l = 0; l < level; ++l)
      span *= PointTree::lanes;
    const std::size_t first = item * span;
    const std::size_t end = std::min(first + span, tree_.size());
    std::size_t i = first;
    while (i < end && !needsSearch(i))
      ++i;
    if (i == end)
      return;
    const std::uint32_t component = search_.sharedComponent(level, item);
    if (component != no_point) {
      tree_.copyLow(level, item, low);
      tree_.copyHigh(level, item, high);
      if (!search_.mayReach(level, item, {low, high}, sq_bounds_[component])) {
        for (; i < end; ++i)
          raiseLeast(outside_[i], component);
        return;
      }
    }
    const std::size_t children =
        std::min((item + 1) * PointTree::lanes, tree_.items(level - 1));
    for (std::size_t child = item * PointTree::lanes; child < children; ++child)
      searchFrom(level - 1, child, low, high);
  }

  void
  searchFromPoint(std::size_t i, float* coordinates)
  {
    tree_.copyLow(0, i, coordinates);
    std::atomic<float>& sq_bound = sq_bounds_[components_[i]];
    const auto found = search_.find(i, {coordinates, coordinates}, sq_bound);
    // Beyond the bound there may be nearer ones that were not looked at.
    if (found.sq_weight <= sq_bound.load(std::memory_order_relaxed))
      outside_[i] = found;
    else
      raiseLeast(outside_[i], components_[i]);
  }

  /** Nothing outside is nearer than the bound of the component. */
  void
  raiseLeast(OutsideSearch::Found& known, std::uint32_t component) const
  {
    if (known.place == no_point)
      known.sq_weight = std::max(known.sq_weight,
                                 sq_bounds_[component].load(std::memory_order_relaxed));
  }

  std::vector<Candidate>
  shortestPerComponent() const
  {
    std::vector<Candidate> shortest(tree_.size());
    for (std::uint32_t i = 0; i < tree_.size(); ++i) {
      const OutsideSearch::Found& found = outside_[i];
      if (isWaiting(i) || found.place == no_point)
        continue;
      Candidate& best = shortest[components_[i]];
      best = std::min(
          best, {found.sq_weight, std::min(i, found.place), std::max(i, found.place)});
    }
    shortest.erase(std::remove_if(shortest.begin(),
                                  shortest.end(),
                                  [](const Candidate& c) { return c.a == no_point; }),
                   shortest.end());
    return shortest;
  }

  void
  join(std::vector<Candidate> candidates, std::vector<Candidate>& edges)
  {
    parallelSort(candidates.begin(), candidates.end(), threads_, std::less<>());
    for (const Candidate& candidate : candidates) {
      const std::uint32_t a = findRoot(candidate.a), b = findRoot(candidate.b);
      if (a == b)
        continue;
      parents_[std::max(a, b)] = std::min(a, b);
      edges.push_back(candidate);
    }
  }

  const PointTree& tree_;
  const NearestPlaces& nearest_;
  const std::vector<float>& sq_cores_;
  unsigned threads_;
  OutsideSearch search_;
  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> components_; // the lowest place of each
  std::vector<std::uint32_t> sizes_;      // per component, else 0
  std::uint32_t largest_size_ = 0;        // of the components that do not wait
  /** Per place the nearest outside point; without one, how far at least it is. */
  std::vector<OutsideSearch::Found> outside_;
  std::unique_ptr<std::atomic<float>[]> sq_bounds_; // per component
};

void
checkValues(const std::vector<float>& values, std::size_t columns)
{
  if (columns == 0 || values.size() % columns != 0)
    throw InvalidArgument("spanning_tree_without_rows",
                          {{"values", values.size()}, {"columns", columns}});
  if (values.size() / columns > std::numeric_limits<std::int32_t>::max())
    throw InvalidArgument("spanning_tree_too_large",
                          {{"points", values.size() / columns}});
  if (!std::all_of(values.begin(), values.end(), [](float value) {
        return std::isfinite(value);
      }))
    throw InvalidArgument("spanning_tree_not_finite", {});
}

std::vector<double>
measureExtents(const std::vector<float>& values, std::size_t columns)
{
  std::vector<double> extents;
  for (std::size_t column = 0; column < columns; ++column) {
    float low = infinity<float>, high = -infinity<float>;
    for (std::size_t i = column; i < values.size(); i += columns) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    extents.push_back(static_cast<double>(high) - low);
  }
  return extents;
}

/** Brings the widest column's extent to 1/2 to 1 by a power of two, in place: squares
 * are then numbers in float whatever the units are. Columns without extent become 0,
 * since they may be beyond float then.
 * \return the exponent */
int
scale(std::vector<float>& values, std::size_t columns, unsigned threads)
{
  const std::vector<double> extents = measureExtents(values, columns);
  int exponent = 0;
  std::frexp(*std::max_element(extents.begin(), extents.end()), &exponent);
  const double factor = std::ldexp(1.0, -exponent);
  parallelBlocks(values.size(), block_places, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      values[i] =
          extents[i % columns] > 0.0 ? static_cast<float>(values[i] * factor) : 0.0f;
  });
  return exponent;
}

} // namespace

std::vector<SpanningEdge>
spanningTree(const std::vector<float>& values,
             std::size_t columns,
             std::size_t neighbors,
             unsigned threads,
             Report& report)
{
  checkValues(values, columns);
  const std::size_t count = values.size() / columns;
  if (count < 2)
    return {};
  const std::size_t reach = std::min(neighbors, count - 1);
  const std::size_t listed = std::min(std::max(reach, fewest_neighbors), count - 1);
  std::vector<float> scaled = values;
  const int exponent = scale(scaled, columns, threads);
  std::unique_ptr<const PointTree> tree;
  NearestPlaces nearest;
  std::vector<float> sq_cores(count, 0.0f);
  {
    StepTimer step(report, "neighbors", count);
    tree = std::make_unique<PointTree>(scaled, columns, threads);
    nearest = tree->findNearest(listed, threads, step);
    for (std::size_t i = 0; i < count && reach > 0; ++i)
      sq_cores[i] = nearest.sq_dists[i * listed + reach - 1];
  }
  StepTimer step(report, "spanning_tree", count - 1);
  const auto grown =
      SpanningForest(*tree, nearest, sq_cores, threads).grow(columns, step);
  std::vector<SpanningEdge> edges(grown.size());
  std::transform(grown.begin(), grown.end(), edges.begin(), [&](const Candidate& edge) {
    const std::uint32_t a = tree->getPoint(edge.a), b = tree->getPoint(edge.b);
    const double weight = std::sqrt(static_cast<double>(edge.sq_weight));
    return SpanningEdge{std::min(a, b), std::max(a, b), std::ldexp(weight, exponent)};
  });
  parallelSort(edges.begin(), edges.end(), threads, [](const auto& x, const auto& y) {
    return std::tie(x.weight, x.a, x.b) < std::tie(y.weight, y.a, y.b);
  });
  return edges;
}

double
longestSpanningEdge(const std::vector<Position>& positions,
                    unsigned threads,
                    Report& report)
{
  std::vector<float> values;
  values.reserve(3 * positions.size());
  for (const Position& position : positions)
    values.insert(values.end(), position.x, position.x + 3);
  const auto edges = spanningTree(values, 3, 0, threads, report);
  return edges.empty() ? 0.0 : edges.back().weight;
}

} // namespace pcl_uvol
