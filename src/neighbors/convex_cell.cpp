// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/convex_cell.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

/** Share of the size of a cell: vertices that close to a plane lie on it. */
constexpr double smallest_height = 1e-14;

/** Grows with the angle of a vector, from 0 to 4. */
double
pseudoAngle(double x, double y)
{
  const double sum = std::abs(x) + std::abs(y);
  if (!(sum > 0.0))
    return 0.0;
  const double part = y / sum;
  return x < 0.0 ? 2.0 - part : (y < 0.0 ? 4.0 + part : part);
}

} // namespace

void
ConvexCell::start(double half_side)
{
  count_ = 0;
  extent_ = std::sqrt(3.0) * half_side;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-half_side, half_side}) {
      Face& face = addFace(no_tag);
      const int second = (axis + 1) % 3, third = (axis + 2) % 3;
      constexpr double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
      for (int i = 0; i < 4; ++i) {
        const double* const at = corner[side > 0.0 ? i : 3 - i];
        Vector3d vertex;
        vertex[axis] = side;
        vertex[second] = half_side * at[0];
        vertex[third] = half_side * at[1];
        face.vertices.push_back(vertex);
      }
    }
}

void
ConvexCell::start(const ConvexCell& other)
{
  count_ = 0;
  extent_ = other.extent_;
  for (std::size_t i = 0; i < other.count_; ++i)
    addFace(other.faces_[i].tag).vertices = other.faces_[i].vertices;
}

ConvexCell::Face&
ConvexCell::addFace(int tag)
{
  if (count_ == faces_.size())
    faces_.emplace_back();
  Face& face = faces_[count_++];
  face.tag = tag;
  face.vertices.clear();
  return face;
}

bool
ConvexCell::cut(const Vector3d& normal, double offset, int tag)
{
  const double tolerance = smallest_height * normal.norm() * extent_;
  heights_.clear();
  bool is_cut = false;
  for (std::size_t i = 0; i < count_; ++i)
    for (const Vector3d& vertex : faces_[i].vertices) {
      heights_.push_back(normal.dot(vertex) - offset);
      is_cut = is_cut || heights_.back() > tolerance;
    }
  if (!is_cut)
    return false;
  rim_.clear();
  const double* heights = heights_.data();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t vertices = faces_[i].vertices.size();
    if (cutFace(faces_[i], heights, tolerance)) {
      if (kept != i)
        std::swap(faces_[kept], faces_[i]);
      ++kept;
    }
    heights += vertices;
  }
  count_ = kept;
  if (rim_.size() >= 3)
    closeBy(normal, tag);
  double sq_extent = 0.0;
  for (std::size_t i = 0; i < count_; ++i)
    for (const Vector3d& vertex : faces_[i].vertices)
      sq_extent = std::max(sq_extent, vertex.squaredNorm());
  extent_ = std::sqrt(sq_extent);
  return true;
}

bool
ConvexCell::cutFace(Face& face, const double* heights, double tolerance)
{
  const std::size_t count = face.vertices.size();
  const auto isOut = [&](std::size_t i) { return heights[i] > tolerance; };
  const auto out = [&] {
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i)
      number += isOut(i);
    return number;
  }();
  if (out == 0)
    return true;
  if (out == count)
    return false;
  rest_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    if (!isOut(i))
      rest_.push_back(face.vertices[i]);
    if (isOut(i) == isOut(next))
      continue;
    const double part = std::clamp(heights[i] / (heights[i] - heights[next]), 0.0, 1.0);
    rest_.push_back(face.vertices[i] + part * (face.vertices[next] - face.vertices[i]));
    rim_.push_back(rest_.back());
  }
  std::swap(face.vertices, rest_);
  return true;
}

void
ConvexCell::closeBy(const Vector3d& normal, int tag)
{
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& vertex : rim_)
    middle += vertex;
  middle /= static_cast<double>(rim_.size());
  const Vector3d first = normal.unitOrthogonal();
  const Vector3d second = normal.cross(first).normalized();
  angles_.clear();
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const Vector3d offset = rim_[i] - middle;
    angles_.emplace_back(pseudoAngle(offset.dot(first), offset.dot(second)), i);
  }
  std::sort(angles_.begin(), angles_.end());
  Face& face = addFace(tag);
  for (const auto& angle : angles_) {
    // Two faces have every vertex in common.
    const Vector3d& vertex = rim_[angle.second];
    if (face.vertices.empty() || vertex != face.vertices.back())
      face.vertices.push_back(vertex);
  }
}

double
ConvexCell::getVolume() const
{
  double sum = 0.0;
  if (count_ == 0)
    return sum;
  const Vector3d& apex = faces_[0].vertices[0];
  for (std::size_t i = 0; i < count_; ++i) {
    const std::vector<Vector3d>& polygon = faces_[i].vertices;
    const Vector3d first = polygon[0] - apex;
    for (std::size_t j = 2; j < polygon.size(); ++j)
      sum += first.dot((polygon[j - 1] - apex).cross(polygon[j] - apex));
  }
  return sum / 6.0;
}

PolygonMoments
computeMoments(const std::vector<Vector3d>& polygon)
{
  // The normal of the whole polygon gives each triangle its sign.
  Vector3d normal = Vector3d::Zero();
  for (std::size_t j = 2; j < polygon.size(); ++j)
    normal += (polygon[j - 1] - polygon[0]).cross(polygon[j] - polygon[0]);
  const double twice_area = normal.norm();
  if (!(twice_area > 0.0))
    return {0.0, polygon[0]};
  normal /= twice_area;
  Vector3d moment = Vector3d::Zero();
  for (std::size_t j = 2; j < polygon.size(); ++j) {
    const Vector3d a = polygon[j - 1] - polygon[0], b = polygon[j] - polygon[0];
    moment += normal.dot(a.cross(b)) * (a + b) / 3.0;
  }
  return {0.5 * twice_area, polygon[0] + moment / twice_area};
}

} // namespace pcl_uvol::detail
