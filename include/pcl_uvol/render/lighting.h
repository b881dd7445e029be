// SPDX-License-Identifier: BSD-3-Clause
// Colours, materials, lights and background: the Blinn-Phong model that both renderers
// shade with (thesis 4.2.2, 4.3.1).
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl_uvol {

/** \brief Red, green, blue; 1 is full intensity, larger values are cut off when an
 * image is written. */
struct Color {
  float r = 0.0f, g = 0.0f, b = 0.0f;
};

/** \brief Reflection of a surface (Blinn 1977): ambient, diffuse and specular part,
 * each a factor of the colour of surface (ambient, diffuse) or light (specular). */
struct Material {
  Color color{0.80f, 0.78f, 0.74f}; ///< of points without a colour of their own
  double ambient = 0.18;
  double diffuse = 0.75;
  double specular = 0.22;
  double shininess = 40.0; ///< exponent, >= 0
};

/** \brief A light without attenuation. */
struct Light {
  enum class Kind { Directional, Point };
  Kind kind = Kind::Directional;
  /** Moves with the camera: coordinates are then x right, y up, z towards the viewer.
   */
  bool follows_camera = true;
  /** Directional: where it comes from, of any length; point: where it is, in units of
   * the cloud. */
  Eigen::Vector3d position{-0.4, 0.5, 0.8};
  Color color{1.0f, 1.0f, 1.0f};
  /** The radius of a source that casts soft shadows: a length, or of a directional
   * light the tangent of the angle that it is seen at. 0 (default): hard shadows. Image
   * space casts none. */
  double radius = 0.0;
};

/** \brief What is behind the surface. */
struct Background {
  enum class Kind { Plain, Gradient, Transparent };
  Kind kind = Kind::Plain;
  Color color{1.0f, 1.0f, 1.0f};  ///< plain, and below in a gradient
  Color top{0.55f, 0.65f, 0.80f}; ///< above in a gradient
};

/** \brief A bright light over the viewer's left shoulder and a weak one from the right.
 */
inline std::vector<Light>
defaultLights()
{
  Light key, fill;
  fill.position = {0.9, 0.1, 0.4};
  fill.color = {0.25f, 0.25f, 0.28f};
  return {key, fill};
}

} // namespace pcl_uvol
