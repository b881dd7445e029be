// SPDX-License-Identifier: BSD-3-Clause
// The range of numbers, and that of most of them where a few lie far from the others.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Distance from a number to its float. */
PCL_UVOL_EXPORTS double
floatError(double number);

/** \brief A coordinate, or NaN for one that float does not hold, and for the largest
 * float: programs write these where they have no position. Infinities stay. */
inline double
placeOrNaN(double coordinate)
{
  const double magnitude = std::abs(coordinate);
  return magnitude >= std::numeric_limits<float>::max() &&
                 magnitude <= std::numeric_limits<double>::max()
             ? std::numeric_limits<double>::quiet_NaN()
             : coordinate;
}

/** \brief Where numbers lie, and what float loses of them. */
struct PCL_UVOL_EXPORTS NumberRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double float_error = 0.0; ///< largest distance from a number to its float

  /** \brief Take a finite number. */
  void
  add(double number);

  /** \brief Take what another range has taken. */
  void
  add(const NumberRange& other);

  double
  getExtent() const
  {
    return high > low ? high - low : 0.0;
  }

  /** \brief Largest magnitude. */
  double
  getLargest() const;
};

/** \brief The range of all numbers, unless few of them make it far larger than that of
 * the others: then the range of the three quarters in the middle.
 * \param sketch random ones of the numbers */
PCL_UVOL_EXPORTS NumberRange
findTypicalRange(const NumberRange& all, std::vector<double> sketch);

/** \brief A number in the middle of a range, as a multiple of a power of two near a
 * scale: numbers as large as the scale then have few digits in common with it, and
 * differences to it are exact in double. */
PCL_UVOL_EXPORTS double
roundedMiddle(const NumberRange& range, double scale);

/** \brief Numbers as texts of 6 digits, or of as many more as show what parts each from
 * the nearest other one; those that are not finite are "unknown". */
PCL_UVOL_EXPORTS std::vector<std::string>
describeNumbers(const std::vector<double>& numbers);

} // namespace pcl_uvol
