// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/sample_hull.h"

#include "mesh/triangle_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace pcl_uvol::detail {

namespace {

using Eigen::Vector3d;

/** Part of the reach: no sample is farther from the hull. A smaller part takes many
 * more corners: with an eighth, the hull of 20,000 samples in a ball took minutes. */
constexpr double tolerance_part = 0.5;

/** Part of the tolerance: what is nearer to the plane of a face is on it. Far above the
 * rounding of double where the tolerance is above 1e-7 of the samples' extent, and
 * below what a sample on the plane of others is outside of the octahedron's faces. */
constexpr double on_face = 1e-8;

/** Part of the tolerance: a face that is less high has no normal, since rounding would
 * tilt it. */
constexpr double least_height = 1e-6;

Vector3d
toVector(const Position& place)
{
  return {place[0], place[1], place[2]};
}

} // namespace

SampleHull::SampleHull(const SampleSet& samples, double reach)
    : tolerance_(tolerance_part * reach)
{
  Vector3d middle = Vector3d::Zero(); // in the hull, unlike the middle of the box
  std::vector<Vector3d> outside;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    outside.push_back(toVector(samples.getPositions()[i]));
    middle += outside.back() / static_cast<double>(samples.size());
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      corners_.push_back(middle + sign * tolerance_ * Vector3d::Unit(axis));
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2);
    const bool is_mirrored = (x + y + z) % 2 != 0;
    addFace(x, is_mirrored ? z : y, is_mirrored ? y : z);
  }
  while (growTo(outside)) {
  }
  // Faces nearly without an area may be tilted: none cuts off a corner.
  for (Face& face : faces_)
    for (const Vector3d& corner : corners_)
      face.height = std::max(face.height, face.normal.dot(corner));
}

bool
SampleHull::contains(const Position& place) const
{
  // The octahedron may stick out of the hull by the tolerance.
  return distanceBeyond(toVector(place)) <= tolerance_ / tolerance_part - tolerance_;
}

double
SampleHull::distanceBeyond(const Vector3d& place) const
{
  bool is_outside = false;
  double distance = std::numeric_limits<double>::infinity();
  for (const Face& face : faces_) {
    const double above = face.normal.dot(place) - face.height;
    is_outside = is_outside || above > 0.0;
    // The nearest face is one of those that are seen from the place.
    if (above > -on_face * tolerance_ && above < distance) {
      const auto& [a, b, c] = face.corners;
      const TrianglePoint nearest =
          nearestOfTriangle({corners_[a], corners_[b], corners_[c]}, place);
      distance = std::min(distance, (nearest.place - place).norm());
    }
  }
  return is_outside ? distance : 0.0;
}

bool
SampleHull::growTo(std::vector<Vector3d>& places)
{
  std::vector<Vector3d> close;
  bool has_grown = false;
  while (true) {
    // The farthest first: most of the others lie in the hull then.
    std::size_t left = 0, farthest = 0;
    double distance = 0.0;
    for (const Vector3d& place : places) {
      const double of_place = distanceBeyond(place);
      if (of_place > tolerance_) {
        if (of_place > distance) {
          distance = of_place;
          farthest = left;
        }
        places[left++] = place;
      }
      else if (of_place > 0.0)
        close.push_back(place);
    }
    places.resize(left);
    if (places.empty())
      break;
    addCorner(places[farthest]);
    has_grown = true;
    places[farthest] = places.back();
    places.pop_back();
  }
  places.swap(close);
  return has_grown;
}

void
SampleHull::addFace(std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
  const Vector3d side = corners_[b] - corners_[a],
                 twice_area = side.cross(corners_[c] - corners_[a]);
  const double size = twice_area.norm();
  Vector3d normal = Vector3d::Zero();
  if (size > least_height * tolerance_ * side.norm())
    normal = twice_area / size;
  faces_.push_back({{a, b, c}, normal, normal.dot(corners_[a])});
}

void
SampleHull::addCorner(const Vector3d& place)
{
  const auto seen =
      std::stable_partition(faces_.begin(), faces_.end(), [&](const Face& face) {
        return face.normal.dot(place) <= face.height + on_face * tolerance_;
      });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rim;
  for (auto face = seen; face != faces_.end(); ++face)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = face->corners[i], to = face->corners[(i + 1) % 3];
      const auto other = std::find(rim.begin(), rim.end(), std::make_pair(to, from));
      if (other == rim.end())
        rim.emplace_back(from, to);
      else
        rim.erase(other);
    }
  faces_.erase(seen, faces_.end());
  corners_.push_back(place);
  for (const auto& [from, to] : rim)
    addFace(from, to, static_cast<std::uint32_t>(corners_.size() - 1));
}

} // namespace pcl_uvol::detail
