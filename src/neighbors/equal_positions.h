// SPDX-License-Identifier: BSD-3-Clause
// Whether any of some positions are equal.
#pragma once

#include "neighbors/kd_tree.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace pcl_uvol {

/** \brief Finds records of equal positions. One object per block of records. */
class EqualPositions {
public:
  /** \brief As places are their numbers. */
  static constexpr std::uint32_t most_records =
      std::numeric_limits<std::uint16_t>::max() - 1u;

  /** \param most records that are looked at, up to most_records */
  explicit EqualPositions(std::size_t most)
  {
    while ((std::size_t(1) << bits_) < 2 * most)
      ++bits_;
    places_.assign(std::size_t(1) << bits_, empty);
  }

  /** \brief Whether two of them are at one place.
   * \param count not more than it was made for */
  bool
  areAmong(const SampleRecord* records, std::uint32_t count)
  {
    const std::size_t last = places_.size() - 1;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Position& position = records[i].position;
      std::size_t place = hash(position);
      for (; places_[place] != empty; place = (place + 1) & last) {
        const Position& other = records[places_[place]].position;
        if (position[0] == other[0] && position[1] == other[1] &&
            position[2] == other[2])
          return true;
      }
      places_[place] = static_cast<std::uint16_t>(i);
    }
    return false;
  }

private:
  static constexpr std::uint16_t empty = std::numeric_limits<std::uint16_t>::max();

  /** Hashes by multiplication with odd numbers, of which the upper bits are the best
   * mixed (Knuth, The Art of Computer Programming 3, 6.4). */
  std::size_t
  hash(const Position& position) const
  {
    std::uint32_t bits[3];
    std::memcpy(bits, position.x, sizeof(bits));
    std::uint32_t mixed =
        bits[0] * 0x9e3779b1u + bits[1] * 0x85ebca77u + bits[2] * 0xc2b2ae3du;
    mixed = (mixed ^ (mixed >> 15)) * 0x2c1b3c6du;
    return mixed >> (32 - bits_);
  }

  unsigned bits_ = 1;
  std::vector<std::uint16_t> places_;
};

} // namespace pcl_uvol
