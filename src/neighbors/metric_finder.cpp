// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/metric_finder.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Room for rounding: a box must not seem farther than a sample in it. The squares of
 * the metric are known to 1e-16 of the largest of them. */
constexpr double slack = 1.0 + 1e-6;

} // namespace

double
MetricFinder::sqBound(const KdBox& box) const
{
  double middle[3], half[3], sq_beside = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = static_cast<double>(box.low[axis]) - point_[axis];
    const double high = static_cast<double>(box.high[axis]) - point_[axis];
    middle[axis] = 0.5 * (low + high);
    half[axis] = 0.5 * (high - low);
    // Across the faces of the box along an axis.
    const double gap = std::max(0.0, std::abs(middle[axis]) - half[axis]);
    sq_beside = std::max(sq_beside, gap * gap / sq_extent_[axis]);
  }
  // Across the axes of the metric: the image of the box lies between two planes.
  double sq_between = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double a = bounds_(i, 0), b = bounds_(i, 1), c = bounds_(i, 2);
    const double place = std::abs(a * middle[0] + b * middle[1] + c * middle[2]);
    const double room =
        std::abs(a) * half[0] + std::abs(b) * half[1] + std::abs(c) * half[2];
    const double gap = std::max(0.0, place - room);
    sq_between += gap * gap;
  }
  return std::max(sq_beside, sq_between);
}

bool
MetricFinder::mayHold(double sq_bound) const
{
  return sq_bound <= slack * sq_farthest_;
}

void
MetricFinder::measureBucket(const KdNode& bucket)
{
  const Position* const positions = &samples_.getPositions()[bucket.begin];
  std::array<double, KdTree::bucket_samples> x[3], sq_dists;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = point_[axis];
    for (std::size_t i = 0; i < bucket.count; ++i)
      x[axis][i] = positions[i].x[axis] - place;
  }
  for (std::size_t i = 0; i < bucket.count; ++i)
    sq_dists[i] = 0.0;
  for (int row = 0; row < 3; ++row) {
    const double a = metric_(row, 0), b = metric_(row, 1), c = metric_(row, 2);
    for (std::size_t i = 0; i < bucket.count; ++i) {
      const double image = a * x[0][i] + b * x[1][i] + c * x[2][i];
      sq_dists[i] += image * image;
    }
  }
  const std::size_t before = nearest_.size();
  for (std::uint32_t i = 0; i < bucket.count; ++i)
    if (sq_dists[i] <= sq_farthest_)
      nearest_.emplace_back(sq_dists[i], bucket.begin + i);
  if (nearest_.size() == before || nearest_.size() < k_)
    return;
  const auto last = nearest_.begin() + static_cast<std::ptrdiff_t>(k_ - 1);
  std::nth_element(nearest_.begin(), last, nearest_.end());
  nearest_.erase(last + 1, nearest_.end());
  sq_farthest_ = nearest_.back().first;
}

void
MetricFinder::descend(const KdTree& tree, const KdNode& node)
{
  if (KdTree::isBucket(node)) {
    measureBucket(node);
    return;
  }
  std::pair<double, KdNode> halves[] = {
      {sqBound(tree.getBox(node.left())), node.left()},
      {sqBound(tree.getBox(node.right())), node.right()}};
  if (halves[1].first < halves[0].first)
    std::swap(halves[0], halves[1]);
  for (const auto& [sq_bound, half] : halves)
    if (mayHold(sq_bound))
      descend(tree, half);
}

const std::vector<std::uint32_t>&
MetricFinder::find(const Position& point, const Eigen::Matrix3d& metric)
{
  point_ = point;
  metric_ = metric;
  const Eigen::Matrix3d inverse = metric.inverse();
  sq_extent_ = inverse.rowwise().squaredNorm();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squares(metric.transpose() *
                                                               metric);
  bounds_ = squares.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
            squares.eigenvectors().transpose();
  nearest_.clear();
  sq_farthest_ = std::numeric_limits<double>::infinity();
  const KdTree& own = samples_.getTree();
  const auto search = [&](const KdTree& tree) {
    if (mayHold(sqBound(tree.getBox(tree.getRoot()))))
      descend(tree, tree.getRoot());
  };
  search(own);
  for (const KdTree& tree : samples_.getTrees())
    if (&tree != &own)
      search(tree);
  // No direction is longer in the metric by more than this norm of its inverse.
  reach_ = std::sqrt(std::max_element(nearest_.begin(), nearest_.end())->first) *
           inverse.norm();
  found_.clear();
  for (const auto& neighbor : nearest_)
    found_.push_back(neighbor.second);
  std::sort(found_.begin(), found_.end());
  return found_;
}

} // namespace pcl_uvol
