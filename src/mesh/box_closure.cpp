// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/box_closure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

namespace {

/** Share of a side: vertices in a face are no farther from it, in files that keep six
 * digits as well. */
constexpr double face_tolerance = 2e-6;

} // namespace

BoxClosure::BoxClosure(const PeriodicBox& box, std::size_t pieces)
    : box_(box)
    , is_cut_(pieces)
    , has_corner_(pieces)
    , face_areas_(pieces)
    , edge_lengths_(pieces)
{
}

bool
BoxClosure::addRim(std::size_t piece,
                   const std::vector<Eigen::Vector3d>& places,
                   std::uint32_t from,
                   std::uint32_t to,
                   const Eigen::Vector3d& bulge)
{
  constexpr unsigned high_y = 2u << 2, high_z = 2u << 4;
  const Eigen::Vector3d &begin = places[from], &end = places[to];
  const unsigned at_begin = findFaces(begin), at_end = findFaces(end);
  if ((at_begin & at_end) == 0)
    return false;
  is_cut_[piece] = 1;
  if ((at_begin & at_end & high_z) == 0)
    return true;
  const auto number = static_cast<std::int32_t>(piece);
  rims_.push_back({from, to, number});
  // The border of the inner part of the face runs against the edge of the triangle.
  const Eigen::Vector3d along = begin - end;
  face_areas_[piece] += -(0.5 * (begin[1] + end[1]) - box_.low[1]) * along[0] +
                        2.0 / 3.0 * (bulge[0] * along[1] - bulge[1] * along[0]);
  if ((at_begin & high_y) != 0) {
    points_.push_back({from, number, 1});
    edge_lengths_[piece] += begin[0] - box_.low[0];
  }
  if ((at_end & high_y) != 0) {
    points_.push_back({to, number, -1});
    edge_lengths_[piece] -= end[0] - box_.low[0];
  }
  return true;
}

unsigned
BoxClosure::findFaces(const Eigen::Vector3d& place) const
{
  unsigned bits = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double side = box_.sides[axis],
                 from_low = place[static_cast<int>(axis)] - box_.low[axis];
    if (!(side > 0.0))
      continue;
    const double near = face_tolerance * (side + std::abs(box_.low[axis]));
    bits |= (std::abs(from_low) <= near          ? 1u
             : std::abs(from_low - side) <= near ? 2u
                                                 : 0u)
            << 2 * axis;
  }
  return bits;
}

double
BoxClosure::findVolume(std::size_t piece, double below, double flux)
{
  const double face = face_areas_[piece] + box_.sides[1] * edge_lengths_[piece],
               without = below - box_.low[2] * flux + box_.sides[2] * face,
               with = without + getBoxVolume();
  const bool has_corner = std::abs(with) < std::abs(without);
  has_corner_[piece] = has_corner ? 1 : 0;
  return has_corner ? with : without;
}

void
BoxClosure::renumber(const std::vector<std::int32_t>& number)
{
  const std::vector<char> is_cut = is_cut_, has_corner = has_corner_;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0)
      continue;
    is_cut_[static_cast<std::size_t>(number[i])] = is_cut[i];
    has_corner_[static_cast<std::size_t>(number[i])] = has_corner[i];
  }
  const auto left = number.size() - static_cast<std::size_t>(
                                        std::count(number.begin(), number.end(), -1));
  is_cut_.resize(left);
  has_corner_.resize(left);
  const auto renumberAll = [&](auto& list) {
    for (auto& item : list)
      item.piece = number[static_cast<std::size_t>(item.piece)];
    list.erase(std::remove_if(list.begin(),
                              list.end(),
                              [](const auto& item) { return item.piece < 0; }),
               list.end());
  };
  renumberAll(rims_);
  renumberAll(points_);
}

std::size_t
BoxClosure::columnOf(double x) const
{
  const double column = (x - columns_low_) * columns_per_length_;
  return static_cast<std::size_t>(
      std::clamp(column, 0.0, static_cast<double>(begins_.size() - 2)));
}

void
BoxClosure::prepare(const std::vector<Eigen::Vector3d>& places)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const RimEdge& rim : rims_)
    for (const std::uint32_t end : {rim.from, rim.to}) {
      low = std::min(low, places[end][0]);
      high = std::max(high, places[end][0]);
    }
  const std::size_t columns = std::max<std::size_t>(rims_.size(), 1);
  columns_low_ = low;
  columns_per_length_ = high > low ? static_cast<double>(columns) / (high - low) : 0.0;
  begins_.assign(columns + 1, 0);
  const auto forColumns = [&](const RimEdge& rim, const auto& visit) {
    const auto [a, b] =
        std::minmax({columnOf(places[rim.from][0]), columnOf(places[rim.to][0])});
    for (std::size_t column = a; column <= b; ++column)
      visit(column);
  };
  for (const RimEdge& rim : rims_)
    forColumns(rim, [&](std::size_t column) { ++begins_[column + 1]; });
  for (std::size_t i = 0; i < columns; ++i)
    begins_[i + 1] += begins_[i];
  members_.resize(begins_.back());
  std::vector<std::size_t> ends(begins_.begin(), begins_.end() - 1);
  for (std::uint32_t i = 0; i < rims_.size(); ++i)
    forColumns(rims_[i], [&](std::size_t column) { members_[ends[column]++] = i; });
}

void
BoxClosure::addTurns(const std::vector<Eigen::Vector3d>& places,
                     const Eigen::Vector3d& place,
                     std::vector<Winding>& found) const
{
  if (!rims_.empty()) {
    const std::size_t column = columnOf(place[0]);
    for (std::size_t i = begins_[column]; i < begins_[column + 1]; ++i) {
      const RimEdge& rim = rims_[members_[i]];
      detail::addTurns(
          rim.piece, crossingBehind(places, rim.to, rim.from, place), found);
    }
  }
  for (const EdgePoint& point : points_)
    if (!(places[point.vertex][0] <= place[0]))
      detail::addTurns(point.piece, point.turns, found);
  for (std::size_t piece = 0; piece < has_corner_.size(); ++piece)
    if (has_corner_[piece] != 0)
      detail::addTurns(static_cast<std::int32_t>(piece), 1, found);
}

} // namespace pcl_uvol::detail
