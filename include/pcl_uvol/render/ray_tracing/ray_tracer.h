// SPDX-License-Identifier: BSD-3-Clause
// Splat-based ray tracing (thesis 4.2.2): shadows, mirrors and glass; and what is
// drawn: splats, spheres and planes with their materials, lights and background.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Core>
#include <pcl/point_cloud.h>

#include <memory>
#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief A material that may reflect light like a mirror and transmit it. The rest of
 * the light is ambient and diffuse reflection. */
struct RayMaterial : Material {
  double reflectivity = 0.0; ///< part of the light that is mirrored, in [0, 1]
  /** Part that is let through, in [0, 1]; not more than 1 with the reflectivity. At a
   * refractive index other than 1 Fresnel's part of it is mirrored instead. */
  double transparency = 0.0;
  double refractive_index = 1.0; ///< of the inside over the outside, > 0
};

/** \brief A surface covered by splats. */
struct SplatObject {
  pcl::PointCloud<PointSplat>::ConstPtr splats;
  std::vector<Rgba> colors; ///< one per splat; empty: that of the material
  RayMaterial material;
  bool two_sided = false; ///< its normals have no meaningful sign: nothing is culled
  /** What ends splats at the rims of the surface, one per splat, as
   * SplatGeneration::getRims() gives it; empty: all are whole discs. */
  std::vector<std::uint32_t> rims;
};

/** \brief A ball. */
struct SphereObject {
  Eigen::Vector3d center{0.0, 0.0, 0.0};
  double radius = 1.0; ///< > 0
  RayMaterial material;
};

/** \brief An infinite plane. */
struct PlaneObject {
  Eigen::Vector3d point{0.0, 0.0, 0.0};
  Eigen::Vector3d normal{0.0, 0.0, 1.0}; ///< of any length but zero
  RayMaterial material;
  double square = 0.0; ///< side of the squares of a chessboard; 0: one colour
  Color other_color{0.2f, 0.2f, 0.2f}; ///< of every other square
};

/** \brief Everything that is seen; coordinates are those of the splats. */
struct Scene {
  std::vector<SplatObject> splats;
  std::vector<SphereObject> spheres;
  std::vector<PlaneObject> planes;
  std::vector<Light> lights = defaultLights();
  Background background;
};

class World;

/** \brief What rays do. */
struct RayTracingSettings {
  /** Reflections and refractions in a row, at most; 0: primary and shadow rays alone.
   */
  int depth = 4;
  bool shadows = true;
  /** Shadow rays to a light that has a radius, in [1, 4096]. */
  int light_samples = 16;
  /** Rays per hit that find how much of the surroundings is near; 0 (default): ambient
   * light reaches everywhere. At most 4096. */
  int occlusion_samples = 0;
  /** What is farther away does not take ambient light; a length, 0 (default): a fifth
   * of the radius of the scene. */
  double occlusion_distance = 0.0;
  /** Ignore splats that face away from the eye: no ray meets them. */
  bool cull_back_faces = false;
};

/** \brief Pictures of splats, spheres and planes.
 *
 * \code
 * pcl_uvol::RayTracer tracer;
 * tracer.setScene(scene);
 * pcl_uvol::Image image;
 * tracer.render(image);
 * \endcode
 * All splats of an object that a ray meets close behind the first one are one hit: it
 * lies on the splat whose centre is the nearest, in radii (Figure 4.4), and its normal
 * and colour are averaged over them, weighted by 1 - |(u, v)|. The search structure is
 * built at the first picture. The picture does not depend on the number of threads. */
class PCL_UVOL_EXPORTS RayTracer : public Renderer {
public:
  using Ptr = std::shared_ptr<RayTracer>;
  using ConstPtr = std::shared_ptr<const RayTracer>;

  RayTracer();
  ~RayTracer();

  /** \brief What to draw.
   * \throws InvalidArgument for a scene without objects, a material, light or shape out
   * of its range, a splat that is not finite, another number of colours or rims than of
   * splats */
  void
  setScene(const Scene& scene);

  /** \brief Fill in the normals of the surfaces, to the outside, as well; default:
   * colour alone. */
  void
  setNormalPlane(bool has_normals)
  {
    has_normals_ = has_normals;
  }

  /** \return Whether normals are filled in. */
  bool
  hasNormalPlane() const
  {
    return has_normals_;
  }

  /** \return What rays do; checked by render(). */
  RayTracingSettings&
  settings()
  {
    return settings_;
  }

  /** \brief A ball around all splats and spheres: for cameras. A scene of planes alone
   * gives a ball of radius 1 about the first one's point.
   * \throws InvalidArgument without a scene */
  BoundingSphere
  getBounds();

  /** \brief Draw: colour, and normals where they are asked for. Counts of the report:
   * primary_rays, secondary_rays, shadow_rays.
   * \param image gets the pixels
   * \throws InvalidArgument without a scene, for a bad camera, size or setting; the
   * image is then untouched */
  void
  render(Image& image);

private:
  const World&
  build();

  std::optional<Scene> scene_; ///< until the search structure is built
  std::unique_ptr<World> world_;
  Report build_report_;
  bool has_normals_ = false;
  RayTracingSettings settings_;
};

} // namespace pcl_uvol
