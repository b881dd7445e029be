// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/voronoi_cell.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

/** Half the side of the cube that a cell starts as, in diagonals of the samples' box:
 * only cells next to the convex hull reach as far. */
constexpr double cube_size = 256.0;

/** Share of squared distances: rounding of vertices. */
constexpr double slack = 1e-11;

/** Share of the size of a cell: vertices that close to a plane lie on it. */
constexpr double smallest_height = 1e-14;

} // namespace

CellPlane::CellPlane(const Vector3d& of_any_length, double limit)
    : normal(of_any_length.normalized())
    , first(normal.unitOrthogonal())
    , second(normal.cross(first))
    , height(limit / of_any_length.norm())
{
}

VoronoiCellFinder::VoronoiCellFinder(const SampleSet& samples)
    : samples_(samples)
{
}

Vector3d
VoronoiCellFinder::offsetOf(std::uint32_t sample) const
{
  const Position& position = samples_.getPositions()[sample];
  return {static_cast<double>(position[0]) - place_.x[0],
          static_cast<double>(position[1]) - place_.x[1],
          static_cast<double>(position[2]) - place_.x[2]};
}

bool
VoronoiCellFinder::find(const Query& place,
                        const std::uint32_t* near,
                        std::size_t count)
{
  own_ = no_sample;
  start(place, near, count);
  while (is_bounded_ && improve()) {
  }
  for (std::size_t i = 0; i < count_; ++i)
    is_bounded_ = is_bounded_ && faces_[i].tag != CellFace::no_tag;
  return is_bounded_;
}

void
VoronoiCellFinder::findWhole(std::uint32_t sample,
                             const std::uint32_t* near,
                             std::size_t count)
{
  const Position& position = samples_.getPositions()[sample];
  own_ = sample;
  start({{position[0], position[1], position[2]}}, near, count);
  while (improve()) {
  }
}

void
VoronoiCellFinder::start(const Query& place,
                         const std::uint32_t* near,
                         std::size_t count)
{
  place_ = place;
  const KdBox box = samples_.getTree().getBox(samples_.getTree().getRoot());
  double sq_size = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis], high = box.high[axis];
    const double along = std::max(high, place.x[axis]) - std::min(low, place.x[axis]);
    sq_size += along * along;
  }
  const double half_side = cube_size * std::sqrt(sq_size);
  count_ = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      addFace(CellFace::no_tag, {side * Vector3d::Unit(axis), half_side})
          .polygon.start(half_side);
  reach_ = std::sqrt(3.0) * half_side;
  final_.clear();
  neighbors_.assign(near, near + count);
  std::sort(neighbors_.begin(), neighbors_.end(), [&](auto a, auto b) {
    const auto& positions = samples_.getPositions();
    const double to_a = sqDistance(place, positions[a]),
                 to_b = sqDistance(place, positions[b]);
    return to_a != to_b ? to_a < to_b : a < b;
  });
  for (std::size_t i = 0; i < count; ++i)
    cut(offsetOf(neighbors_[i]), static_cast<int>(i));
  sq_reach_ = offsetOf(neighbors_.back()).squaredNorm();
  is_bounded_ = true;
}

CellFace&
VoronoiCellFinder::addFace(int tag, const CellPlane& plane)
{
  if (count_ == faces_.size())
    faces_.emplace_back();
  CellFace& face = faces_[count_++];
  face.tag = tag;
  face.plane = plane;
  return face;
}

bool
VoronoiCellFinder::cut(const Vector3d& offset, int tag)
{
  const CellPlane plane(offset, 0.5 * offset.squaredNorm());
  if (plane.height >= reach_)
    return false;
  const double tolerance = smallest_height * reach_,
               sq_height = plane.height * plane.height;
  bool is_cut = false;
  for (std::size_t i = 0; i < count_; ++i) {
    CellFace& face = faces_[i];
    // Vertices that a plane left within its tolerance may ask for it again.
    if (face.plane.height == plane.height && face.plane.normal == plane.normal)
      return false;
    if (face.getSqReach() > sq_height)
      is_cut =
          face.plane.cut(face.polygon, plane.normal, plane.height, tolerance) || is_cut;
  }
  if (!is_cut)
    return false;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i)
    if (faces_[i].polygon.size() > 0) {
      if (kept != i)
        std::swap(faces_[kept], faces_[i]);
      ++kept;
    }
  count_ = kept;
  CellFace& own = addFace(tag, plane);
  own.polygon.start(reach_);
  for (std::size_t i = 0; i < kept && own.polygon.size() > 0; ++i)
    plane.cut(own.polygon, faces_[i].plane.normal, faces_[i].plane.height, tolerance);
  if (own.polygon.size() == 0)
    --count_;
  double sq_reach = 0.0;
  for (std::size_t i = 0; i < count_; ++i)
    sq_reach = std::max(sq_reach, faces_[i].getSqReach());
  reach_ = std::sqrt(sq_reach);
  return true;
}

bool
VoronoiCellFinder::improve()
{
  // The farthest ones first: if the cell is not bounded, they tell so at once.
  double sq_farthest = 0.25 * sq_reach_;
  Vector3d farthest;
  bool is_final = true;
  int tag = 0;
  for (std::size_t f = 0; f < count_; ++f) {
    const CellFace& face = faces_[f];
    if (face.getSqReach() <= sq_farthest)
      continue;
    for (std::size_t i = 0; i < face.polygon.size(); ++i) {
      const Vector3d vertex = face.plane.placeOf(face.polygon[i]);
      if (vertex.squaredNorm() > sq_farthest && !isKnown(vertex)) {
        sq_farthest = vertex.squaredNorm();
        farthest = vertex;
        is_final = false;
        tag = face.tag;
      }
    }
  }
  if (is_final)
    return false;
  final_.insert(std::lower_bound(final_.begin(), final_.end(), sq_farthest),
                {sq_farthest, farthest});
  std::uint32_t sample;
  if (findInBall(farthest, sample)) {
    neighbors_.push_back(sample);
    if (cut(offsetOf(sample), static_cast<int>(neighbors_.size()) - 1))
      return true;
    neighbors_.pop_back();
  }
  is_bounded_ = tag != CellFace::no_tag;
  return true;
}

bool
VoronoiCellFinder::isKnown(const Vector3d& vertex) const
{
  const double sq_length = vertex.squaredNorm();
  // Those of about that length.
  constexpr double room = 4.0 * slack;
  auto known = std::lower_bound(final_.begin(), final_.end(), (1.0 - room) * sq_length);
  for (; known != final_.end() && known->sq_length <= (1.0 + room) * sq_length; ++known)
    if ((known->place - vertex).squaredNorm() <= slack * slack * sq_length)
      return true;
  return false;
}

bool
VoronoiCellFinder::findInBall(const Vector3d& vertex, std::uint32_t& found) const
{
  const KdTree& tree = samples_.getTree();
  const std::vector<Position>& positions = samples_.getPositions();
  const Query center{
      {place_.x[0] + vertex[0], place_.x[1] + vertex[1], place_.x[2] + vertex[2]}};
  double sq_least = (1.0 - slack) * vertex.squaredNorm();
  bool is_found = false;
  const auto sqGap = [&](const KdNode& node) {
    const KdBox& box = tree.getBox(node);
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double gap = std::max({static_cast<double>(box.low[axis]) - center.x[axis],
                                   center.x[axis] - static_cast<double>(box.high[axis]),
                                   0.0});
      sum += gap * gap;
    }
    return sum;
  };
  std::pair<KdNode, double> stack[2 * 64];
  std::size_t depth = 0;
  stack[depth++] = {tree.getRoot(), sqGap(tree.getRoot())};
  while (depth > 0) {
    const auto [node, sq_gap] = stack[--depth];
    if (sq_gap >= sq_least)
      continue;
    if (!KdTree::isBucket(node)) {
      const KdNode left = node.left(), right = node.right();
      const double to_left = sqGap(left), to_right = sqGap(right);
      // The nearer one comes off the stack first.
      if (to_left <= to_right) {
        stack[depth++] = {right, to_right};
        stack[depth++] = {left, to_left};
      }
      else {
        stack[depth++] = {left, to_left};
        stack[depth++] = {right, to_right};
      }
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.begin + node.count; ++i) {
      const double sq_dist = sqDistance(center, positions[i]);
      if (sq_dist >= sq_least || i == own_)
        continue;
      sq_least = sq_dist;
      found = i;
      is_found = true;
    }
  }
  return is_found;
}

} // namespace pcl_uvol::detail
