// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_kernel.h"
#include <pcl_uvol/common/dispatch.h>
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
constexpr float shared_extent = 4.0f;
/** Candidates that a box may hold, at least, and per neighbour: where density changes
 * that much, each point is searched for on its own. */
constexpr std::size_t least_crowd = 2000, crowd_per_neighbor = 100;
/** Guesses of a limit between two distances before they are taken for equal. */
constexpr int most_guesses = 16;
/** Room for rounding, where a box must not be too small by one bit. */
constexpr float slack = 1.0001f;

const KernelTable<const NearestKernels*> kernel_table{
    &baseline::nearest_kernels, &avx2::nearest_kernels, &avx512::nearest_kernels};

/** Per axis, from a point to the nearest place of a cell. */
Position
offsetsFrom(const Position& point, const KdCell& cell)
{
  Position offsets;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    offsets[axis] =
        std::clamp(point[axis], cell.low[a].coordinate, cell.high[a].coordinate) -
        point[axis];
  }
  return offsets;
}

float
sqLength(const Position& offsets)
{
  return offsets[0] * offsets[0] + offsets[1] * offsets[1] + offsets[2] * offsets[2];
}

} // namespace

NearestFinder::NearestFinder(const SampleSet& samples, std::size_t k)
    : samples_(samples)
    , k_(k)
    , kernels_(kernel_table.get())
{
}

void
NearestFinder::appendInside(std::uint32_t begin, std::uint32_t end)
{
  const std::size_t room = candidate_count_ + (end - begin) + kernel_room;
  if (room > candidates_.size()) {
    candidates_.resize(2 * room);
    for (auto& coordinates : x_)
      coordinates.resize(2 * room);
  }
  const std::size_t next = candidate_count_;
  candidate_count_ += kernels_->keepInside(samples_.getPositions().front().x,
                                           begin,
                                           end,
                                           low_.x,
                                           high_.x,
                                           {x_[0].data() + next,
                                            x_[1].data() + next,
                                            x_[2].data() + next,
                                            candidates_.data() + next});
}

bool
NearestFinder::gatherBelow(const KdTree& tree, const KdNode& node)
{
  if (node.count <= whole_subtree) {
    appendInside(node.begin, node.begin + node.count);
    return candidate_count_ <= std::max(least_crowd, crowd_per_neighbor * k_);
  }
  // Samples of the plane's own coordinate lie on either side of it.
  const int axis = tree.getAxis(node.depth);
  const float plane = tree.getPlane(node).coordinate;
  return (low_[axis] > plane || gatherBelow(tree, node.left())) &&
         (high_[axis] < plane || gatherBelow(tree, node.right()));
}

bool
NearestFinder::gatherFromAll()
{
  const KdTree& own = samples_.getTree();
  const auto none_outside = [&](const KdCell& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (low_[static_cast<int>(axis)] <= cell.low[axis].coordinate ||
          high_[static_cast<int>(axis)] >= cell.high[axis].coordinate)
        return false;
    return true;
  };
  if (none_outside(own.getCell()))
    return gatherBelow(own, own.getRoot());
  const auto meets = [&](const KdCell& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (low_[static_cast<int>(axis)] > cell.high[axis].coordinate ||
          high_[static_cast<int>(axis)] < cell.low[axis].coordinate)
        return false;
    return true;
  };
  for (const KdTree& tree : samples_.getTrees())
    if (meets(tree.getCell()) && !gatherBelow(tree, tree.getRoot()))
      return false;
  return true;
}

bool
NearestFinder::gather(const Position& low, const Position& high, float margin)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis] = std::nextafter(low[axis] - margin, -infinity);
    high_[axis] = std::nextafter(high[axis] + margin, infinity);
  }
  candidate_count_ = 0;
  const bool complete = gatherFromAll();
  margin_ = complete ? margin : no_box;
  return complete;
}

void
NearestFinder::expect(const Position* points, std::size_t count)
{
  if (reach_ == 0.0f || count == 0)
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
  expected_low_ = low;
  expected_high_ = high;
  is_expecting_ = true;
  if (margin_ == no_box || std::min(marginAt(low), marginAt(high)) < reach_)
    is_expecting_ = gather(low, high, expected_margin * reach_);
}

bool
NearestFinder::gatherAround(const Position& point, float margin)
{
  for (int axis = 0; axis < 3; ++axis)
    is_expecting_ = is_expecting_ && point[axis] >= expected_low_[axis] &&
                    point[axis] <= expected_high_[axis];
  is_expecting_ = is_expecting_ && gather(expected_low_, expected_high_, margin);
  return is_expecting_ || gather(point, point, margin);
}

float
NearestFinder::marginAt(const Position& point) const
{
  float margin = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    margin = std::min({margin, point[axis] - low_[axis], high_[axis] - point[axis]});
  return margin;
}

float
NearestFinder::limitOfNearest()
{
  // Counting is cheap and the number grows as the volume, so a few guesses find a limit
  // between the k-th and the next distance; only equal distances leave no room for one.
  float low = 0.0f, high = std::numeric_limits<float>::max();
  float limit = reach_ * reach_;
  const auto wanted = static_cast<float>(k_);
  for (int guess = 0; guess < most_guesses; ++guess) {
    const std::size_t count =
        kernels_->countWithin(sq_dist_.data(), candidate_count_, limit);
    if (count == k_)
      return limit;
    (count < k_ ? low : high) = limit;
    const float growth =
        std::cbrt((wanted + 0.5f) / (static_cast<float>(count) + 0.5f));
    limit *= growth * growth;
    if (!(limit > low && limit < high))
      limit =
          high == std::numeric_limits<float>::max() ? 2.0f * low : 0.5f * (low + high);
    if (!(limit > low && limit < high))
      break;
  }
  ordered_.assign(sq_dist_.begin(),
                  sq_dist_.begin() + static_cast<std::ptrdiff_t>(candidate_count_));
  const auto last = ordered_.begin() + static_cast<std::ptrdiff_t>(k_ - 1);
  std::nth_element(ordered_.begin(), last, ordered_.end());
  return *last;
}

void
NearestFinder::select(const Position& point)
{
  const std::size_t count = candidate_count_;
  const std::size_t room = candidates_.size() + kernel_room;
  if (sq_dist_.size() < room) {
    sq_dist_.resize(room);
    found_sq_dist_.resize(std::max(found_sq_dist_.size(), room));
    found_samples_.resize(std::max(found_samples_.size(), room));
  }
  kernels_->measure(
      x_[0].data(), x_[1].data(), x_[2].data(), count, point.x, sq_dist_.data());
  const float limit =
      count <= k_ ? std::numeric_limits<float>::infinity() : limitOfNearest();
  float* const sq_dist = found_sq_dist_.data();
  std::uint32_t* const samples = found_samples_.data();
  std::size_t kept = kernels_->keepWithin(
      sq_dist_.data(), candidates_.data(), count, limit, sq_dist, samples);
  // Of neighbours equally far as the k-th the lower indices stay.
  for (std::size_t i = kept; kept > k_; --i)
    if (sq_dist[i - 1] == limit) {
      std::copy(sq_dist + i, sq_dist + kept, sq_dist + i - 1);
      std::copy(samples + i, samples + kept, samples + i - 1);
      --kept;
    }
  found_count_ = kept;
}

void
NearestFinder::descend(const Position& point,
                       const KdTree& tree,
                       const KdNode& node,
                       float sq_bound,
                       Position& offsets)
{
  if (node.isLeaf()) {
    const Position& x = samples_.getPositions()[node.begin];
    const float dx = x[0] - point[0], dy = x[1] - point[1], dz = x[2] - point[2];
    nearest_.emplace_back(dx * dx + dy * dy + dz * dz, node.begin);
    std::push_heap(nearest_.begin(), nearest_.end());
    if (nearest_.size() > k_) {
      std::pop_heap(nearest_.begin(), nearest_.end());
      nearest_.pop_back();
    }
    return;
  }
  const int axis = tree.getAxis(node.depth);
  const float offset = tree.getPlane(node).coordinate - point[axis];
  descend(point, tree, offset >= 0.0f ? node.left() : node.right(), sq_bound, offsets);
  // The far half begins at the plane (Arya and Mount 1993).
  const float old_offset = offsets[axis];
  const float sq_far = sq_bound - old_offset * old_offset + offset * offset;
  if (nearest_.size() < k_ || sq_far <= slack * nearest_.front().first) {
    offsets[axis] = offset;
    descend(point, tree, offset >= 0.0f ? node.right() : node.left(), sq_far, offsets);
    offsets[axis] = old_offset;
  }
}

void
NearestFinder::searchAlone(const Position& point)
{
  nearest_.clear();
  const KdTree& own = samples_.getTree();
  const auto search = [&](const KdTree& tree) {
    Position offsets = offsetsFrom(point, tree.getCell());
    const float sq_dist = sqLength(offsets);
    if (nearest_.size() < k_ || sq_dist <= slack * nearest_.front().first)
      descend(point, tree, tree.getRoot(), sq_dist, offsets);
  };
  search(own);
  for (const KdTree& tree : samples_.getTrees())
    if (&tree != &own)
      search(tree);
  reach_ = std::sqrt(nearest_.front().first) * slack;
  std::sort(nearest_.begin(), nearest_.end(), [](const auto& a, const auto& b) {
    return a.second < b.second;
  });
  found_count_ = nearest_.size();
  found_sq_dist_.resize(std::max(found_sq_dist_.size(), found_count_ + kernel_room));
  found_samples_.resize(std::max(found_samples_.size(), found_count_ + kernel_room));
  for (std::size_t i = 0; i < found_count_; ++i) {
    found_sq_dist_[i] = nearest_[i].first;
    found_samples_[i] = nearest_[i].second;
  }
}

bool
NearestFinder::searchInBox(const Position& point, float length)
{
  if ((margin_ == no_box || marginAt(point) < reach_) &&
      !gatherAround(point, expected_margin * (reach_ > 0.0f ? reach_ : length)))
    return false;
  for (;;) {
    select(point);
    float sq_reach = 0.0f;
    for (std::size_t i = 0; i < found_count_; ++i)
      sq_reach = std::max(sq_reach, found_sq_dist_[i]);
    reach_ = std::sqrt(sq_reach) * slack;
    if (candidate_count_ == samples_.size() ||
        (found_count_ == k_ && reach_ <= marginAt(point)))
      return true;
    // With k candidates found none of the nearest is farther than the farthest of them.
    if (!gatherAround(point, found_count_ == k_ ? reach_ : 2.0f * margin_))
      return false;
  }
}

NearestFinder::Row
NearestFinder::find(const Position& point, float length)
{
  if (!searchInBox(point, length))
    searchAlone(point);
  return found();
}

NearestFinder::Row
NearestFinder::findWithin(const Position& point, float radius)
{
  reach_ = radius;
  if ((margin_ == no_box || marginAt(point) < radius) &&
      !gatherAround(point, expected_margin * radius))
    searchAlone(point);
  else
    select(point);
  reach_ = radius;
  return found();
}

} // namespace pcl_uvol
