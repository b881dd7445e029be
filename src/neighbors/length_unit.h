// SPDX-License-Identifier: BSD-3-Clause
// The unit of length that samples are kept in: a power of two near the size of their
// coordinates, so that squares of distances are numbers in float whatever unit the
// coordinates came in. Multiplying by it, and dividing again, is exact.
#pragma once

#include "common/parallel.h"
#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief From the input's coordinates to those of samples. */
struct LengthUnit {
  /** \brief Samples lie no farther out: squares of their distances, and products of
   * two of these, are finite. */
  static constexpr float farthest = 0x1p40f;

  Position scale{{1.0f, 1.0f, 1.0f}}; ///< factors per axis, the unit among them
  float factor = 1.0f;                ///< of these the power of two that was chosen

  Position
  apply(const Position& position) const
  {
    return stretched(position, scale);
  }

  /** \brief True for the place of a sample: finite, and not too far out. */
  static bool
  isWithin(const Position& place)
  {
    return std::abs(place[0]) <= farthest && std::abs(place[1]) <= farthest &&
           std::abs(place[2]) <= farthest;
  }

  /** \brief A length among samples in the unit of the stretched input. */
  double
  toInput(double length) const
  {
    return length / factor;
  }
};

/** \brief True if all three coordinates are finite. */
inline bool
isFinite(const Position& position)
{
  return std::isfinite(position[0]) && std::isfinite(position[1]) &&
         std::isfinite(position[2]);
}

/** \brief How many positions are of which binary order of magnitude. Numbers of parts
 * of a cloud add up to those of the whole, so that the unit is the same however its
 * points are shuffled or distributed. */
class PCL_UVOL_EXPORTS MagnitudeCounts {
public:
  MagnitudeCounts();

  /** \brief Count a position by its largest coordinate once it is stretched; one that
   * is not finite, or zero, has none. */
  void
  add(const Position& position, const Position& scale);

  /** \brief The counts in their order, for sums over processes. */
  std::vector<std::uint64_t>&
  getCounts()
  {
    return counts_;
  }

  void
  add(const MagnitudeCounts& other);

  /** \brief The unit that brings the median magnitude near 1: half of the positions
   * may be anything.
   * \param scale factors per axis by which the positions were stretched
   * \throws InvalidArgument for factors that the unit takes out of float's range */
  LengthUnit
  findUnit(const Position& scale) const;

  /** \brief True if some of the positions may be no samples in a unit. */
  bool
  reachesBeyond(const LengthUnit& unit) const;

private:
  std::vector<std::uint64_t> counts_;
};

/** \brief Count positions.
 * \param position_at an index below count */
template <typename PositionAt>
MagnitudeCounts
countMagnitudes(std::size_t count,
                const PositionAt& position_at,
                const Position& scale,
                unsigned threads)
{
  constexpr std::size_t block_points = 1u << 16;
  std::vector<MagnitudeCounts> blocks((count + block_points - 1) / block_points);
  parallelBlocks(count, block_points, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      blocks[begin / block_points].add(position_at(i), scale);
  });
  MagnitudeCounts all;
  for (const MagnitudeCounts& block : blocks)
    all.add(block);
  return all;
}

/** \brief Points, counted as "far_points", that are left out because they lie beyond
 * LengthUnit::farthest. */
struct PCL_UVOL_EXPORTS FarPoints {
  std::uint64_t count = 0;
  std::uint64_t first = 0; ///< lowest index of them
  Position position{};     ///< of that one, in the input

  void
  add(std::uint64_t index, const Position& at);

  void
  add(const FarPoints& other);

  /** \brief Say how many there are and which is the first, if there are any. */
  void
  warn(Report& report) const;
};

} // namespace pcl_uvol
