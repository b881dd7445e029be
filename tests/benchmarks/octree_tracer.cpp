// SPDX-License-Identifier: BSD-3-Clause
#include "octree_tracer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace uvol_bench {

namespace {

constexpr std::uint32_t inner = 0xffffffffu;

/** Splits stop here: equal centres would split forever. */
constexpr int deepest = 20;

/** Share of half the root's side; a hit is rounded by about 1e-6 of its distance. */
constexpr float relative_margin = 1e-5f;

} // namespace

OctreeTracer::OctreeTracer(const pcl::PointCloud<pcl_uvol::PointSplat>& splats,
                           std::size_t threshold)
    : PeerTracer(splats)
{
  Eigen::Vector3f low = Eigen::Vector3f::Constant(infinity), high = -low;
  for (const pcl_uvol::PointSplat& splat : splats) {
    low = low.cwiseMin((splat.getVector3fMap().array() - splat.radius).matrix());
    high = high.cwiseMax((splat.getVector3fMap().array() + splat.radius).matrix());
  }
  if (splats.empty())
    low = high = Eigen::Vector3f::Zero();
  half_ = 0.5f * (high - low).maxCoeff() * (1.0f + 4.0f * relative_margin);
  margin_ = relative_margin * half_;

  // The structure comes from the centres alone; one by one or all at once, a cell is
  // split if it gets more of them than the threshold.
  nodes_.push_back({0.5f * (low + high), 0, 0});
  std::vector<std::uint32_t> order(splats.size());
  std::iota(order.begin(), order.end(), 0u);
  split(0, half_, 0, order.data(), order.data() + order.size(), threshold);

  for (const pcl_uvol::PointSplat& splat : splats)
    visitLeaves(splat, 0, half_, [&](std::uint32_t leaf) { ++nodes_[leaf].count; });
  std::uint32_t first = 0;
  for (Node& node : nodes_)
    if (node.count != inner) {
      node.first = first;
      first += node.count;
      node.count = 0;
    }
  leaf_splats_.resize(first);
  for (std::uint32_t i = 0; i < splats.size(); ++i)
    visitLeaves(splats[i], 0, half_, [&](std::uint32_t leaf) {
      leaf_splats_[nodes_[leaf].first + nodes_[leaf].count++] = i;
    });
}

void
OctreeTracer::split(std::uint32_t node,
                    float half,
                    int depth,
                    std::uint32_t* begin,
                    std::uint32_t* end,
                    std::size_t threshold)
{
  if (static_cast<std::size_t>(end - begin) <= threshold || depth == deepest)
    return;
  const Eigen::Vector3f center = nodes_[node].center;
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = first;
  nodes_[node].count = inner;
  nodes_.resize(nodes_.size() + 8);
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    Node& child = nodes_[first + octant];
    child = {center, 0, 0};
    for (int axis = 0; axis < 3; ++axis)
      child.center[axis] += (octant >> axis & 1u) != 0 ? 0.5f * half : -0.5f * half;
    std::uint32_t* const middle = std::partition(begin, end, [&](std::uint32_t i) {
      std::uint32_t side = 0;
      for (int axis = 0; axis < 3; ++axis)
        side |= static_cast<std::uint32_t>(splats_[i].data[axis] >= center[axis])
                << axis;
      return side == octant;
    });
    split(first + octant, 0.5f * half, depth + 1, begin, middle, threshold);
    begin = middle;
  }
}

template <typename Visit>
void
OctreeTracer::visitLeaves(const pcl_uvol::PointSplat& splat,
                          std::uint32_t node,
                          float half,
                          const Visit& visit) const
{
  const float radius = splat.radius + margin_;
  const Eigen::Vector3f offset = nodes_[node].center - splat.getVector3fMap();
  if (offset.cwiseAbs().maxCoeff() > half + radius)
    return;
  if (nodes_[node].count == inner) {
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      visitLeaves(splat, nodes_[node].first + octant, 0.5f * half, visit);
    return;
  }
  // The square is apart from the cell along its normal or a side; what only a pair of
  // edges would tell apart is stored in vain, no more.
  const Eigen::Vector3f u = splat.getTangentVector3fMap(),
                        n = splat.getNormalVector3fMap(), v = n.cross(u);
  const auto isApart = [&](const Eigen::Vector3f& axis, float extent) {
    return std::abs(axis.dot(offset)) > half * axis.lpNorm<1>() + extent;
  };
  if (!isApart(n, margin_) && !isApart(u, radius) && !isApart(v, radius))
    visit(node);
}

template <typename Visit>
void
OctreeTracer::walk(const Eigen::Vector3f& origin,
                   const Eigen::Vector3f& direction,
                   const Visit& visit) const
{
  // A ray along an axis gets a sliver of the others, so that no distance is NaN.
  Eigen::Vector3f inverse;
  for (int axis = 0; axis < 3; ++axis)
    inverse[axis] =
        1.0f / (std::abs(direction[axis]) < 1e-20f ? 1e-20f : direction[axis]);
  const Eigen::Array3f middle = (nodes_[0].center - origin).array() * inverse.array();
  const Eigen::Array3f reach = half_ * inverse.array().abs();

  struct Piece {
    std::uint32_t node;
    float enter, leave;
  };
  Piece stack[3 * deepest + 1]; // a level leaves three of its four pieces waiting
  int size = 0;
  Piece piece = {
      0, std::max(0.0f, (middle - reach).maxCoeff()), (middle + reach).minCoeff()};
  if (!(piece.enter < piece.leave))
    return;
  float limit = infinity;
  for (;;) {
    while (nodes_[piece.node].count == inner) {
      const Node& node = nodes_[piece.node];
      float crossing[3];
      std::uint32_t octant = 0;
      for (int axis = 0; axis < 3; ++axis) {
        crossing[axis] = (node.center[axis] - origin[axis]) * inverse[axis];
        const bool is_past = crossing[axis] <= piece.enter;
        if (is_past == (inverse[axis] > 0.0f))
          octant |= 1u << axis;
        if (is_past)
          crossing[axis] = infinity;
      }
      Piece parts[4];
      int count = 0;
      for (float enter = piece.enter;;) {
        int next = -1;
        float leave = piece.leave;
        for (int axis = 0; axis < 3; ++axis)
          if (crossing[axis] < leave) {
            leave = crossing[axis];
            next = axis;
          }
        parts[count++] = {node.first + octant, enter, leave};
        if (next < 0)
          break;
        crossing[next] = infinity;
        octant ^= 1u << next;
        enter = leave;
      }
      while (count > 1)
        stack[size++] = parts[--count];
      piece = parts[0];
    }
    const Node& leaf = nodes_[piece.node];
    if (leaf.count > 0)
      limit = visit(leaf, piece.enter, piece.leave);
    if (size == 0)
      return;
    piece = stack[--size];
    if (piece.enter > limit)
      return;
  }
}

void
OctreeTracer::collect(const PeerRay& ray, Hits& hits) const
{
  walk(ray.origin, ray.direction, [&](const Node& leaf, float enter, float leave) {
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const pcl_uvol::PointSplat& splat = splats_[leaf_splats_[i]];
      float distance, sq_offset;
      // A hit outside this leaf is the business of another leaf with this splat.
      if (meetDisc(splat, ray, std::min(leave, hits.limit), distance, sq_offset) &&
          distance >= enter && distance < leave)
        hits.add({distance, sq_offset, leaf_splats_[i]}, splat.radius);
    }
    return hits.limit;
  });
}

bool
OctreeTracer::isBlocked(const PeerRay& ray) const
{
  bool is_blocked = false;
  walk(ray.origin, ray.direction, [&](const Node& leaf, float, float) {
    float distance, sq_offset;
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
      if (meetDisc(splats_[leaf_splats_[i]], ray, infinity, distance, sq_offset)) {
        is_blocked = true;
        return -infinity;
      }
    return infinity;
  });
  return is_blocked;
}

} // namespace uvol_bench
