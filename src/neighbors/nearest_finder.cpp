// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/neighbors/nearest_finder.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Subtrees this small are taken whole: distances cost less than planes. */
constexpr std::uint32_t whole_subtree = 8;
/** Half width of a box over the reach of a search: the next points may be that much
 * beside this one. */
constexpr float shared_width = 1.5f;
/** Room for rounding, where a box must not be too small by one bit. */
constexpr float slack = 1.0001f;

} // namespace

void
NearestFinder::gatherBelow(const KdNode& node)
{
  if (node.count <= whole_subtree) {
    const auto& positions = samples_.getPositions();
    for (std::uint32_t i = node.begin; i < node.begin + node.count; ++i) {
      candidates_.push_back(i);
      for (int axis = 0; axis < 3; ++axis)
        x_[axis].push_back(positions[i][axis]);
    }
    return;
  }
  // Samples of the plane's own coordinate lie on either side of it.
  const KdTree& tree = samples_.getTree();
  const int axis = tree.getAxis(node.depth);
  const float plane = tree.getPlane(node).coordinate;
  if (low_[axis] <= plane)
    gatherBelow(node.left());
  if (high_[axis] >= plane)
    gatherBelow(node.right());
}

void
NearestFinder::gather(const Position& center, float half_width)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  half_width_ = half_width;
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis] = std::nextafter(center[axis] - half_width, -infinity);
    high_[axis] = std::nextafter(center[axis] + half_width, infinity);
  }
  candidates_.clear();
  for (auto& coordinates : x_)
    coordinates.clear();
  gatherBelow(samples_.getTree().getRoot());
}

float
NearestFinder::marginAt(const Position& point) const
{
  float margin = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    margin = std::min({margin, point[axis] - low_[axis], high_[axis] - point[axis]});
  return margin;
}

void
NearestFinder::keepWithin(float sq_limit)
{
  const std::size_t count = candidates_.size();
  const float* const sq_dist = sq_dist_.data();
  found_.resize(count);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    found_[kept] = {sq_dist[i], candidates_[i]};
    kept += sq_dist[i] <= sq_limit ? 1 : 0;
  }
  found_.resize(kept);
}

void
NearestFinder::select(const Position& point)
{
  const std::size_t count = candidates_.size();
  sq_dist_.resize(count);
  const float px = point[0], py = point[1], pz = point[2];
  const float *x = x_[0].data(), *y = x_[1].data(), *z = x_[2].data();
  float* const sq_dist = sq_dist_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = x[i] - px, dy = y[i] - py, dz = z[i] - pz;
    sq_dist[i] = dx * dx + dy * dy + dz * dz;
  }
  // Most candidates are far: try those within the reach of the last search first.
  keepWithin(shared_width * reach_ * reach_);
  if (found_.size() < k_)
    keepWithin(std::numeric_limits<float>::infinity());
  if (found_.size() <= k_)
    return;
  // The k-th distance; of equal ones the lower indices stay.
  ordered_.clear();
  for (const Neighbor& neighbor : found_)
    ordered_.push_back(neighbor.sq_dist);
  const auto last = ordered_.begin() + static_cast<std::ptrdiff_t>(k_ - 1);
  std::nth_element(ordered_.begin(), last, ordered_.end());
  const float limit = *last;
  auto ties = std::count(ordered_.begin(), last + 1, limit);
  found_.erase(std::remove_if(found_.begin(),
                              found_.end(),
                              [&](const Neighbor& neighbor) {
                                return neighbor.sq_dist > limit ||
                                       (neighbor.sq_dist == limit && ties-- <= 0);
                              }),
               found_.end());
}

const std::vector<NearestFinder::Neighbor>&
NearestFinder::find(const Position& point, float length)
{
  if (half_width_ < 0.0f || marginAt(point) < reach_)
    gather(point, shared_width * (reach_ > 0.0f ? reach_ : length));
  for (;;) {
    select(point);
    float sq_reach = 0.0f;
    for (const Neighbor& neighbor : found_)
      sq_reach = std::max(sq_reach, neighbor.sq_dist);
    reach_ = std::sqrt(sq_reach) * slack;
    if (candidates_.size() == samples_.size() ||
        (found_.size() == k_ && reach_ <= marginAt(point)))
      return found_;
    // With k candidates found none of the nearest is farther than the farthest of them.
    gather(point, found_.size() == k_ ? shared_width * reach_ : 2.0f * half_width_);
  }
}

} // namespace pcl_uvol
