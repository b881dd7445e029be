// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/length_unit.h"

#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cstring>

namespace pcl_uvol {

namespace {

/** Products of two floats, but for zero, are normal numbers in double: these are the
 * least exponent that one has, and how many there are. */
constexpr int least_exponent = -298, exponents = 556;

/** Powers of two that are normal numbers in float, as are their reciprocals. */
constexpr int most_exponent = 126;

int
exponentOf(double magnitude)
{
  std::uint64_t bits;
  std::memcpy(&bits, &magnitude, sizeof(bits));
  return static_cast<int>(bits >> 52) - 1023;
}

} // namespace

MagnitudeCounts::MagnitudeCounts()
    : counts_(exponents)
{
}

void
MagnitudeCounts::add(const Position& position, const Position& scale)
{
  if (!isFinite(position))
    return;
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    largest =
        std::max(largest, std::abs(static_cast<double>(position[axis]) * scale[axis]));
  if (largest > 0.0)
    ++counts_[static_cast<std::size_t>(exponentOf(largest) - least_exponent)];
}

void
MagnitudeCounts::add(const MagnitudeCounts& other)
{
  for (std::size_t i = 0; i < counts_.size(); ++i)
    counts_[i] += other.counts_[i];
}

LengthUnit
MagnitudeCounts::findUnit(const Position& scale) const
{
  std::uint64_t total = 0, below = 0;
  for (const std::uint64_t count : counts_)
    total += count;
  int exponent = least_exponent;
  for (std::size_t i = 0; total > 0; ++i, ++exponent) {
    below += counts_[i];
    if (2 * below > total)
      break;
  }
  LengthUnit unit;
  if (total > 0)
    unit.factor =
        std::ldexp(1.0f, -std::clamp(exponent, -most_exponent, most_exponent));
  for (int axis = 0; axis < 3; ++axis) {
    unit.scale[axis] = scale[axis] * unit.factor;
    if (!std::isnormal(unit.scale[axis]))
      throw InvalidArgument("scale_beyond_float",
                            {{"x", scale[0]}, {"y", scale[1]}, {"z", scale[2]}});
  }
  return unit;
}

bool
MagnitudeCounts::reachesBeyond(const LengthUnit& unit) const
{
  int exponent = least_exponent + exponents;
  for (std::size_t i = counts_.size(); i > 0; --i, --exponent)
    if (counts_[i - 1] > 0)
      break;
  // Below two to the exponent, and what rounding adds.
  return exponent + std::ilogb(unit.factor) >= std::ilogb(LengthUnit::farthest);
}

void
FarPoints::add(std::uint64_t index, const Position& at)
{
  add(FarPoints{1, index, at});
}

void
FarPoints::add(const FarPoints& other)
{
  if (other.count > 0 && (count == 0 || other.first < first)) {
    first = other.first;
    position = other.position;
  }
  count += other.count;
}

void
FarPoints::warn(Report& report) const
{
  if (count > 0)
    report.warn("far_points",
                {{"far_points", count},
                 {"first", first},
                 {"x", position[0]},
                 {"y", position[1]},
                 {"z", position[2]}});
}

} // namespace pcl_uvol
