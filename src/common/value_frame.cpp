// SPDX-License-Identifier: BSD-3-Clause
#include "common/value_frame.h"

#include "common/parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_uvol {

namespace {

/** Relative to the range: what float may lose of a value. */
constexpr double value_tolerance = 1e-7;

/** Largest magnitudes that float computes with as they are: squares of differences, and
 * of errors that are far smaller, are numbers in float. */
constexpr double smallest_range = 0x1p-24, largest_range = 0x1p40;

/** What lies farther out, in usual magnitudes, need not be in the range of float. */
constexpr double largest_stretch = 0x1p60;

/** Powers of two that are normal numbers in double, as are their reciprocals. */
constexpr int most_exponent = 1022;

/** Many more than a sketch keeps. */
constexpr std::size_t range_block = 1u << 17;

} // namespace

ValueFrame
ValueRange::findFrame() const
{
  std::vector<double> sketch;
  for (const auto& item : sketch_.getItems())
    sketch.push_back(item[0]);
  const NumberRange typical = findTypicalRange(range_, sketch);
  ValueFrame frame;
  const double extent = typical.getExtent();
  if (extent > 0.0 && typical.float_error > value_tolerance * extent)
    frame.reference = roundedMiddle(typical, extent);
  const auto magnitude = [&](const NumberRange& range) {
    return std::max(std::abs(range.low - frame.reference),
                    std::abs(range.high - frame.reference));
  };
  const double most = range_.getLargest() > 0.0 ? magnitude(range_) : 0.0;
  const double usual = most > 0.0 ? magnitude(typical) : 0.0;
  double one = 1.0; // what becomes 1
  if (most > 0.0 && most < smallest_range)
    one = most;
  else if (usual > largest_range)
    one = most <= largest_stretch * usual ? most : usual;
  if (one != 1.0)
    frame.factor =
        std::ldexp(1.0, -std::clamp(std::ilogb(one), -most_exponent, most_exponent));
  return frame;
}

ValueRange
findValueRange(const CloudView& cloud, const ScalarField& field, unsigned threads)
{
  std::vector<ValueRange> blocks((cloud.count + range_block - 1) / range_block);
  parallelBlocks(
      cloud.count, range_block, threads, [&](std::size_t begin, std::size_t end) {
        ValueRange& range = blocks[begin / range_block];
        for (std::size_t i = begin; i < end; ++i)
          range.add(field.read(cloud.point(i)));
      });
  ValueRange all;
  for (const ValueRange& block : blocks)
    all.add(block);
  return all;
}

} // namespace pcl_uvol
