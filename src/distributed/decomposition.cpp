// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/decomposition.h"

#include "common/constants.h"
#include "distributed/byte_stream.h"
#include "distributed/median_search.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

namespace pcl_uvol {

namespace {

bool
isBelow(int axis, const PlaneKey& a, const PlaneKey& b)
{
  if (a.coordinate != b.coordinate)
    return a.coordinate < b.coordinate;
  return lessAlong(axis, a.below, b.below);
}

} // namespace

CellKey
CellKey::unbounded()
{
  CellKey cell;
  cell.low.fill({-infinity<float>, {}});
  cell.high.fill({infinity<float>, {}});
  return cell;
}

bool
CellKey::touches(const CellKey& other) const
{
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (isBelow(axis, high[i], other.low[i]) || isBelow(axis, other.high[i], low[i]))
      return false;
  }
  return true;
}

bool
CellKey::meets(const Ball& ball) const
{
  const double radius = ball.radius;
  if (std::isinf(radius))
    return true;
  double lowest[3], highest[3]; // of the part of the cell beside the ball, seen from it
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double x = ball.center[axis], reach = radius * ball.extent[i];
    lowest[axis] = std::max(low[i].coordinate - x, -reach);
    highest[axis] = std::min(high[i].coordinate - x, reach);
    if (lowest[axis] > highest[axis])
      return false;
  }
  double sq_dist = 0.0;
  for (const auto& row : ball.metric) {
    double least = 0.0, most = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at_lowest = row[axis] * lowest[axis],
                   at_highest = row[axis] * highest[axis];
      least += std::min(at_lowest, at_highest);
      most += std::max(at_lowest, at_highest);
    }
    const double offset = std::max({least, -most, 0.0});
    sq_dist += offset * offset;
  }
  return sq_dist <= radius * radius;
}

std::vector<Ball>
CellKey::selectMeeting(const std::vector<Ball>& balls) const
{
  std::vector<Ball> meeting;
  std::copy_if(balls.begin(),
               balls.end(),
               std::back_inserter(meeting),
               [this](const Ball& ball) { return meets(ball); });
  return meeting;
}

bool
CellKey::contains(const Ball& ball) const
{
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double x = ball.center[axis], reach = ball.radius * ball.extent[i];
    if (!(x - reach > low[i].coordinate && x + reach < high[i].coordinate))
      return false;
  }
  return true;
}

Decomposition::Decomposition(int levels)
    : levels_(levels)
{
  if (levels < 0 || levels > most_levels)
    throw InvalidArgument("bad_levels_of_pieces",
                          {{"levels", levels}, {"most", most_levels}});
  planes_.resize(size());
}

void
Decomposition::findPlanes(MedianSearch& search)
{
  for (int depth = 0; depth < levels_; ++depth)
    search.findMedians(depth, axes_, planes_);
  begins_.push_back(0);
  for (std::size_t piece = 0; piece < size(); ++piece)
    begins_.push_back(begins_.back() + search.getCounts()[size() + piece]);
}

Decomposition::Decomposition(const PositionSource& positions,
                             int levels,
                             Communicator& communicator,
                             unsigned threads)
    : Decomposition(levels)
{
  MedianSearch search(positions, levels, communicator, threads);
  axes_ = KdTree::cycleOver(search.getExtent());
  const std::uint64_t total = search.getCounts()[1];
  if (total < size())
    throw InvalidArgument("more_pieces_than_samples",
                          {{"samples", total}, {"pieces", size()}});
  findPlanes(search);
}

Decomposition::Decomposition(const Decomposition& top,
                             std::size_t piece,
                             const PositionSource& positions,
                             int levels,
                             Communicator& communicator,
                             unsigned threads)
    : Decomposition(levels)
{
  std::copy(top.axes_.begin() + top.levels_, top.axes_.end(), axes_.begin());
  MedianSearch search(positions, levels, communicator, threads);
  const std::uint64_t total = search.getCounts()[1];
  if (total != top.getCount(piece))
    throw InvalidArgument("piece_of_other_samples",
                          {{"samples", top.getCount(piece)}, {"held", total}});
  findPlanes(search);
}

Decomposition::Decomposition(const Decomposition& top,
                             const Decomposition& subtree,
                             bool reports,
                             Communicator& communicator)
    : Decomposition(top.levels_ + subtree.levels_)
{
  axes_ = top.axes_;
  std::copy(top.planes_.begin(), top.planes_.end(), planes_.begin());
  Bytes message;
  if (reports) {
    ByteWriter writer(message);
    writer.put(subtree.planes_);
    writer.put(subtree.begins_);
  }
  std::size_t piece = 0;
  for (const Bytes& bytes : communicator.allGather(message))
    for (ByteReader reader(bytes); !reader.atEnd(); ++piece) {
      std::vector<PlaneKey> planes;
      std::vector<std::uint64_t> begins;
      reader.get(planes);
      reader.get(begins);
      for (std::size_t first = 1; first < subtree.size(); first *= 2)
        std::copy_n(planes.begin() + static_cast<std::ptrdiff_t>(first),
                    first,
                    planes_.begin() +
                        static_cast<std::ptrdiff_t>((top.size() + piece) * first));
      for (std::size_t i = 0; i < subtree.size(); ++i)
        begins_.push_back(top.getBegin(piece) + begins[i]);
    }
  begins_.push_back(top.getSampleCount());
}

Decomposition::Decomposition(
    const Decomposition& top,
    int levels,
    const std::function<PlaneKey(std::size_t piece, std::size_t node)>& plane_of)
    : levels_(levels)
    , axes_(top.axes_)
    , planes_(top.planes_)
{
  for (int depth = top.levels_; depth < levels; ++depth)
    for (std::size_t piece = 0; piece < top.size(); ++piece) {
      const std::size_t nodes = std::size_t(1) << (depth - top.levels_);
      for (std::size_t node = nodes; node < 2 * nodes; ++node)
        planes_.push_back(plane_of(piece, node));
    }
  begins_ = top.begins_;
  for (int depth = top.levels_; depth < levels; ++depth) {
    std::vector<std::uint64_t> halves;
    for (std::size_t i = 0; i + 1 < begins_.size(); ++i) {
      const std::uint64_t count = begins_[i + 1] - begins_[i];
      halves.push_back(begins_[i]);
      halves.push_back(begins_[i] + (count + 1) / 2); // the left half takes the odd one
    }
    halves.push_back(begins_.back());
    begins_ = std::move(halves);
  }
}

CellKey
Decomposition::getCell(std::size_t piece) const
{
  CellKey cell = CellKey::unbounded();
  for (int depth = 0; depth < levels_; ++depth) {
    const std::size_t node = (size() + piece) >> (levels_ - depth);
    const std::size_t axis = axisAt(axes_, depth);
    const bool is_right = (piece >> (levels_ - 1 - depth) & 1) != 0;
    (is_right ? cell.low : cell.high)[axis] = planes_[node];
  }
  return cell;
}

void
Decomposition::findPieces(
    const std::vector<Ball>& balls,
    const std::function<void(std::size_t piece, const std::vector<Ball>&)>& found) const
{
  const std::function<void(std::size_t, int, CellKey&, const std::vector<Ball>&)>
      visit = [&](std::size_t node,
                  int depth,
                  CellKey& cell,
                  const std::vector<Ball>& above) {
        const std::vector<Ball> meeting = cell.selectMeeting(above);
        if (meeting.empty())
          return;
        if (depth == levels_) {
          found(node - size(), meeting);
          return;
        }
        const std::size_t axis = axisAt(axes_, depth);
        const PlaneKey low = cell.low[axis], high = cell.high[axis];
        cell.high[axis] = planes_[node];
        visit(2 * node, depth + 1, cell, meeting);
        cell.high[axis] = high;
        cell.low[axis] = planes_[node];
        visit(2 * node + 1, depth + 1, cell, meeting);
        cell.low[axis] = low;
      };
  CellKey cell = CellKey::unbounded();
  visit(1, 0, cell, balls);
}

std::size_t
Decomposition::findPiece(const Position& position) const
{
  return findNode(position, levels_, axes_, planes_) - size();
}

} // namespace pcl_uvol
