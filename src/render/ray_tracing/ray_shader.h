// SPDX-License-Identifier: BSD-3-Clause
// Colours of rays: light, shadows, mirrors and glass (thesis 4.2.2).
#pragma once

#include "render/ray_tracing/world.h"
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Rays that were sent. */
struct RayCounts {
  std::uint64_t primary = 0, secondary = 0, shadow = 0;
};

/** \brief What comes along a primary ray. */
struct ShadedRay {
  Eigen::Vector4d color; ///< red, green, blue and opacity
  /** Normal of the surface it meets, to the outside; 0 if it meets none. */
  Eigen::Vector3d normal;
};

/** \brief Shades one ray after another; one object per thread. */
class RayShader {
public:
  /** \param world must outlive the shader
   * \param camera as well: lights follow it, and what looks away from it is culled */
  RayShader(const World& world,
            const RayTracingSettings& settings,
            const Camera& camera);

  /** \brief
   * \param height of the pixel in the image, 0 below to 1 above, for the background
   * \param number of the ray, for what is random about it */
  ShadedRay
  shade(const Ray& ray, double height, std::uint64_t number);

  const RayCounts&
  counts() const
  {
    return counts_;
  }

private:
  /** A ray that is still to be looked at. */
  struct Pending {
    Ray ray;
    Eigen::Vector3d weight; ///< of its colour in the pixel's
    int depth;
  };

  /** The surface where a ray meets it, seen from the ray's side. */
  struct Seen {
    SurfaceHit hit;
    Eigen::Vector3d towards_eye, normal, plane_normal;
    bool from_outside;
  };

  /** Of a ray to the side that is seen. */
  static RayStart
  startOn(const Seen& seen);

  Eigen::Vector3d
  backgroundAt(double height) const;

  /** Ambient, diffuse and specular reflection. */
  Eigen::Vector3d
  reflectLight(const Seen& seen);

  /** What of a light reaches a place, in [0, 1].
   * \param towards a vector to its centre */
  double
  visibility(const Light& light, const Seen& seen, const Eigen::Vector3d& towards);

  /** What of the ambient light reaches a place, in [0, 1]. */
  double
  openness(const Seen& seen);

  /** Put aside the rays that are mirrored and let through. */
  void
  sendOn(const Seen& seen, const Pending& from);

  void
  send(const Seen& seen,
       const Eigen::Vector3d& direction,
       bool to_same_side,
       const Eigen::Vector3d& weight,
       int depth);

  /** The next random number, in [0, 1). */
  double
  random();

  const World& world_;
  const RayTracingSettings& settings_;
  std::vector<Light> lights_;  ///< none follows the camera
  const Eigen::Vector3d* eye_; ///< see Ray
  double occlusion_distance_;
  std::vector<SplatHit> hits_;
  std::vector<Pending> pending_;
  std::uint64_t ray_number_ = 0, draws_ = 0;
  RayCounts counts_;
};

} // namespace pcl_uvol
