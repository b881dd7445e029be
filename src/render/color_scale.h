// SPDX-License-Identifier: BSD-3-Clause
// From values to places in a colour map.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pcl_uvol {

/** \brief A linear or logarithmic scale between two values. */
struct ColorScale {
  double low = 0.0, high = 1.0;
  bool is_logarithmic = false; ///< both ends are above 0

  /** \brief False for what is not a number, or has no logarithm on a scale of these. */
  bool
  hasPlace(double value) const
  {
    return !std::isnan(value) && !(is_logarithmic && value <= 0.0);
  }

  /** \brief 0 at the lower end and 1 at the upper one, beyond them outside of that; the
   * middle for a range of one value. Values that have no logarithm lie below all
   * others.
   */
  double
  placeOf(double value) const
  {
    if (!(high > low))
      return std::isnan(value) ? value : 0.5;
    if (!is_logarithmic) // halves: the range of doubles is wider than the largest one
      return (0.5 * value - 0.5 * low) / (0.5 * high - 0.5 * low);
    if (value <= 0.0)
      return -std::numeric_limits<double>::infinity();
    return (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
  }
};

/** \brief Decades that a logarithmic scale shows unasked: below these the smallest
 * values of a field, often rounding errors, would take most of the colours. */
constexpr double most_decades = 6.0;

/** \brief The scale from the lowest to the highest of some values. */
class ColorScaleFinder {
public:
  /** \param is_logarithmic only values above 0 count, in the upper most_decades */
  explicit ColorScaleFinder(bool is_logarithmic)
  {
    scale_.is_logarithmic = is_logarithmic;
  }

  /** \brief Take a value; one without a finite number, or logarithm, does not count. */
  void
  add(double value)
  {
    if (!std::isfinite(value) || (scale_.is_logarithmic && !(value > 0.0)))
      return;
    scale_.low = std::min(scale_.low, value);
    scale_.high = std::max(scale_.high, value);
  }

  /** \brief The scale; none of no value. */
  std::optional<ColorScale>
  find() const
  {
    if (scale_.low > scale_.high)
      return std::nullopt;
    ColorScale scale = scale_;
    if (scale.is_logarithmic)
      scale.low = std::max(scale.low, scale.high * std::pow(10.0, -most_decades));
    return scale;
  }

private:
  ColorScale scale_{std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity(),
                    false};
};

} // namespace pcl_uvol
