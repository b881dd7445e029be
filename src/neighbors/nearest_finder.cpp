// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/neighbors/nearest_finder.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Subtrees this small are taken whole: distances cost less than planes. */
constexpr std::uint32_t whole_subtree = 16;
/** Room around points over the reach of the last search: what the next ones need, but
 * for one in a thousand of uniform samples. */
constexpr float expected_margin = 1.2f;
/** Points farther apart, in multiples of the reach, are not worth a box in common. */
constexpr float shared_extent = 3.0f;
/** Squared distances up to this multiple of the last search's are tried first. */
constexpr float sq_reach_hint = 1.3f;
/** Room for rounding, where a box must not be too small by one bit. */
constexpr float slack = 1.0001f;

} // namespace

void
NearestFinder::appendInside(std::uint32_t begin, std::uint32_t end)
{
  const std::size_t room = candidate_count_ + (end - begin);
  if (room > candidates_.size()) {
    candidates_.resize(2 * room);
    for (auto& coordinates : x_)
      coordinates.resize(2 * room);
  }
  const auto& positions = samples_.getPositions();
  const Position low = low_, high = high_;
  std::size_t next = candidate_count_;
  // Written first and counted if inside: no branches to be mispredicted.
  for (std::uint32_t i = begin; i < end; ++i) {
    const Position& x = positions[i];
    candidates_[next] = i;
    x_[0][next] = x[0];
    x_[1][next] = x[1];
    x_[2][next] = x[2];
    const int inside =
        static_cast<int>(x[0] >= low[0]) & static_cast<int>(x[0] <= high[0]) &
        static_cast<int>(x[1] >= low[1]) & static_cast<int>(x[1] <= high[1]) &
        static_cast<int>(x[2] >= low[2]) & static_cast<int>(x[2] <= high[2]);
    next += static_cast<std::size_t>(inside);
  }
  candidate_count_ = next;
}

void
NearestFinder::gatherBelow(const KdNode& node)
{
  if (node.count <= whole_subtree) {
    appendInside(node.begin, node.begin + node.count);
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
NearestFinder::gather(const Position& low, const Position& high, float margin)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  margin_ = margin;
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis] = std::nextafter(low[axis] - margin, -infinity);
    high_[axis] = std::nextafter(high[axis] + margin, infinity);
  }
  candidate_count_ = 0;
  gatherBelow(samples_.getTree().getRoot());
}

void
NearestFinder::expect(const Position* points, std::size_t count)
{
  if (margin_ < 0.0f || count == 0)
    return;
  Position low = points[0], high = points[0];
  for (std::size_t i = 1; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], points[i][axis]);
      high[axis] = std::max(high[axis], points[i][axis]);
    }
  for (int axis = 0; axis < 3; ++axis)
    if (high[axis] - low[axis] > shared_extent * reach_)
      return;
  if (std::min(marginAt(low), marginAt(high)) < reach_)
    gather(low, high, expected_margin * reach_);
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
  found_.resize(std::max(found_.size(), candidate_count_));
  const float* const sq_dist = sq_dist_.data();
  const std::uint32_t* const candidates = candidates_.data();
  Neighbor* const found = found_.data();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < candidate_count_; ++i) {
    found[kept] = {sq_dist[i], candidates[i]};
    kept += static_cast<std::size_t>(sq_dist[i] <= sq_limit);
  }
  found_count_ = kept;
}

void
NearestFinder::select(const Position& point)
{
  const std::size_t count = candidate_count_;
  sq_dist_.resize(std::max(sq_dist_.size(), candidates_.size()));
  const float px = point[0], py = point[1], pz = point[2];
  const float *x = x_[0].data(), *y = x_[1].data(), *z = x_[2].data();
  float* const sq_dist = sq_dist_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = x[i] - px, dy = y[i] - py, dz = z[i] - pz;
    sq_dist[i] = dx * dx + dy * dy + dz * dz;
  }
  // Most candidates are far: try those within the reach of the last search first.
  keepWithin(sq_reach_hint * reach_ * reach_);
  if (found_count_ < k_)
    keepWithin(std::numeric_limits<float>::infinity());
  if (found_count_ <= k_)
    return;
  // The k-th distance; of equal ones the lower indices stay.
  ordered_.resize(std::max(ordered_.size(), found_count_));
  for (std::size_t i = 0; i < found_count_; ++i)
    ordered_[i] = found_[i].sq_dist;
  const auto first = ordered_.begin();
  const auto last = first + static_cast<std::ptrdiff_t>(k_ - 1);
  std::nth_element(first, last, first + static_cast<std::ptrdiff_t>(found_count_));
  const float limit = *last;
  auto ties = std::count(first, last + 1, limit);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found_count_; ++i) {
    const Neighbor neighbor = found_[i];
    found_[kept] = neighbor;
    const bool tie = neighbor.sq_dist == limit && ties > 0;
    ties -= static_cast<int>(tie);
    kept += static_cast<std::size_t>(neighbor.sq_dist < limit || tie);
  }
  found_count_ = kept;
}

NearestFinder::Row
NearestFinder::find(const Position& point, float length)
{
  if (margin_ < 0.0f || marginAt(point) < reach_)
    gather(point, point, expected_margin * (reach_ > 0.0f ? reach_ : length));
  for (;;) {
    select(point);
    float sq_reach = 0.0f;
    for (std::size_t i = 0; i < found_count_; ++i)
      sq_reach = std::max(sq_reach, found_[i].sq_dist);
    reach_ = std::sqrt(sq_reach) * slack;
    if (candidate_count_ == samples_.size() ||
        (found_count_ == k_ && reach_ <= marginAt(point)))
      return {found_.data(), found_.data() + found_count_};
    // With k candidates found none of the nearest is farther than the farthest of them.
    gather(point, point, found_count_ == k_ ? reach_ : 2.0f * margin_);
  }
}

} // namespace pcl_uvol
