// SPDX-License-Identifier: BSD-3-Clause
#include "common/number_range.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>

namespace pcl_uvol {

namespace {

/** Share of the range of the three quarters in the middle: four binary digits, which
 * the numbers lose to a few far ones, are not worth that results of samplings with long
 * tails hang on where a tail ends. Normal numbers have 4, exponential ones 7. */
constexpr double most_stretch = 16.0;

/** Numbers at either end that may be anything: one in eight. */
constexpr std::size_t trimmed_part = 8;

} // namespace

double
floatError(double number)
{
  const double magnitude = std::abs(number);
  // Where float has no normal number, what it would lose of it with another exponent.
  if (magnitude < std::numeric_limits<float>::min() ||
      magnitude > std::numeric_limits<float>::max())
    return magnitude * 0x1p-25;
  return std::abs(static_cast<double>(static_cast<float>(number)) - number);
}

void
NumberRange::add(double number)
{
  low = std::min(low, number);
  high = std::max(high, number);
  float_error = std::max(float_error, floatError(number));
}

void
NumberRange::add(const NumberRange& other)
{
  low = std::min(low, other.low);
  high = std::max(high, other.high);
  float_error = std::max(float_error, other.float_error);
}

double
NumberRange::getLargest() const
{
  return high >= low ? std::max(std::abs(low), std::abs(high)) : 0.0;
}

NumberRange
findTypicalRange(const NumberRange& all, std::vector<double> sketch)
{
  if (sketch.empty())
    return all;
  std::sort(sketch.begin(), sketch.end());
  const std::size_t trimmed = sketch.size() / trimmed_part;
  NumberRange middle;
  for (std::size_t i = trimmed; i < sketch.size() - trimmed; ++i)
    middle.add(sketch[i]);
  // Not the extents, which may overflow.
  const bool is_stretched =
      0.5 * all.high - 0.5 * all.low > most_stretch * (0.5 * middle.getExtent());
  return is_stretched && middle.getExtent() > 0.0 ? middle : all;
}

double
roundedMiddle(const NumberRange& range, double scale)
{
  const double step = std::exp2(std::floor(std::log2(scale)));
  return std::round(0.5 * (range.low + range.high) / step) * step;
}

std::vector<std::string>
describeNumbers(const std::vector<double>& numbers)
{
  // Three digits of what parts a number from the next.
  constexpr int fewest = 6, digits_of_gap = 3;
  std::vector<std::string> texts;
  for (const double number : numbers) {
    if (!std::isfinite(number)) {
      texts.emplace_back("unknown");
      continue;
    }
    double gap = std::numeric_limits<double>::infinity();
    for (const double other : numbers)
      if (other != number)
        gap = std::min(gap, std::abs(other - number));
    const double digits = std::ceil(std::log10(std::abs(number) / gap)) + digits_of_gap;
    std::ostringstream text;
    text.precision(digits > fewest
                       ? static_cast<int>(std::min<double>(
                             digits, std::numeric_limits<double>::max_digits10))
                       : fewest);
    text << number;
    texts.push_back(text.str());
  }
  return texts;
}

} // namespace pcl_uvol
