// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/cell_search.h"

#include "neighbors/kernel_tables.h"
#include "neighbors/nearest_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

/** Half the side of the cube in diagonals of the samples' box. */
constexpr double cube_size = 256.0;

/** Share of squared distances: rounding of vertices. */
constexpr double vertex_slack = 1e-11;

/** What is farther than the farthest of the nearest in float may be that much nearer.
 */
constexpr double float_rounding = 1.0 - 1e-6;

/** A bound of squared distances in float, from a place that is rounded to float as
 * well: of samples in a ball none exceeds it. */
float
boundInFloat(const Query& center, double sq_radius)
{
  const double radius = std::sqrt(sq_radius),
               size = std::max({std::abs(center.x[0]),
                                std::abs(center.x[1]),
                                std::abs(center.x[2]),
                                radius}),
               bound = radius + std::ldexp(size, -20);
  return static_cast<float>(bound * bound / float_rounding);
}

} // namespace

CellSearch::CellSearch(const SampleSet& samples)
    : samples_(samples)
    , kernels_(nearest_kernel_table.get())
{
}

void
CellSearch::start(const Query& place,
                  std::uint32_t own,
                  const std::uint32_t* near,
                  std::size_t count)
{
  place_ = place;
  own_ = own;
  by_distance_.resize(count);
  std::transform(near, near + count, by_distance_.begin(), [&](std::uint32_t sample) {
    const auto sq_dist =
        static_cast<float>(sqDistance(place, samples_.getPositions()[sample]));
    std::uint32_t bits; // of numbers that are not negative, ascending as they are
    std::memcpy(&bits, &sq_dist, sizeof bits);
    return static_cast<std::uint64_t>(bits) << 32 | sample;
  });
  std::sort(by_distance_.begin(), by_distance_.end());
  near_.resize(count);
  std::transform(by_distance_.begin(), by_distance_.end(), near_.begin(), [](auto key) {
    return static_cast<std::uint32_t>(key);
  });
  sq_known_ = float_rounding * offsetOf(near_.back()).squaredNorm();
}

double
CellSearch::getHalfSide() const
{
  const KdBox box = samples_.getTree().getBox(samples_.getTree().getRoot());
  double sq_size = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis], high = box.high[axis];
    const double along = std::max(high, place_.x[axis]) - std::min(low, place_.x[axis]);
    sq_size += along * along;
  }
  return cube_size * std::sqrt(sq_size);
}

Vector3d
CellSearch::offsetOf(std::uint32_t sample) const
{
  const Position& position = samples_.getPositions()[sample];
  return {static_cast<double>(position[0]) - place_.x[0],
          static_cast<double>(position[1]) - place_.x[1],
          static_cast<double>(position[2]) - place_.x[2]};
}

bool
CellSearch::findInBall(const Vector3d& vertex, std::uint32_t& found) const
{
  const KdTree& tree = samples_.getTree();
  const std::vector<Position>& positions = samples_.getPositions();
  const Query center{
      {place_.x[0] + vertex[0], place_.x[1] + vertex[1], place_.x[2] + vertex[2]}};
  double sq_least = (1.0 - vertex_slack) * vertex.squaredNorm();
  bool is_found = false;
  const auto sqGap = [&](const KdNode& node) {
    const KdBox& box = tree.getBox(node);
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double below = static_cast<double>(box.low[axis]) - center.x[axis],
                   above = center.x[axis] - static_cast<double>(box.high[axis]);
      const double gap = std::max(std::max(below, above), 0.0);
      sum += gap * gap;
    }
    return sum;
  };
  // Most buckets that reach into the ball have no sample in it.
  const Position rounded = center.toPosition();
  float most = boundInFloat(center, sq_least);
  std::array<float, KdTree::bucket_samples + kernel_room> sq_dists;
  const auto mayHold = [&](const KdNode& bucket) {
    kernels_->measureRun(positions.front().x,
                         bucket.begin,
                         bucket.begin + bucket.count,
                         rounded.x,
                         sq_dists.data());
    return kernels_->countWithin(sq_dists.data(), bucket.count, most) > 0;
  };
  std::pair<KdNode, double> stack[64];
  std::size_t depth = 0;
  KdNode node = tree.getRoot();
  double sq_gap = sqGap(node);
  for (;;) {
    while (sq_gap < sq_least && !KdTree::isBucket(node)) {
      KdNode nearer = node.left(), farther = node.right();
      double to_nearer = sqGap(nearer), to_farther = sqGap(farther);
      if (to_farther < to_nearer) {
        std::swap(nearer, farther);
        std::swap(to_nearer, to_farther);
      }
      if (to_farther < sq_least)
        stack[depth++] = {farther, to_farther};
      node = nearer;
      sq_gap = to_nearer;
    }
    if (sq_gap < sq_least && mayHold(node)) {
      for (std::uint32_t i = node.begin; i < node.begin + node.count; ++i) {
        const double sq_dist = sqDistance(center, positions[i]);
        if (sq_dist >= sq_least || i == own_)
          continue;
        sq_least = sq_dist;
        found = i;
        is_found = true;
      }
      most = boundInFloat(center, sq_least);
    }
    if (depth == 0)
      break;
    std::tie(node, sq_gap) = stack[--depth];
  }
  return is_found;
}

} // namespace pcl_uvol::detail
