// SPDX-License-Identifier: BSD-3-Clause
// A scene that rays can be sent through.
#pragma once

#include "render/ray_tracing/splat_tree.h"
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Core>

#include <vector>

namespace pcl_uvol {

/** \brief Where a ray meets a surface. */
struct SurfaceHit {
  double distance;
  Eigen::Vector3d position;
  /** Normals of length 1, to the outside: as it is shaded, and as it is. @{ */
  Eigen::Vector3d normal, plane_normal;
  /** @} */
  Eigen::Vector3d color;
  const RayMaterial* material;
  /** Rays that start here have to start so far off the surface. */
  double lift;
  /** Cosine up to which a ray that comes from behind is one that grazes the outside: on
   * an outline splats stand out from their surface. */
  double grazing;
  /** The object of splats that it belongs to; -1 for another one. */
  int splat_object;
};

/** \brief The objects of a scene. */
class World {
public:
  /** \param scene is taken over, but not by a construction that throws
   * \param report gets the time and progress of "build" */
  World(Scene&& scene, unsigned threads, Report& report);

  const Scene&
  scene() const
  {
    return scene_;
  }

  const BoundingSphere&
  bounds() const
  {
    return bounds_;
  }

  /** \brief The first hit of a ray; false if there is none.
   * \param hits work space */
  bool
  intersect(const Ray& ray, std::vector<SplatHit>& hits, SurfaceHit& hit) const;

  /** \brief Part of the light that comes along a ray from that distance: every object
   * in between lets its transparency through. */
  double
  transmission(const Ray& ray, double distance) const;

  /** \brief True if anything lies on a ray up to that distance. */
  bool
  isBlocked(const Ray& ray, double distance) const;

private:
  /** As SplatTree::isBlocked. */
  bool
  isBlockedBy(std::size_t splat_object, const Ray& ray, double distance) const;

  /** A splat that a ray starts on, to rounding, is not met. */
  double
  near() const
  {
    return 0.5 * rounding_;
  }

  Scene scene_;
  std::vector<SplatTree> trees_;
  BoundingSphere bounds_;
  double rounding_; ///< lift of all rays
};

} // namespace pcl_uvol
