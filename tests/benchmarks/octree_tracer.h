// SPDX-License-Identifier: BSD-3-Clause
// Splats ray traced through the octree of thesis section 4.2.2, the older peer of our
// ray tracer.
#pragma once

#include "peer_tracer.h"

#include <cstdint>
#include <vector>

namespace uvol_bench {

class OctreeTracer : public PeerTracer {
public:
  /** \param threshold centres that a leaf holds at most */
  explicit OctreeTracer(const pcl::PointCloud<pcl_uvol::PointSplat>& splats,
                        std::size_t threshold);

private:
  /** An inner node (count is the mark) has eight children from first on, a leaf the
   * entries [first, first + count) of leaf_splats_. */
  struct Node {
    Eigen::Vector3f center;
    std::uint32_t first, count;
  };

  void
  split(std::uint32_t node,
        float half,
        int depth,
        std::uint32_t* begin,
        std::uint32_t* end,
        std::size_t threshold);

  /** Calls visit(leaf) for the leaves that a splat may touch. */
  template <typename Visit>
  void
  visitLeaves(const pcl_uvol::PointSplat& splat,
              std::uint32_t node,
              float half,
              const Visit& visit) const;

  /** Calls visit(leaf, enter, leave) for the leaves along a ray, front to back, until
   * one begins behind the distance that the last call returned. The distances of
   * consecutive leaves are the same float, so each hit lies in one leaf only. */
  template <typename Visit>
  void
  walk(const Eigen::Vector3f& origin,
       const Eigen::Vector3f& direction,
       const Visit& visit) const;

  void
  collect(const PeerRay& ray, Hits& hits) const override;

  bool
  isBlocked(const PeerRay& ray) const override;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_splats_;
  float half_ = 0.0f;   ///< half a side of the root
  float margin_ = 0.0f; ///< rounding that a hit may lie off its disc
};

} // namespace uvol_bench
