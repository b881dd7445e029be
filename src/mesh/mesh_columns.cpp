// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_columns.h"

#include "mesh/box_closure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

/** Twice the area, in the plane of x and y, of a place and an edge: positive to the
 * left of it.
 * \param low, high its vertices in their order, so that it is the same for both
 * triangles of the edge */
double
sideOf(const std::vector<Eigen::Vector3d>& places,
       std::uint32_t low,
       std::uint32_t high,
       const Eigen::Vector3d& place)
{
  const Eigen::Vector3d &a = places[low], &b = places[high];
  return (b[0] - a[0]) * (place[1] - a[1]) - (b[1] - a[1]) * (place[0] - a[0]);
}

} // namespace

int
crossingBehind(const std::vector<Eigen::Vector3d>& places,
               std::uint32_t from,
               std::uint32_t to,
               const Eigen::Vector3d& place)
{
  const bool starts_left = places[from][0] <= place[0],
             ends_left = places[to][0] <= place[0];
  if (starts_left == ends_left)
    return 0;
  const double side = sideOf(places, std::min(from, to), std::max(from, to), place);
  const bool goes_right = starts_left == (from < to);
  if ((side < 0.0) != goes_right)
    return 0;
  return starts_left ? -1 : 1;
}

void
addTurns(std::int32_t piece, int turns, std::vector<Winding>& found)
{
  if (turns == 0)
    return;
  const auto at = std::lower_bound(
      found.begin(),
      found.end(),
      piece,
      [](const Winding& winding, std::int32_t other) { return winding.piece < other; });
  if (at != found.end() && at->piece == piece)
    at->turns += turns;
  else
    found.insert(at, {piece, turns});
}

MeshColumns::MeshColumns(const std::vector<Eigen::Vector3d>& places,
                         const std::vector<Triangle>& triangles,
                         const std::vector<std::int32_t>& piece_of,
                         const BoxClosure* closure)
    : places_(places)
    , triangles_(triangles)
    , piece_of_(piece_of)
    , closure_(closure)
{
  low_ = high_ = places.empty() ? Eigen::Vector3d::Zero().eval() : places.front();
  for (const Eigen::Vector3d& place : places) {
    low_ = low_.cwiseMin(place);
    high_ = high_.cwiseMax(place);
  }
  for (const Triangle& triangle : triangles)
    for (int axis = 0; axis < 3; ++axis) {
      const auto are_at = [&](double face) {
        return std::all_of(triangle.begin(), triangle.end(), [&](auto vertex) {
          return places[vertex][axis] == face;
        });
      };
      const auto face = static_cast<std::size_t>(axis);
      is_capped_low_[face] = is_capped_low_[face] || are_at(low_[axis]);
      is_capped_high_[face] = is_capped_high_[face] || are_at(high_[axis]);
    }
  const auto side = static_cast<std::size_t>(
      std::sqrt(static_cast<double>(std::max<std::size_t>(triangles.size(), 1))));
  columns_ = {side, side};
  begins_.assign(side * side + 1, 0);
  const auto forColumns = [&](const Triangle& triangle, const auto& visit) {
    const ColumnRange range = columnsOf(triangle);
    for (std::size_t y = range.low[1]; y <= range.high[1]; ++y)
      for (std::size_t x = range.low[0]; x <= range.high[0]; ++x)
        visit(y * side + x);
  };
  for (const Triangle& triangle : triangles)
    forColumns(triangle, [&](std::size_t column) { ++begins_[column + 1]; });
  for (std::size_t i = 0; i < side * side; ++i)
    begins_[i + 1] += begins_[i];
  members_.resize(begins_.back());
  std::vector<std::size_t> ends(begins_.begin(), begins_.end() - 1);
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    forColumns(triangles[i], [&](std::size_t column) { members_[ends[column]++] = i; });
}

std::size_t
MeshColumns::columnOf(int axis, double coordinate) const
{
  const double extent = high_[axis] - low_[axis];
  if (!(extent > 0.0))
    return 0;
  const std::size_t count = columns_[static_cast<std::size_t>(axis)];
  const double place = (coordinate - low_[axis]) / extent * static_cast<double>(count);
  return std::min(static_cast<std::size_t>(std::max(place, 0.0)), count - 1);
}

MeshColumns::ColumnRange
MeshColumns::columnsOf(const Triangle& triangle) const
{
  ColumnRange range{};
  for (int axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax({places_[triangle[0]][axis],
                                          places_[triangle[1]][axis],
                                          places_[triangle[2]][axis]});
    range.low[static_cast<std::size_t>(axis)] = columnOf(axis, low);
    range.high[static_cast<std::size_t>(axis)] = columnOf(axis, high);
  }
  return range;
}

/** 1 or -1 where a ray from a place upwards leaves or enters through a triangle. */
int
MeshColumns::crossingOf(const Triangle& triangle, const Eigen::Vector3d& place) const
{
  // Edges that pass behind the place, in the direction of y, from left to right.
  int turns = 0;
  for (std::size_t i = 0; i < 3; ++i)
    turns += crossingBehind(places_, triangle[i], triangle[(i + 1) % 3], place);
  if (turns == 0)
    return 0;
  const Eigen::Vector3d a = places_[triangle[0]] - place,
                        b = places_[triangle[1]] - place,
                        c = places_[triangle[2]] - place;
  // A place on the triangle is taken to be a little above it.
  const double height = a.dot(b.cross(c));
  return (turns > 0 ? height > 0.0 : height < 0.0) ? turns : 0;
}

/** Bring a place on a cap in a face of the mesh's box into the box: the outermost
 * samples of a lattice are there, which caps enclose. */
Eigen::Vector3d
MeshColumns::enterCaps(const Eigen::Vector3d& place) const
{
  constexpr double inwards = 1e-9; // in sides of the box
  Eigen::Vector3d inner = place;
  for (int axis = 0; axis < 3; ++axis) {
    const auto face = static_cast<std::size_t>(axis);
    const double step = inwards * (high_[axis] - low_[axis]);
    if (is_capped_low_[face] && place[axis] == low_[axis])
      inner[axis] += step;
    else if (is_capped_high_[face] && place[axis] == high_[axis])
      inner[axis] -= step;
  }
  return inner;
}

void
MeshColumns::addCrossings(const Eigen::Vector3d& place,
                          std::vector<Winding>& found) const
{
  // Rays from below the mesh leave closed pieces as often as they enter them.
  const bool is_beside = (place.array() < low_.array()).head(2).any() ||
                         (place.array() > high_.array()).any();
  if (is_beside || (closure_ == nullptr && place[2] < low_[2]))
    return;
  const std::size_t column =
      columnOf(1, place[1]) * columns_[0] + columnOf(0, place[0]);
  for (std::size_t i = begins_[column]; i < begins_[column + 1]; ++i) {
    const Triangle& triangle = triangles_[members_[i]];
    addTurns(piece_of_[triangle[0]], crossingOf(triangle, place), found);
  }
}

void
MeshColumns::findAround(const Eigen::Vector3d& place, std::vector<Winding>& found) const
{
  found.clear();
  if (!place.allFinite())
    return;
  const Eigen::Vector3d inner = enterCaps(place);
  addCrossings(inner, found);
  if (closure_ != nullptr)
    closure_->addTurns(places_, inner, found);
  found.erase(std::remove_if(found.begin(),
                             found.end(),
                             [](const Winding& winding) { return winding.turns == 0; }),
              found.end());
}

} // namespace pcl_uvol::detail
