// SPDX-License-Identifier: BSD-3-Clause
#include "support/neighbor_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace uvol_test {

using pcl_uvol::Position;

NeighborOracle::NeighborOracle(std::vector<Position> positions)
    : positions_(std::move(positions))
{
  for (int axis = 0; axis < 3; ++axis)
    for (const Position& position : positions_)
      if (position[axis] != positions_.front()[axis]) {
        axes_.push_back(axis);
        break;
      }
  boxes_.resize(positions_.size());
  split(0, positions_.size(), 0, Box());
  rankPlanes();
}

void
NeighborOracle::split(std::size_t begin, std::size_t end, int depth, const Box& box)
{
  if (end - begin == 1) {
    boxes_[begin] = box;
    return;
  }
  const int axis = axes_[static_cast<std::size_t>(depth) % axes_.size()];
  std::sort(positions_.begin() + static_cast<std::ptrdiff_t>(begin),
            positions_.begin() + static_cast<std::ptrdiff_t>(end),
            [&](const Position& a, const Position& b) {
              for (int k = 0; k < 3; ++k)
                if (a[(axis + k) % 3] != b[(axis + k) % 3])
                  return a[(axis + k) % 3] < b[(axis + k) % 3];
              return false;
            });
  const std::size_t cut = begin + (end - begin + 1) / 2;
  const int plane = static_cast<int>(planes_.size());
  const double middle = (static_cast<double>(positions_[cut - 1][axis]) +
                         static_cast<double>(positions_[cut][axis])) /
                        2.0;
  planes_.push_back({static_cast<float>(middle), positions_[cut - 1]});
  plane_axes_.push_back(axis);
  Box left = box, right = box;
  left.high[axis] = right.low[axis] = plane;
  split(begin, cut, depth + 1, left);
  split(cut, end, depth + 1, right);
}

void
NeighborOracle::rankPlanes()
{
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<int> order;
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (plane_axes_[i] == axis)
        order.push_back(static_cast<int>(i));
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      const Plane& p = planes_[static_cast<std::size_t>(a)];
      const Plane& q = planes_[static_cast<std::size_t>(b)];
      if (p.coordinate != q.coordinate)
        return p.coordinate < q.coordinate;
      return pcl_uvol::lessAlong(axis, p.below, q.below);
    });
    std::vector<int> rank(planes_.size());
    for (std::size_t r = 0; r < order.size(); ++r)
      rank[static_cast<std::size_t>(order[r])] = static_cast<int>(r);
    for (Box& box : boxes_) {
      box.low[axis] = box.low[axis] < 0 ? std::numeric_limits<int>::min()
                                        : rank[static_cast<std::size_t>(box.low[axis])];
      box.high[axis] = box.high[axis] < 0
                           ? std::numeric_limits<int>::max()
                           : rank[static_cast<std::size_t>(box.high[axis])];
    }
  }
}

std::vector<std::uint32_t>
NeighborOracle::touching(std::uint32_t sample) const
{
  std::vector<std::uint32_t> found;
  const Box& a = boxes_[sample];
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    const Box& b = boxes_[i];
    bool touches = i != sample;
    for (int axis = 0; axis < 3; ++axis)
      touches = touches && a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis];
    if (touches)
      found.push_back(i);
  }
  return found;
}

std::vector<std::uint32_t>
NeighborOracle::neighbors(std::uint32_t sample,
                          pcl_uvol::AngleCriterion criterion) const
{
  const auto offset = [&](std::uint32_t i, int axis) {
    return static_cast<double>(positions_[i][axis]) - positions_[sample][axis];
  };
  const auto dot = [&](std::uint32_t i, std::uint32_t j) {
    return offset(i, 0) * offset(j, 0) + offset(i, 1) * offset(j, 1) +
           offset(i, 2) * offset(j, 2);
  };
  std::vector<std::uint32_t> order = touching(sample);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return dot(i, i) < dot(j, j);
  });
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::vector<std::uint32_t> closer(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(i));
    const auto& judges = criterion == pcl_uvol::AngleCriterion::Kept ? kept : closer;
    const bool hidden = std::any_of(judges.begin(), judges.end(), [&](std::uint32_t z) {
      const double d = dot(order[i], z);
      return d > 0.0 && 3.0 * d * d > dot(order[i], order[i]) * dot(z, z);
    });
    if (!hidden)
      kept.push_back(order[i]);
  }
  return kept;
}

std::set<std::pair<std::uint32_t, std::uint32_t>>
NeighborOracle::edges(const std::vector<float>& values,
                      float isovalue,
                      pcl_uvol::AngleCriterion criterion) const
{
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t x = 0; x < positions_.size(); ++x)
    for (const std::uint32_t y : neighbors(x, criterion))
      if ((values[x] >= isovalue) != (values[y] >= isovalue))
        found.emplace(std::min(x, y), std::max(x, y));
  return found;
}

} // namespace uvol_test
