// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that depend on a seed and an index only: the same for any number of
// threads and on every machine.
#pragma once

#include <cmath>
#include <cstdint>

namespace pcl_uvol {

/** \brief The random numbers of one index: splitmix64 from a hashed start. */
class CounterRandom {
public:
  CounterRandom(std::uint64_t seed, std::uint64_t index)
      : state_(mix(mix(seed + step) ^ (index * step)))
  {
  }

  /** \brief Uniform in [0, 1). */
  double
  uniform()
  {
    return static_cast<double>(mix(state_ += step) >> 11) * 0x1.0p-53;
  }

  /** \brief Of the normal distribution with mean 0 and standard deviation 1. */
  double
  normal()
  {
    constexpr double two_pi = 6.283185307179586;
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform())); // Box-Muller
    return radius * std::cos(two_pi * uniform());
  }

private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15ULL;

  static std::uint64_t
  mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

} // namespace pcl_uvol
