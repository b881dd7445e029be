// SPDX-License-Identifier: BSD-3-Clause
// What the ray tracer draws: splats, spheres and planes with their materials, lights
// and background (thesis 4.2.2).
#pragma once

#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/lighting.h>

#include <Eigen/Core>
#include <pcl/point_cloud.h>

#include <vector>

namespace pcl_uvol {

/** \brief A material that may mirror and let light through. What it neither mirrors nor
 * lets through is ambient and diffuse reflection. */
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

} // namespace pcl_uvol
