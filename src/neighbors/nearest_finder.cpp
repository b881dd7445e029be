// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/nearest_finder.h"

#include "common/constants.h"
#include "neighbors/kernel_tables.h"
#include "neighbors/nearest_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Room around points over the reach of the last search: what the next ones need, but
 * for one in a thousand of uniform samples. */
constexpr float usual_room = 1.2f;
/** Points farther apart, in multiples of the reach, are not worth a copy in common. */
constexpr float shared_extent = 4.0f;
/** Samples that a copy may hold, at least, and per neighbour: where density changes
 * that much, each point is searched for on its own. */
constexpr std::size_t least_copied = 2000, copied_per_neighbor = 100;
/** Trials of a limit between two distances by the growth of volumes. */
constexpr int most_trials = 8;
/** Room for the rounding of a squared distance. */
constexpr float reach_slack = 1.0001f;

/** The least squared distance between two boxes. No squared distance between a point of
 * one and a point of the other is below it, to the last bit: each of the operations
 * that make it is monotone, and so is its rounding. */
float
sqGap(const KdBox& a, const KdBox& b)
{
  float gap[3];
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] =
        std::max({b.low[axis] - a.high[axis], a.low[axis] - b.high[axis], 0.0f});
  return gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2];
}

/** The largest squared distance of a point from one of a box, to the last bit. */
float
sqFarthest(const KdBox& box, const Position& point)
{
  float far[3];
  for (int axis = 0; axis < 3; ++axis)
    far[axis] = std::max(std::abs(point[axis] - box.low[axis]),
                         std::abs(point[axis] - box.high[axis]));
  return far[0] * far[0] + far[1] * far[1] + far[2] * far[2];
}

/** Whether a cell holds all within a distance of a box. */
bool
holds(const KdCell& cell, const KdBox& box, float distance)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int i = static_cast<int>(axis);
    if (!(box.low[i] - distance > cell.low[axis].coordinate &&
          box.high[i] + distance < cell.high[axis].coordinate))
      return false;
  }
  return true;
}

} // namespace

NearestFinder::NearestFinder(const SampleSet& samples, std::size_t k)
    : samples_(samples)
    , k_(k)
    , kernels_(nearest_kernel_table.get())
    , sq_dist_(KdTree::bucket_samples + kernel_room)
{
  startGroup({{{infinity<float>, infinity<float>, infinity<float>}},
              {{infinity<float>, infinity<float>, infinity<float>}}});
}

void
NearestFinder::startGroup(const KdBox& box)
{
  group_ = box;
  copy_ = Copy::None;
}

void
NearestFinder::expect(const Position* points, std::size_t count)
{
  if (count == 0)
    return;
  KdBox box{points[0], points[0]};
  for (std::size_t i = 1; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], points[i][axis]);
      box.high[axis] = std::max(box.high[axis], points[i][axis]);
    }
  startGroup(box);
}

bool
NearestFinder::isInGroup(const Position& point) const
{
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis)
    inside =
        inside && point[axis] >= group_.low[axis] && point[axis] <= group_.high[axis];
  return inside;
}

bool
NearestFinder::copyWithin(float sq_limit)
{
  sq_limit_ = sq_limit;
  copied_count_ = 0;
  const KdTree& own = samples_.getTree();
  const auto copy_from = [&](const KdTree& tree) {
    return copyBelow(tree, tree.getRoot());
  };
  const auto& trees = samples_.getTrees();
  return holds(own.getCell(), group_, reach_slack * std::sqrt(sq_limit))
             ? copy_from(own)
             : std::all_of(trees.begin(), trees.end(), copy_from);
}

bool
NearestFinder::copyBelow(const KdTree& tree, const KdNode& node)
{
  if (sqGap(group_, tree.getBox(node)) > sq_limit_)
    return true;
  if (!KdTree::isBucket(node))
    return copyBelow(tree, node.left()) && copyBelow(tree, node.right());
  appendNear(node.begin, node.begin + node.count);
  return copied_count_ <= std::max(least_copied, copied_per_neighbor * k_);
}

void
NearestFinder::appendNear(std::uint32_t begin, std::uint32_t end)
{
  const std::size_t room = copied_count_ + (end - begin) + kernel_room;
  if (room > copied_.size()) {
    copied_.resize(2 * room);
    for (auto& coordinates : x_)
      coordinates.resize(2 * room);
  }
  const std::size_t next = copied_count_;
  copied_count_ += kernels_->keepNear(samples_.getPositions().front().x,
                                      begin,
                                      end,
                                      group_.low.x,
                                      group_.high.x,
                                      sq_limit_,
                                      {x_[0].data() + next,
                                       x_[1].data() + next,
                                       x_[2].data() + next,
                                       copied_.data() + next});
}

bool
NearestFinder::copyForOthers()
{
  if (sqFarthest(group_, group_.low) == 0.0f) // there are none
    return false;
  // Any k samples tell: no point of the group is farther from one of them.
  float sq_limit = 0.0f;
  for (std::size_t i = 0; i < found_count_; ++i)
    sq_limit = std::max(sq_limit,
                        sqFarthest(group_, samples_.getPositions()[found_samples_[i]]));
  return copyWithin(sq_limit);
}

void
NearestFinder::makeRoom(std::size_t rows)
{
  const std::size_t room = rows + kernel_room;
  if (found_samples_.size() < room) {
    found_samples_.resize(room);
    found_sq_dist_.resize(room);
  }
}

bool
NearestFinder::selectFromCopy(const Position& point)
{
  const std::size_t count = copied_count_;
  if (sq_dist_.size() < count + kernel_room)
    sq_dist_.resize(copied_.size() + kernel_room);
  makeRoom(copied_.size());
  kernels_->measure(
      x_[0].data(), x_[1].data(), x_[2].data(), count, point.x, sq_dist_.data());
  const float limit = count <= k_ ? infinity<float> : limitOfNearest();
  float* const sq_dist = found_sq_dist_.data();
  std::uint32_t* const samples = found_samples_.data();
  std::size_t kept = kernels_->keepWithin(
      sq_dist_.data(), copied_.data(), count, limit, sq_dist, samples);
  // The lower indices stay of neighbours that are equally far as the k-th.
  for (std::size_t i = kept; kept > k_; --i)
    if (sq_dist[i - 1] == limit) {
      std::copy(sq_dist + i, sq_dist + kept, sq_dist + i - 1);
      std::copy(samples + i, samples + kept, samples + i - 1);
      --kept;
    }
  found_count_ = kept;
  return count == samples_.size() ||
         (kept == k_ && *std::max_element(sq_dist, sq_dist + kept) <= sq_limit_);
}

float
NearestFinder::limitOfNearest()
{
  // Counting is cheap and the number grows as the volume, so a few trials find a limit
  // between the k-th and the next distance; where distances are nearly equal, halving
  // does, and ends at the k-th distance itself if others equal it.
  constexpr float smallest = std::numeric_limits<float>::min(),
                  largest = std::numeric_limits<float>::max();
  float low = -1.0f, high = infinity<float>;
  float limit = std::clamp(reach_ * reach_, smallest, largest);
  const auto wanted = static_cast<float>(k_);
  for (int trial = 0;; ++trial) {
    const std::size_t count =
        kernels_->countWithin(sq_dist_.data(), copied_count_, limit);
    if (count == k_)
      return limit;
    (count < k_ ? low : high) = limit;
    const float growth =
        std::cbrt((wanted + 0.5f) / (static_cast<float>(count) + 0.5f));
    limit *= growth * growth;
    if (trial < most_trials && limit > low && limit < high)
      continue;
    if (high == infinity<float>)
      limit = std::min(2.0f * low, largest);
    else
      limit = low < 0.0f ? 0.0f : low + 0.5f * (high - low);
    if (!(limit > low && limit < high))
      return high;
  }
}

void
NearestFinder::search(const Position& point, float sq_limit)
{
  nearest_.clear();
  last_ = {sq_limit, std::numeric_limits<std::uint32_t>::max()};
  const KdBox place{point, point};
  const auto search_tree = [&](const KdTree& tree) {
    const KdNode root = tree.getRoot();
    if (mayHold(sqGap(place, tree.getBox(root)), root))
      searchBelow(place, tree, root);
  };
  const KdTree& own = samples_.getTree();
  search_tree(own);
  for (const KdTree& tree : samples_.getTrees())
    if (&tree != &own)
      search_tree(tree);
  std::sort(nearest_.begin(), nearest_.end(), [](const auto& a, const auto& b) {
    return a.second < b.second;
  });
  found_count_ = nearest_.size();
  makeRoom(found_count_);
  for (std::size_t i = 0; i < found_count_; ++i) {
    found_sq_dist_[i] = nearest_[i].first;
    found_samples_[i] = nearest_[i].second;
  }
}

void
NearestFinder::searchBelow(const KdBox& point, const KdTree& tree, const KdNode& node)
{
  if (KdTree::isBucket(node)) {
    measureBucket(point.low, node);
    return;
  }
  const KdNode left = node.left(), right = node.right();
  const float sq_left = sqGap(point, tree.getBox(left)),
              sq_right = sqGap(point, tree.getBox(right));
  const bool left_first = sq_left <= sq_right;
  const auto visit = [&](const KdNode& half, float sq_bound) {
    if (mayHold(sq_bound, half))
      searchBelow(point, tree, half);
  };
  if (left_first)
    visit(left, sq_left);
  visit(right, sq_right);
  if (!left_first)
    visit(left, sq_left);
}

void
NearestFinder::measureBucket(const Position& point, const KdNode& bucket)
{
  const std::uint32_t begin = bucket.begin;
  kernels_->measureRun(samples_.getPositions().front().x,
                       begin,
                       begin + bucket.count,
                       point.x,
                       sq_dist_.data());
  if (kernels_->countWithin(sq_dist_.data(), bucket.count, last_.first) == 0)
    return;
  for (std::uint32_t i = 0; i < bucket.count; ++i) {
    const Candidate candidate(sq_dist_[i], begin + i);
    if (sq_dist_[i] > last_.first || !(candidate < last_))
      continue;
    if (nearest_.size() == k_) {
      std::pop_heap(nearest_.begin(), nearest_.end());
      nearest_.pop_back();
    }
    nearest_.push_back(candidate);
    std::push_heap(nearest_.begin(), nearest_.end());
    if (nearest_.size() == k_)
      last_ = nearest_.front();
  }
}

bool
NearestFinder::isEmpty(const KdBox& point,
                       const KdTree& tree,
                       const KdNode& node,
                       float sq_limit)
{
  if (sqGap(point, tree.getBox(node)) > sq_limit)
    return true;
  if (!KdTree::isBucket(node))
    return isEmpty(point, tree, node.left(), sq_limit) &&
           isEmpty(point, tree, node.right(), sq_limit);
  kernels_->measureRun(samples_.getPositions().front().x,
                       node.begin,
                       node.begin + node.count,
                       point.low.x,
                       sq_dist_.data());
  return kernels_->countWithin(sq_dist_.data(), node.count, sq_limit) == 0;
}

float
NearestFinder::sqSearchRadius(const Position& point, std::uint32_t sample)
{
  // Samples that follow one another in the tree lie close together.
  const std::size_t middle = sample - std::min<std::size_t>(sample, k_ / 2);
  const auto begin = static_cast<std::uint32_t>(std::min(middle, samples_.size() - k_));
  if (sq_dist_.size() < k_ + kernel_room)
    sq_dist_.resize(k_ + kernel_room);
  kernels_->measureRun(samples_.getPositions().front().x,
                       begin,
                       begin + static_cast<std::uint32_t>(k_),
                       point.x,
                       sq_dist_.data());
  return *std::max_element(sq_dist_.data(), sq_dist_.data() + k_);
}

float
NearestFinder::findGap(const Position& point,
                       std::uint32_t first,
                       std::uint32_t second,
                       float part)
{
  if (samples_.size() < k_)
    return 0.0f;
  const float sq_farthest =
      std::min(sqSearchRadius(point, first), sqSearchRadius(point, second));
  const auto& trees = samples_.getTrees();
  const bool is_empty =
      std::all_of(trees.begin(), trees.end(), [&](const KdTree& tree) {
        return isEmpty({point, point}, tree, tree.getRoot(), part * part * sq_farthest);
      });
  return is_empty ? std::sqrt(sq_farthest) : 0.0f;
}

void
NearestFinder::prepare(const Position& point, float distance)
{
  if (!isInGroup(point))
    startGroup({point, point});
  if (copy_ != Copy::None)
    return;
  for (int axis = 0; axis < 3; ++axis)
    if (group_.high[axis] - group_.low[axis] > shared_extent * distance)
      group_ = {point, point};
  const float room = usual_room * distance;
  copy_ = copyWithin(room * room) ? Copy::Usual : Copy::TooLarge;
}

NearestFinder::Row
NearestFinder::find(const Position& point, float length)
{
  if (!(reach_ > 0.0f))
    reach_ = length;
  prepare(point, reach_);
  const bool has_copy = copy_ == Copy::Usual || copy_ == Copy::Enough;
  if (!has_copy || !selectFromCopy(point)) {
    search(point, infinity<float>);
    if (copy_ != Copy::NotPossible)
      copy_ = copyForOthers() ? Copy::Enough : Copy::NotPossible;
  }
  reach_ = std::sqrt(
      *std::max_element(found_sq_dist_.data(), found_sq_dist_.data() + found_count_));
  return found();
}

NearestFinder::Row
NearestFinder::findWithin(const Position& point, float radius)
{
  const float sq_radius = reach_slack * radius * radius;
  reach_ = radius;
  if (copy_ == Copy::Usual && sq_limit_ < sq_radius)
    startGroup(group_);
  prepare(point, radius);
  if (copy_ == Copy::Usual || copy_ == Copy::Enough)
    selectFromCopy(point);
  else
    search(point, sq_radius);
  return found();
}

} // namespace pcl_uvol
