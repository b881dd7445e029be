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

/** A ray, and the normal, on its side, of the surface that it starts on, 0 for others.
 */
struct PeerRay {
  Eigen::Vector3f origin, direction;
  Eigen::Vector3f own_normal = Eigen::Vector3f::Zero();
};

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

  /** Distance to a disc, and squared distance to its centre; false if it is missed, or
   * belongs to the surface that the ray starts on, by the rule of our tracer. */
  static bool
  meetDisc(const pcl_uvol::PointSplat& splat,
           const PeerRay& ray,
           float farthest,
           float& distance,
           float& sq_offset)
  {
    const Eigen::Vector3f &origin = ray.origin, &direction = ray.direction;
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
    return sq_offset <= splat.radius * splat.radius &&
           !isOwn(splat, ray, distance, across);
  }

  const pcl::PointCloud<pcl_uvol::PointSplat>& splats_;

private:
  static bool
  isOwn(const pcl_uvol::PointSplat& splat,
        const PeerRay& ray,
        float distance,
        float rise)
  {
    const float alignment = splat.normal_x * ray.own_normal[0] +
                            splat.normal_y * ray.own_normal[1] +
                            splat.normal_z * ray.own_normal[2];
    const bool comes_out = alignment * rise > 0.0f;
    const float least = comes_out ? 0.25f : 0.7f, reach = comes_out ? 3.0f : 1.0f;
    return alignment * alignment > least * least && distance < reach * splat.radius;
  }

  /** Adds every hit of the first surface, each splat once. */
  virtual void
  collect(const PeerRay& ray, Hits& hits) const = 0;

  virtual bool
  isBlocked(const PeerRay& ray) const = 0;

  /** \param plane_normal of the splat that the place lies on */
  bool
  intersect(const PeerRay& ray,
            Eigen::Vector3f& place,
            Eigen::Vector3f& normal,
            Eigen::Vector3f& plane_normal) const;
};

} // namespace uvol_bench
