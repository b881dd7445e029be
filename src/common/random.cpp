// SPDX-License-Identifier: BSD-3-Clause
#include "common/random.h"

#include <cmath>

namespace pcl_uvol {

double
uniformAt(std::uint64_t seed, std::uint64_t index, std::uint64_t draw)
{
  return static_cast<double>(mixBits(mixBits(mixBits(seed) ^ index) ^ draw) >> 11) *
         0x1.0p-53;
}

double
normalAt(std::uint64_t seed, std::uint64_t index, std::uint64_t draw)
{
  // Box and Muller; 1 - u is never zero.
  return std::sqrt(-2 * std::log(1.0 - uniformAt(seed, index, 2 * draw))) *
         std::cos(2 * M_PI * uniformAt(seed, index, 2 * draw + 1));
}

} // namespace pcl_uvol
