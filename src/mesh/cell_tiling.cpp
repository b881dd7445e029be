// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_tiling.h"

#include "common/constants.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pcl_uvol::detail {

namespace {

/** Cells that are kept: with their bounds they stay within a core's own memory. A power
 * of two, since cells are kept by the last bits of their numbers. */
constexpr std::uint32_t kept_cells = 1u << 10;

CellBound
outerBound(bool is_high)
{
  return {{is_high ? infinity<float> : -infinity<float>, 0}, {0, 0, 0, 0}};
}

bool
isOuter(const CellBound& bound)
{
  return bound.node.number == 0;
}

bool
areSame(const CellBound& a, const CellBound& b)
{
  return a.node.number == b.node.number && a.plane.coordinate == b.plane.coordinate;
}

TileCell
unboundedCell()
{
  TileCell cell;
  cell.low.fill(outerBound(false));
  cell.high.fill(outerBound(true));
  return cell;
}

} // namespace

CellCache::CellCache(const CellTiling& tiling)
    : tiling_(tiling)
    , numbers_(kept_cells, std::numeric_limits<std::uint32_t>::max())
    , cells_(kept_cells)
{
}

TileCell
CellCache::find(std::uint32_t cell)
{
  const std::size_t place = cell % kept_cells;
  if (numbers_[place] != cell) {
    cells_[place] = tiling_.findCell(cell);
    numbers_[place] = cell;
  }
  return cells_[place];
}

CellTiling::CellTiling(const KdTree& tree, const std::vector<Position>& positions)
    : tree_(tree)
    , positions_(positions)
{
}

TileCell
CellTiling::findCell(std::uint32_t cell) const
{
  TileCell found = unboundedCell();
  if (isGhost(cell)) {
    const std::uint32_t side = cell - countSamples();
    const bool is_high = side % 2 == 1;
    found.low[side / 2] = found.high[side / 2] = outerBound(is_high);
    return found;
  }
  for (KdNode node = tree_.getRoot(); !node.isLeaf();)
    node = descend(node, cell, found);
  return found;
}

KdBox
CellTiling::findBox(std::uint32_t sample, const TileCell& cell) const
{
  KdBox box = tree_.getBox(tree_.getRoot());
  bool is_bounded = true;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (!isOuter(cell.low[a]))
      box.low[axis] = cell.low[a].plane.coordinate;
    if (!isOuter(cell.high[a]))
      box.high[axis] = cell.high[a].plane.coordinate;
    is_bounded = is_bounded && !isOuter(cell.low[a]) && !isOuter(cell.high[a]);
  }
  if (is_bounded)
    return box;
  const float longest = longestSideAround(sample);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const float place = positions_[sample][axis];
    if (isOuter(cell.low[a]) && !isOuter(cell.high[a]))
      box.low[axis] =
          std::max(box.low[axis], std::min(place, box.high[axis] - longest));
    if (isOuter(cell.high[a]) && !isOuter(cell.low[a]))
      box.high[axis] =
          std::min(box.high[axis], std::max(place, box.low[axis] + longest));
  }
  return box;
}

float
CellTiling::longestSideAround(std::uint32_t sample) const
{
  // A single cell may be thin; this many are about two cells wide along every axis.
  constexpr std::uint32_t group = 8;
  // In longest sides of the group between planes: the tree leaves no side of a cell
  // longer, but where the samples end.
  constexpr float longest_side = 3.0f;
  TileCell cell = unboundedCell();
  KdNode node = tree_.getRoot();
  while (node.count >= 2 * group)
    node = descend(node, sample, cell);
  float longest = 0.0f;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!isOuter(cell.low[axis]) && !isOuter(cell.high[axis]))
      longest = std::max(
          longest, cell.high[axis].plane.coordinate - cell.low[axis].plane.coordinate);
  return longest > 0.0f ? longest_side * longest : infinity<float>;
}

KdNode
CellTiling::descend(const KdNode& node, std::uint32_t sample, TileCell& cell) const
{
  const auto axis = static_cast<std::size_t>(tree_.getAxis(node));
  const KdNode left = node.left();
  const bool is_below = sample < left.begin + left.count;
  (is_below ? cell.high : cell.low)[axis] = {tree_.getPlane(node), node};
  return is_below ? left : node.right();
}

std::uint32_t
CellTiling::locate(int axis,
                   const CellBound& bound,
                   bool is_above,
                   const CornerPlanes& corner) const
{
  if (isOuter(bound))
    return getGhost(axis, is_above);
  KdNode node = is_above ? bound.node.right() : bound.node.left();
  while (!node.isLeaf()) {
    // Next to the bound, and beside the corner's other planes, none of which cuts the
    // cells on this side once more.
    const int split = tree_.getAxis(node);
    const bool is_left = split == axis
                             ? is_above
                             : KdTree::isBelow(positions_,
                                               split,
                                               corner[static_cast<std::size_t>(split)],
                                               tree_.getPlane(node));
    node = is_left ? node.left() : node.right();
  }
  return node.begin;
}

void
CellTiling::findRing(std::uint32_t a,
                     std::uint32_t b,
                     CellCache& cache,
                     std::vector<std::uint32_t>& ring) const
{
  TileCell lower = cache.find(a), upper = cache.find(b);
  std::size_t x = 0;
  while (!areSame(lower.high[x], upper.low[x]) && !areSame(upper.high[x], lower.low[x]))
    ++x;
  // Seen from the other side the ring runs the other way round.
  const bool is_reversed = !areSame(lower.high[x], upper.low[x]);
  if (is_reversed)
    std::swap(lower, upper);
  const std::size_t u = (x + 1) % 3, v = (x + 2) % 3;
  const auto least = [&](std::size_t m) {
    return isBelow(static_cast<int>(m), lower.high[m], upper.high[m]) ? lower.high[m]
                                                                      : upper.high[m];
  };
  const auto greatest = [&](std::size_t m) {
    return isBelow(static_cast<int>(m), lower.low[m], upper.low[m]) ? upper.low[m]
                                                                    : lower.low[m];
  };

  CornerPlanes corner;
  corner[x] = lower.high[x].plane;
  corner[u] = least(u).plane;
  corner[v] = least(v).plane;
  ring.clear();
  ring.push_back(locate(static_cast<int>(u), least(u), true, corner));
  // Round the rectangle that the cells share, from its corner high in u and v.
  const std::pair<std::size_t, bool> sides[] = {
      {v, false}, {u, false}, {v, true}, {u, true}};
  for (const auto& [m, is_up] : sides) {
    const int axis = static_cast<int>(m);
    const CellBound end = is_up ? least(m) : greatest(m);
    for (bool is_inside = true; is_inside;) {
      const TileCell last = cache.find(ring.back());
      const CellBound& bound = is_up ? last.high[m] : last.low[m];
      is_inside = is_up ? isBelow(axis, bound, end) : isBelow(axis, end, bound);
      ring.push_back(locate(axis, is_inside ? bound : end, is_up, corner));
    }
    corner[m] = end.plane;
  }
  ring.pop_back(); // it is the first one
  if (is_reversed)
    std::reverse(ring.begin(), ring.end());
}

} // namespace pcl_uvol::detail
