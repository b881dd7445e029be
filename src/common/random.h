// SPDX-License-Identifier: BSD-3-Clause
// Random numbers by counting: the n-th one needs none of those before it.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstdint>

namespace pcl_uvol {

/** \brief The step of splitmix64 (Steele et al. 2014), a bijection: neighbouring
 * arguments give unrelated results. */
inline std::uint64_t
mixBits(std::uint64_t z)
{
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/** \brief A number in [0, 1) that depends on its three arguments only: the same for any
 * number of threads.
 * \param draw tells the numbers of one index apart */
PCL_UVOL_EXPORTS double
uniformAt(std::uint64_t seed, std::uint64_t index, std::uint64_t draw);

/** \brief A number of the normal distribution of mean 0 and standard deviation 1, made
 * of the uniform draws 2 draw and 2 draw + 1. */
PCL_UVOL_EXPORTS double
normalAt(std::uint64_t seed, std::uint64_t index, std::uint64_t draw);

} // namespace pcl_uvol
