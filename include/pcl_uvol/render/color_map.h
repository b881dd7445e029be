// SPDX-License-Identifier: BSD-3-Clause
// Colours, materials, lights and background: the Blinn-Phong model that both renderers
// shade with (thesis 4.2.2, 4.3.1); and scalars to colours.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <string>
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
  Color color{0.80f, 0.78f, 0.74f}; ///< of points that have no colour
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

/** \brief Four bytes as they lie in memory: red, green, blue, opacity. */
using Rgba = std::uint32_t;

/** \brief A channel, clamped to [0, 1] and rounded to 8 bits.
 * \param value of the channel */
PCL_UVOL_EXPORTS std::uint8_t
toByte(float value);

/** \brief Rounded to 8 bits per channel, opaque.
 * \param color channels from 0 to 1 */
PCL_UVOL_EXPORTS Rgba
toRgba(const Color& color);

/** \brief A colour for every value in a range; values beyond it get those of its ends,
 * NaN is grey. */
class PCL_UVOL_EXPORTS ColorMap {
public:
  /** \param name of names(): viridis and cividis (perceptually uniform, also for the
   * colour-blind), inferno, magma, plasma, turbo, gray. Diverging: coolwarm, RdBu,
   * PuOr. Cyclic: twilight. Categories: OkabeIto (eight, also for the colour-blind),
   * tab10 (ten). "_r" after the name reverses the map
   * \throws InvalidArgument for another name */
  explicit ColorMap(const std::string& name = "viridis");

  /** \return The names of all maps, without "_r". */
  static const std::vector<std::string>&
  names();

  /** \brief True for a map of distinct colours, without shades in between. */
  bool
  isCategorical() const
  {
    return is_categorical_;
  }

  /** \brief Colours that the map is made of: its categories, or what its shades lie
   * between. */
  std::size_t
  size() const
  {
    return count_;
  }

  /** \brief Colour at a position in [0, 1].
   * \param position taken to the nearer end outside of [0, 1] */
  Color
  at(double position) const;

  /** \brief Colour of a zero-based category; colours repeat after size(). Negative
   * ones, which mean "in no class" by custom, and NaN are grey.
   * \param category a whole number */
  Color
  ofCategory(double category) const;

  /** \brief One colour per value.
   * \param low, high finite, low <= high; a range of one value gives the middle of the
   * map
   * \param values may be NaN, which is grey */
  std::vector<Rgba>
  apply(const std::vector<float>& values, double low, double high) const;

private:
  Color
  colorAt(std::size_t index) const;

  const std::uint32_t* colors_; ///< 0xrrggbb at even distances
  std::size_t count_;
  bool is_categorical_, is_reversed_;
};

} // namespace pcl_uvol
