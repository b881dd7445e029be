// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/sample_hull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace pcl_uvol::detail {

namespace {

using Eigen::Vector3d;

/** Share of the tolerance: what is nearer to the plane of a face lies on it. Far above
 * the rounding of double where the tolerance is above 1e-6 of the samples' extent. */
constexpr double on_face = 1e-6;

Vector3d
toVector(const Position& place)
{
  return {place[0], place[1], place[2]};
}

} // namespace

SampleHull::SampleHull(const SampleSet& samples, double tolerance)
    : tolerance_(tolerance)
{
  const KdTree& tree = samples.getTree();
  const KdBox box = tree.getBox(tree.getRoot());
  const Vector3d middle = 0.5 * (toVector(box.low) + toVector(box.high));
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      corners_.push_back(middle + sign * tolerance * Vector3d::Unit(axis));
  for (std::size_t i = 0; i < 8; ++i) {
    const std::size_t x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2);
    const bool is_mirrored = (x + y + z) % 2 != 0;
    addFace(x, is_mirrored ? z : y, is_mirrored ? y : z);
  }
  std::vector<Vector3d> outside;
  for (const Position& position : samples.getPositions())
    outside.push_back(toVector(position));
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
  return distanceBeyond(toVector(place)) <= tolerance_;
}

double
SampleHull::distanceBeyond(const Vector3d& place) const
{
  double distance = 0.0;
  for (const Face& face : faces_)
    distance = std::max(distance, face.normal.dot(place) - face.height);
  return distance;
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
SampleHull::addFace(std::size_t a, std::size_t b, std::size_t c)
{
  const Vector3d side = corners_[b] - corners_[a],
                 twice_area = side.cross(corners_[c] - corners_[a]);
  const double size = twice_area.norm();
  Vector3d normal = Vector3d::Zero();
  if (size > on_face * tolerance_ * side.norm())
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
  std::vector<std::pair<std::size_t, std::size_t>> rim;
  for (auto face = seen; face != faces_.end(); ++face)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t from = face->corners[i], to = face->corners[(i + 1) % 3];
      const auto other = std::find(rim.begin(), rim.end(), std::make_pair(to, from));
      if (other == rim.end())
        rim.emplace_back(from, to);
      else
        rim.erase(other);
    }
  faces_.erase(seen, faces_.end());
  corners_.push_back(place);
  for (const auto& [from, to] : rim)
    addFace(from, to, corners_.size() - 1);
}

} // namespace pcl_uvol::detail
