// SPDX-License-Identifier: BSD-3-Clause
// What the peers of our ray tracer share: shading, shadows, mirrors and averaging as
// ours, in plain floats. A peer brings only the search for hits.
#pragma once

#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Core>
#include <pcl/point_cloud.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace uvol_bench {

constexpr float infinity = std::numeric_limits<float>::infinity();

/** Depth of the first surface behind a hit, in radii of its splat. */
constexpr float part_of_radius = 0.5f;

class PeerTracer {
public:
  explicit PeerTracer(const pcl::PointCloud<pcl_uvol::PointSplat>& splats)
      : splats_(splats)
  {
  }
  virtual ~PeerTracer() = default;
  PeerTracer(const PeerTracer&) = delete;
  PeerTracer&
  operator=(const PeerTracer&) = delete;

  /** One directional light from the eye's left shoulder.
   * \param mirrored part of the light that every surface mirrors */
  void
  render(const pcl_uvol::Camera& camera,
         int size,
         int depth,
         float mirrored,
         unsigned threads,
         pcl_uvol::Image& image) const;

protected:
  struct Hit {
    float distance, sq_offset;
    std::uint32_t splat;
  };

  /** Hits of one ray in any order, those beyond the limit of no account. */
  struct Hits {
    /** Hits of a ray, at most. */
    static constexpr int most = 128;

    Hit items[most];
    int count = 0;
    float limit = infinity; ///< end of the first surface, as far as it is known

    void
    add(const Hit& hit, float radius)
    {
      limit = std::min(limit, hit.distance + part_of_radius * radius);
      if (count == most)
        count = static_cast<int>(
            std::remove_if(items,
                           items + count,
                           [&](const Hit& old) { return old.distance > limit; }) -
            items);
      if (count < most)
        items[count++] = hit;
    }
  };

  /** Distance to a disc, and squared distance to its centre; false if it is missed. */
  static bool
  meetDisc(const pcl_uvol::PointSplat& splat,
           const Eigen::Vector3f& origin,
           const Eigen::Vector3f& direction,
           float farthest,
           float& distance,
           float& sq_offset)
  {
    const float ox = splat.x - origin[0], oy = splat.y - origin[1],
                oz = splat.z - origin[2];
    const float along = splat.normal_x * ox + splat.normal_y * oy + splat.normal_z * oz;
    const float across = splat.normal_x * direction[0] + splat.normal_y * direction[1] +
                         splat.normal_z * direction[2];
    distance = along / across;
    if (!(distance >= 0.0f && distance <= farthest))
      return false;
    const float dx = distance * direction[0] - ox, dy = distance * direction[1] - oy,
                dz = distance * direction[2] - oz;
    sq_offset = dx * dx + dy * dy + dz * dz;
    return sq_offset <= splat.radius * splat.radius;
  }

  const pcl::PointCloud<pcl_uvol::PointSplat>& splats_;

private:
  /** Adds every hit of the first surface, each splat once. */
  virtual void
  collect(const Eigen::Vector3f& origin,
          const Eigen::Vector3f& direction,
          Hits& hits) const = 0;

  virtual bool
  isBlocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const = 0;

  bool
  intersect(const Eigen::Vector3f& origin,
            const Eigen::Vector3f& direction,
            Eigen::Vector3f& place,
            Eigen::Vector3f& normal) const;
};

} // namespace uvol_bench
