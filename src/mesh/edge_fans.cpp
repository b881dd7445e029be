// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edge_fans.h"

#include "mesh/exact_signs.h"
#include "mesh/half_edges.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace pcl_uvol::detail {

namespace {

using Place = Eigen::Vector3d;

/** Directions around an edge, by the quarter that they lie in as seen from a first one
 * and by exact signs in it. */
class AngleOrder {
public:
  AngleOrder(const Place& from, const Place& to, const Place& first)
      : from_(from)
      , to_(to)
      , first_(first)
      , axis_(findVisibleAxis(from, to, first))
      , side_(signOfArea(from, to, first, axis_))
  {
  }

  bool
  isBefore(const Place& a, const Place& b) const
  {
    if (&a == &b) // a sign of zero takes whole numbers
      return false;
    const int of_a = quarterOf(a), of_b = quarterOf(b);
    return of_a != of_b ? of_a < of_b : signOfVolume(from_, to_, a, b) > 0;
  }

private:
  /** The first direction, beyond it, opposite to it, before it. */
  int
  quarterOf(const Place& tip) const
  {
    if (&tip == &first_)
      return 0;
    const int sign = signOfVolume(from_, to_, first_, tip);
    if (sign != 0)
      return sign > 0 ? 1 : 3;
    return signOfArea(from_, to_, tip, axis_) == side_ ? 0 : 2;
  }

  const Place &from_, &to_, &first_;
  int axis_, side_;
};

} // namespace

EdgeFans::EdgeFans(const std::vector<Place>& places,
                   const std::vector<Triangle>& triangles)
    : places_(places)
    , triangles_(triangles)
    , run_of_(3 * triangles.size())
{
  for (HalfEdge half_edge = 0; half_edge < run_of_.size(); ++half_edge) {
    const Triangle& triangle = triangles[half_edge / 3];
    sides_.push_back(
        {std::minmax(triangle[half_edge % 3], triangle[nextOf(half_edge) % 3]),
         half_edge});
  }
  std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
    return std::tie(a.edge, a.half_edge) < std::tie(b.edge, b.half_edge);
  });
  for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
    end = begin;
    while (end < sides_.size() && sides_[end].edge == sides_[begin].edge)
      ++end;
    findRuns(begin, end);
  }
}

const Place&
EdgeFans::tipOf(const Side& side) const
{
  return places_[triangles_[side.half_edge / 3][previousOf(side.half_edge) % 3]];
}

void
EdgeFans::findRuns(std::size_t begin, std::size_t end)
{
  // Of two at an edge, as in all good meshes, the angle is not asked for here.
  if (end - begin <= 2) {
    for (std::size_t i = begin; i < end; ++i)
      run_of_[sides_[i].half_edge] = {begin, end};
    return;
  }
  const auto& [from, to] = sides_[begin].edge;
  const AngleOrder order(places_[from], places_[to], tipOf(sides_[begin]));
  const auto isBefore = [&](const Side& a, const Side& b) {
    return order.isBefore(tipOf(a), tipOf(b));
  };
  const auto at = [&](std::size_t i) {
    return sides_.begin() + static_cast<std::ptrdiff_t>(i);
  };
  std::stable_sort(at(begin), at(end), isBefore);
  for (std::size_t first = begin, last = begin; first < end; first = last) {
    while (last < end && !isBefore(sides_[first], sides_[last]))
      ++last;
    for (std::size_t i = first; i < last; ++i)
      run_of_[sides_[i].half_edge] = {first, last};
  }
}

void
EdgeFans::findFolded(std::uint32_t triangle, std::vector<std::uint32_t>& found) const
{
  for (HalfEdge half_edge = 3 * triangle; half_edge < 3 * triangle + 3; ++half_edge)
    for (std::size_t i = run_of_[half_edge].first; i < run_of_[half_edge].second; ++i)
      if (const std::uint32_t other = sides_[i].half_edge / 3; other > triangle)
        found.push_back(other);
}

} // namespace pcl_uvol::detail
