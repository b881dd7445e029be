// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/metric_finder.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Room for rounding: a box must not seem farther than a sample in it. */
constexpr double slack = 1.0 + 1e-9;

/** Subtrees this small are taken whole: distances cost less than planes. */
constexpr std::uint32_t whole_subtree = 8;

} // namespace

bool
MetricFinder::isTooFar(std::size_t axis, const Corner& low, const Corner& high) const
{
  if (nearest_.size() < k_)
    return false;
  const double sq_limit = slack * nearest_.front().first;
  // Across the faces of the box along an axis.
  const double offset = std::max({0.0, low[axis], -high[axis]});
  if (offset * offset > sq_limit * sq_extent_[static_cast<Eigen::Index>(axis)])
    return true;
  // Across the axes of the metric: the image of the box lies between two planes.
  double sq_dist = 0.0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    double least = 0.0, most = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double factor = metric_(i, static_cast<Eigen::Index>(j));
      if (factor == 0.0) // the box may be infinite
        continue;
      const double a = factor * low[j], b = factor * high[j];
      least += std::min(a, b);
      most += std::max(a, b);
    }
    const double gap = std::max({0.0, least, -most});
    sq_dist += gap * gap;
  }
  return sq_dist > sq_limit;
}

void
MetricFinder::consider(std::uint32_t sample)
{
  const Position& x = samples_.getPositions()[sample];
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis)
    offset[axis] = static_cast<double>(x[axis]) - point_[axis];
  const std::pair<double, std::uint32_t> found((metric_ * offset).squaredNorm(),
                                               sample);
  if (nearest_.size() == k_) {
    if (!(found < nearest_.front()))
      return;
    std::pop_heap(nearest_.begin(), nearest_.end());
    nearest_.pop_back();
  }
  nearest_.push_back(found);
  std::push_heap(nearest_.begin(), nearest_.end());
}

void
MetricFinder::descend(const KdTree& tree, const KdNode& node, Corner& low, Corner& high)
{
  if (node.count <= whole_subtree) {
    for (std::uint32_t i = 0; i < node.count; ++i)
      consider(node.begin + i);
    return;
  }
  const int axis = tree.getAxis(node.depth);
  const auto a = static_cast<std::size_t>(axis);
  const double plane =
      static_cast<double>(tree.getPlane(node).coordinate) - point_[axis];
  const auto descendTo = [&](bool below, bool is_near) {
    double& face = below ? high[a] : low[a];
    const double old_face = std::exchange(face, plane);
    if (is_near || !isTooFar(a, low, high))
      descend(tree, below ? node.left() : node.right(), low, high);
    face = old_face;
  };
  descendTo(plane >= 0.0, true);
  descendTo(plane < 0.0, false);
}

const std::vector<std::uint32_t>&
MetricFinder::find(const Position& point, const Eigen::Matrix3d& metric)
{
  point_ = point;
  metric_ = metric;
  const Eigen::Matrix3d inverse = metric.inverse();
  sq_extent_ = inverse.rowwise().squaredNorm();
  nearest_.clear();
  const KdTree& own = samples_.getTree();
  const auto search = [&](const KdTree& tree) {
    Corner low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = point[static_cast<int>(axis)];
      low[axis] = tree.getCell().low[axis].coordinate - place;
      high[axis] = tree.getCell().high[axis].coordinate - place;
    }
    if (!isTooFar(0, low, high))
      descend(tree, tree.getRoot(), low, high);
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
