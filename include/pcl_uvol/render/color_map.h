// SPDX-License-Identifier: BSD-3-Clause
// Scalars to colours.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/lighting.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Four bytes as they lie in memory: red, green, blue, opacity. */
using Rgba = std::uint32_t;

/** \brief A channel, clamped to [0, 1] and rounded to 8 bits. */
PCL_UVOL_EXPORTS std::uint8_t
toByte(float value);

/** \brief Rounded to 8 bits per channel, opaque. */
PCL_UVOL_EXPORTS Rgba
toRgba(const Color& color);

/** \brief A colour for every value in a range; values beyond it get those of its ends,
 * NaN is grey. */
class PCL_UVOL_EXPORTS ColorMap {
public:
  /** \param name viridis (perceptually uniform, also for the colour-blind), inferno,
   * coolwarm (diverging) or gray
   * \throws InvalidArgument for another name */
  explicit ColorMap(const std::string& name = "viridis");

  static const std::vector<std::string>&
  names();

  /** \brief Colour at a position in [0, 1]. */
  Color
  at(double position) const;

  /** \brief One colour per value.
   * \param low, high finite, low <= high; a range of one value gives the middle of the
   * map */
  std::vector<Rgba>
  apply(const std::vector<float>& values, double low, double high) const;

private:
  const std::uint32_t* colors_; ///< 0xrrggbb at even distances
};

} // namespace pcl_uvol
