// SPDX-License-Identifier: BSD-3-Clause
// A random part of a set that nobody lists.
#pragma once

#include "common/random.h"

#include <cstddef>
#include <cstdint>

namespace pcl_uvol {

/** \brief Takes items independently of each other with one probability, a power of two,
 * by their index, and that of their process and pass: what no pass has taken may be
 * taken in the next one. */
class BernoulliSampler {
public:
  /** \param expected items to choose from, of all processes
   * \param most of them that are taken, on average */
  BernoulliSampler(double expected,
                   std::uint64_t most,
                   std::size_t rank,
                   std::size_t pass)
      : salt_(mixBits(rank << 32 | pass))
  {
    while (expected > static_cast<double>(most)) {
      expected /= 2.0;
      mask_ = mask_ << 1 | 1u;
    }
  }

  bool
  takes(std::uint64_t index) const
  {
    return (mixBits(salt_ + index) & mask_) == 0;
  }

  bool
  takesAll() const
  {
    return mask_ == 0;
  }

private:
  std::uint64_t salt_, mask_ = 0;
};

} // namespace pcl_uvol
