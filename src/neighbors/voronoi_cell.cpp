// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/voronoi_cell.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

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

bool
VoronoiCellFinder::find(const CellSearch& around)
{
  start(around);
  while (is_bounded_ && improve(around)) {
  }
  for (std::size_t i = 0; i < count_; ++i)
    is_bounded_ = is_bounded_ && faces_[i].tag != CellFace::no_tag;
  return is_bounded_;
}

void
VoronoiCellFinder::findWhole(const CellSearch& around)
{
  start(around);
  while (improve(around)) {
  }
}

void
VoronoiCellFinder::start(const CellSearch& around)
{
  const double half_side = around.getHalfSide();
  count_ = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      addFace(CellFace::no_tag, {side * Vector3d::Unit(axis), half_side})
          .polygon.start(half_side);
  reach_ = std::sqrt(3.0) * half_side;
  final_.clear();
  neighbors_ = around.getNear();
  for (std::size_t i = 0; i < neighbors_.size(); ++i)
    cut(around.offsetOf(neighbors_[i]), static_cast<int>(i));
  sq_reach_ = around.getSqKnown();
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
VoronoiCellFinder::improve(const CellSearch& around)
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
  if (around.findInBall(farthest, sample)) {
    neighbors_.push_back(sample);
    if (cut(around.offsetOf(sample), static_cast<int>(neighbors_.size()) - 1))
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

} // namespace pcl_uvol::detail
