// SPDX-License-Identifier: BSD-3-Clause
// Scalars to colours.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/lighting.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

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
   * colour-blind), inferno, magma, plasma, turbo, gray, coolwarm, RdBu and PuOr
   * (diverging), twilight (cyclic), or tab10 (ten categories); with "_r" behind it the
   * map runs backwards
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

  /** \brief Colour of a category, counted from 0; they repeat after size(). Negative
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
