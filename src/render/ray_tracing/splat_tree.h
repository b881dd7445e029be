// SPDX-License-Identifier: BSD-3-Clause
// Splats of one object, in a tree of boxes with sixteen children each: what the octree
// of thesis 4.2.2 is for. Every splat is in one leaf only, boxes fit tightly, and a ray
// meets sixteen of them, or of the splats in a leaf, at once;
// tests/benchmarks/README.md has the octree's times beside those of this tree.
#pragma once

#include "render/ray_tracing/splat_tree_kernel.h"
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Core>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace pcl_uvol {

struct WideTree;

/** \brief A splat in the order of the tree: one line of the cache. */
struct alignas(64) SplatRecord {
  float center[3], normal[3], tangent[3];
  float radius;
  float tilt[2], slope[2];
  float thickness; ///< how far the surface may be off the disc
  Rgba color;
};

/** \brief The surface that a ray starts on. */
struct RayStart {
  int splat_object = -1; ///< in the scene; -1: it is not one of splats
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< on the side of the ray
  bool is_outside = true;                           ///< this side
};

/** \brief A ray in the scene. */
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction; ///< of length 1
  /** Splats that look away from it are not met; null: all are. */
  const Eigen::Vector3d* eye = nullptr;
  RayStart start = {};
};

/** \brief Where a ray meets a surface of splats. */
struct SplatSurfaceHit {
  double distance;
  Eigen::Vector3d normal;       ///< averaged over all splats there, of length 1
  Eigen::Vector3d plane_normal; ///< of the splat that the hit lies on
  Eigen::Vector3d color;        ///< averaged as well
  double thickness;             ///< of the layer of splats there
  double bend; ///< sine of the angle that the surface's normals turn by within the
               ///< splat, at most 0.1
};

/** \brief Built once. Memory: about 200 bytes per splat, and 32 to 512 per splat that
 * ends at a rim. */
class SplatTree {
public:
  /** \param step of the splats */
  SplatTree(const SplatObject& object, unsigned threads, StepTimer& step);

  /** \brief The first hit of a ray.
   * \param leaves_surface it starts on this surface: splats that lie over one another
   * there are not met near the start
   * \param hits work space, which grows to what rays need
   * \return false if there is none before far */
  bool
  intersect(const Ray& ray,
            bool leaves_surface,
            double near,
            double far,
            std::vector<SplatHit>& hits,
            SplatSurfaceHit& hit) const;

  /** \brief True if something lies between two distances on a ray.
   * \param leaves_surface as in intersect() */
  bool
  isBlocked(const Ray& ray, bool leaves_surface, double near, double far) const;

  /** \brief A ball around all splats. */
  BoundingSphere
  bounds() const
  {
    return {center_, radius_};
  }

private:
  /** Hits of a ray, among others. */
  struct HitRange {
    std::size_t begin, end;
  };

  /** Add all hits of a ray that may count, see SplatTreeKernels::collect.
   * \param begin where they are put */
  HitRange
  collect(const TreeRay& ray,
          float part,
          std::size_t begin,
          std::vector<SplatHit>& hits) const;

  /** The nearest hit, and the distance behind which hits are on other surfaces. */
  std::pair<const SplatHit*, float>
  findFirst(const std::vector<SplatHit>& hits, const HitRange& range) const;

  /** True for a hit of the back of a splat. */
  bool
  isBehind(const TreeRay& ray, const SplatHit& hit) const;

  /** True for a hit of a splat that looks away from the eye. */
  bool
  looksAway(const TreeRay& ray, const SplatHit& hit) const;

  /** Where a ray has slipped through between splats that look to its start and lie
   * around it, and has met what is behind: those that it misses. Empty for others.
   * \param first that it meets */
  HitRange
  findAround(const TreeRay& ray,
             const SplatHit& first,
             std::vector<SplatHit>& hits,
             std::size_t begin) const;

  /** True if the centres of splats lie on all sides of a ray. */
  bool
  surround(const TreeRay& ray,
           const std::vector<SplatHit>& hits,
           const HitRange& range) const;

  /** True if a splat lies not far behind one in front of it, and the ray hardly misses
   * that one. */
  bool
  isCloseBehind(const SplatHit& back,
                const std::vector<SplatHit>& hits,
                const HitRange& range) const;

  /** Distance at which a ray comes into the ball around all splats, 0 within it;
   * nothing if it does not. */
  std::optional<double>
  findEntry(const Ray& ray, double near, double far) const;

  /** The ray from its entry on: float would not hold distances from far away. */
  TreeRay
  localRay(
      const Ray& ray, bool leaves_surface, double entry, double near, double far) const;

  /** \param rims of the splats, in their order
   * \param tree that tells which splats are in which leaf */
  void
  addRims(const std::vector<std::uint32_t>& rims, const WideTree& tree);

  TreeArrays
  arrays() const
  {
    return {nodes_.data(),
            leaves_.data(),
            rims_.empty() ? nullptr : rims_of_leaf_.data(),
            rims_.data()};
  }

  const SplatTreeKernels* kernels_;
  Eigen::Vector3d center_; ///< the coordinates of the arrays are relative to it
  double radius_ = 0.0;
  bool two_sided_;
  std::vector<TreeNode> nodes_;
  std::vector<TreeLeaf> leaves_;
  std::vector<SplatRecord> splats_; ///< tree_width per leaf
  std::vector<std::uint32_t> rims_of_leaf_;
  std::vector<LeafRims> rims_; ///< of the leaves that have some
};

} // namespace pcl_uvol
