// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/metric_finder.h"

#include "common/constants.h"
#include "neighbors/kernel_tables.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

MetricRows
toRows(const Eigen::Matrix3d& matrix)
{
  MetricRows rows;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      rows.row[i][j] = matrix(i, j);
  return rows;
}

/** Room for rounding: a box must not seem farther than a sample in it. The squares of
 * the metric are known to 1e-16 of the largest of them. */
constexpr double limit_slack = 1.0 + 1e-6;

/** Samples per neighbour that are kept for the points to come; where there are more,
 * each point is searched for on its own. */
constexpr std::size_t most_copied = 6;

} // namespace

MetricFinder::MetricFinder(const SampleSet& samples, std::size_t k, bool shares)
    : samples_(samples)
    , k_(k)
    , shares_(shares)
    , kernels_(metric_kernel_table.get())
{
}

void
MetricFinder::setMetric(const Eigen::Matrix3d& metric)
{
  if (has_metric_ && metric == metric_)
    return;
  metric_ = metric;
  const Eigen::Matrix3d inverse = metric.inverse();
  const Eigen::Vector3d sq_extent = inverse.rowwise().squaredNorm();
  for (int axis = 0; axis < 3; ++axis)
    bounds_.per_sq_extent[axis] = 1.0 / sq_extent[axis];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squares(metric.transpose() *
                                                               metric);
  bounds_.rows = toRows(squares.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
                        squares.eigenvectors().transpose());
  rows_ = toRows(metric);
  has_metric_ = true;
  has_copy_ = false;
}

void
MetricFinder::findBounds(const KdBox& left,
                         const KdBox& right,
                         double (&sq_bounds)[2]) const
{
  const KdBox* const both[2] = {&left, &right};
  BoxPair boxes;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 2; ++i) {
      boxes.low[axis][i] = static_cast<double>(both[i]->low[axis]) - point_[axis];
      boxes.high[axis][i] = static_cast<double>(both[i]->high[axis]) - point_[axis];
    }
  kernels_->findBounds(boxes, bounds_, sq_bounds);
}

bool
MetricFinder::mayHold(double sq_bound) const
{
  return sq_bound <= limit_slack * sq_farthest_;
}

double
MetricFinder::measure(const Position* positions,
                      std::size_t count,
                      double* sq_dists) const
{
  return kernels_->measure(positions->x, count, point_.x, rows_, sq_dists);
}

void
MetricFinder::keepNearest()
{
  if (nearest_.size() < k_)
    return;
  const auto last = nearest_.begin() + static_cast<std::ptrdiff_t>(k_ - 1);
  std::nth_element(nearest_.begin(), last, nearest_.end());
  nearest_.erase(last + 1, nearest_.end());
  sq_farthest_ = nearest_.back().first;
}

void
MetricFinder::measureBucket(const KdNode& bucket)
{
  std::array<double, KdTree::bucket_samples> sq_dists;
  const double least =
      measure(&samples_.getPositions()[bucket.begin], bucket.count, sq_dists.data());
  if (least > sq_farthest_)
    return;
  for (std::uint32_t i = 0; i < bucket.count; ++i)
    if (sq_dists[i] <= sq_farthest_)
      nearest_.emplace_back(sq_dists[i], bucket.begin + i);
  has_copy_ = has_copy_ && nearest_.size() <= most_copied * k_;
  // Sorting out costs more than looking at some samples too many.
  if (!has_copy_ &&
      nearest_.size() >= k_ + (sq_farthest_ == infinity<double> ? 0 : k_ / 4))
    keepNearest();
}

template <typename Visit>
bool
MetricFinder::descend(const KdTree& tree, const KdNode& node, const Visit& visit)
{
  if (KdTree::isBucket(node))
    return visit(node);
  KdNode halves[2] = {node.left(), node.right()};
  double sq_bounds[2];
  findBounds(tree.getBox(halves[0]), tree.getBox(halves[1]), sq_bounds);
  if (sq_bounds[1] < sq_bounds[0]) {
    std::swap(halves[0], halves[1]);
    std::swap(sq_bounds[0], sq_bounds[1]);
  }
  for (int i = 0; i < 2; ++i)
    if (mayHold(sq_bounds[i]) && !descend(tree, halves[i], visit))
      return false;
  return true;
}

template <typename Visit>
bool
MetricFinder::visitTrees(const Visit& visit)
{
  const KdTree& own = samples_.getTree();
  const auto search = [&](const KdTree& tree) {
    const KdBox& box = tree.getBox(tree.getRoot());
    double sq_bounds[2];
    findBounds(box, box, sq_bounds);
    return !mayHold(sq_bounds[0]) || descend(tree, tree.getRoot(), visit);
  };
  const auto& trees = samples_.getTrees();
  return search(own) &&
         std::all_of(trees.begin(), trees.end(), [&](const KdTree& tree) {
           return &tree == &own || search(tree);
         });
}

bool
MetricFinder::isEmpty(const Position& point,
                      const Eigen::Matrix3d& metric,
                      double distance)
{
  setMetric(metric);
  point_ = point;
  sq_farthest_ = distance * distance;
  reach_ = distance;
  return visitTrees([&](const KdNode& bucket) {
    std::array<double, KdTree::bucket_samples> sq_dists;
    return measure(&samples_.getPositions()[bucket.begin],
                   bucket.count,
                   sq_dists.data()) > limit_slack * sq_farthest_;
  });
}

double
MetricFinder::distanceInMetric(const Position& a, const Position& b) const
{
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis)
    offset[axis] = static_cast<double>(a[axis]) - b[axis];
  return (metric_ * offset).norm();
}

bool
MetricFinder::selectFromCopy()
{
  if (copied_.size() < k_)
    return false;
  sq_dists_.resize(copied_.size());
  measure(copied_places_.data(), copied_.size(), sq_dists_.data());
  nearest_.clear();
  for (std::size_t i = 0; i < copied_.size(); ++i)
    nearest_.emplace_back(sq_dists_[i], copied_[i]);
  keepNearest();
  return limit_slack *
             (std::sqrt(sq_farthest_) + distanceInMetric(point_, copy_center_)) <=
         copy_radius_;
}

void
MetricFinder::search(double sq_limit)
{
  sq_farthest_ = limit_slack * sq_limit;
  has_copy_ = shares_ && sq_limit < infinity<double>;
  copy_center_ = point_;
  copy_radius_ = std::sqrt(sq_limit);
  nearest_.clear();
  visitTrees([&](const KdNode& bucket) {
    measureBucket(bucket);
    return true;
  });
  copied_.clear();
  copied_places_.clear();
  if (has_copy_)
    for (const Candidate& candidate : nearest_) {
      copied_.push_back(candidate.second);
      copied_places_.push_back(samples_.getPositions()[candidate.second]);
    }
  keepNearest();
}

Ball
MetricFinder::getSearched() const
{
  Ball ball{point_, static_cast<float>(reach_)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ball.extent[axis] = 1.0 / std::sqrt(bounds_.per_sq_extent[axis]);
    std::copy_n(bounds_.rows.row[axis], 3, ball.metric[axis].begin());
  }
  return ball;
}

const std::vector<std::uint32_t>&
MetricFinder::find(const Position& point,
                   const Eigen::Matrix3d& metric,
                   double sq_limit)
{
  setMetric(metric);
  point_ = point;
  if (!has_copy_ || !selectFromCopy())
    search(sq_limit);
  reach_ = std::sqrt(std::max_element(nearest_.begin(), nearest_.end())->first);
  found_.clear();
  for (const Candidate& candidate : nearest_)
    found_.push_back(candidate.second);
  std::sort(found_.begin(), found_.end());
  return found_;
}

} // namespace pcl_uvol
