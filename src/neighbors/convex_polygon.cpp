// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/convex_polygon.h"

#include <algorithm>
#include <cstdint>

namespace pcl_uvol::detail {

namespace {

/** Room for vertices: faces of random samples have five. */
constexpr std::size_t usual_room = 32;

} // namespace

void
ConvexPolygon::start(double half_side)
{
  count_ = 4;
  for (std::vector<double>* const numbers : {&x_, &y_, &heights_, &next_x_, &next_y_})
    if (numbers->size() < usual_room)
      numbers->resize(usual_room);
  const double x[] = {-half_side, half_side, half_side, -half_side},
               y[] = {-half_side, -half_side, half_side, half_side};
  std::copy_n(x, count_, x_.begin());
  std::copy_n(y, count_, y_.begin());
  sq_reach_ = 2.0 * half_side * half_side;
}

bool
ConvexPolygon::cut(double a, double b, double c, double tolerance)
{
  // Most lines pass by the circle about the origin that holds all vertices.
  const double sq_most = (a * a + b * b) * sq_reach_;
  if (c >= 0.0 && c * c >= sq_most)
    return false;
  const std::size_t count = count_;
  std::uint64_t out = 0; // a bit per vertex
  bool is_cut = false;
  for (std::size_t i = 0; i < count; ++i) {
    heights_[i] = a * x_[i] + b * y_[i] - c;
    const bool is_out = heights_[i] > tolerance;
    out |= std::uint64_t{is_out} << (i % 64);
    is_cut |= is_out;
  }
  if (!is_cut)
    return false;
  if (2 * count > x_.size()) // a convex polygon gets one vertex more at most
    for (std::vector<double>* const numbers : {&x_, &y_, &heights_, &next_x_, &next_y_})
      numbers->resize(4 * count);
  sq_reach_ = 0.0;
  if (count <= 64) {
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
    const std::uint64_t before = ((out << 1) | (out >> (count - 1))) & all;
    const std::uint64_t ends = out & ~before, begins = before & ~out;
    if (out == all) {
      count_ = 0;
      return true;
    }
    if ((ends & (ends - 1)) == 0) {
      keepRun(static_cast<std::size_t>(__builtin_ctzll(begins)),
              static_cast<std::size_t>(__builtin_ctzll(ends)));
      return true;
    }
  }
  keepRuns(tolerance);
  return true;
}

void
ConvexPolygon::addCrossing(std::size_t from, std::size_t to, std::size_t& kept)
{
  const double part =
      std::clamp(heights_[from] / (heights_[from] - heights_[to]), 0.0, 1.0);
  next_x_[kept] = x_[from] + part * (x_[to] - x_[from]);
  next_y_[kept++] = y_[from] + part * (y_[to] - y_[from]);
}

void
ConvexPolygon::keepRun(std::size_t first, std::size_t end)
{
  std::size_t kept = 0;
  for (std::size_t i = first; i != end; i = i + 1 < count_ ? i + 1 : 0) {
    next_x_[kept] = x_[i];
    next_y_[kept++] = y_[i];
  }
  addCrossing((end > 0 ? end : count_) - 1, end, kept);
  addCrossing((first > 0 ? first : count_) - 1, first, kept);
  finishCut(kept);
}

void
ConvexPolygon::keepRuns(double tolerance)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t next = i + 1 < count_ ? i + 1 : 0;
    const bool is_out = heights_[i] > tolerance;
    if (!is_out) {
      next_x_[kept] = x_[i];
      next_y_[kept++] = y_[i];
    }
    if (is_out != (heights_[next] > tolerance))
      addCrossing(i, next, kept);
  }
  finishCut(kept);
}

void
ConvexPolygon::finishCut(std::size_t kept)
{
  count_ = kept;
  x_.swap(next_x_);
  y_.swap(next_y_);
  double sq_reach = 0.0;
  for (std::size_t i = 0; i < count_; ++i)
    sq_reach = std::max(sq_reach, x_[i] * x_[i] + y_[i] * y_[i]);
  sq_reach_ = sq_reach;
}

PolygonMoments
ConvexPolygon::computeMoments() const
{
  if (count_ == 0)
    return {0.0, Eigen::Vector2d::Zero()};
  const Eigen::Vector2d first(x_[0], y_[0]);
  double twice_area = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = 2; i < count_; ++i) {
    const Eigen::Vector2d a = (*this)[i - 1] - first, b = (*this)[i] - first;
    const double twice = a.x() * b.y() - a.y() * b.x();
    twice_area += twice;
    moment += twice * (a + b) / 3.0;
  }
  if (!(twice_area > 0.0))
    return {0.0, first};
  return {0.5 * twice_area, first + moment / twice_area};
}

} // namespace pcl_uvol::detail
