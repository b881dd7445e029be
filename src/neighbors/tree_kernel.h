// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of building a kd-tree. Plain arrays, no library headers: the file is
// compiled once per instruction set.
#pragma once

#include <cstdint>

namespace pcl_uvol {

/** \brief A splitting plane: a position in the total order along its axis. */
struct SplitPlane {
  float coordinate;           ///< midway between the neighbours of the cut
  std::uint32_t below_sample; ///< the last sample below the plane; decides between
                              ///< planes of equal coordinate
};

/** \brief Where a plane between two coordinates lies. Each object has a copy of its
 * own: one that is compiled for wider registers must not serve the others. */
static inline float
midway(float below, float above)
{
  return static_cast<float>(0.5 *
                            (static_cast<double>(below) + static_cast<double>(above)));
}

/** \brief One instruction set's versions. */
struct TreeKernels {
  /** Numbers that valueAtRank chooses from at most, and the room that they have. */
  static constexpr int most_values = 32;

  /** \brief The value that would stand at that place if so many numbers were sorted. */
  float (*valueAtRank)(const float* values, int count, int rank);

  /** Samples of a subtree that registers hold: 16, 8, or 1 for none. */
  std::uint32_t most_in_registers;

  /** \brief Build a subtree of at most that many samples.
   * \param records x, y, z and an index, one after another; brought into leaf order
   * \param number of the subtree's root
   * \param cycle axis of the splits, from the root's depth on
   * \param low,high corners of the root's cell: splits run across the longest sides of
   * cells instead; null for none
   * \param planes by node number, gets those of the subtree with indices of records
   * \param axes by node number, gets those of the splits if there is a cell
   * \return false if positions are equal */
  bool (*build)(float* records,
                int count,
                std::uint64_t number,
                const std::int8_t* cycle,
                const float* low,
                const float* high,
                SplitPlane* planes,
                std::int8_t* axes);
};

namespace baseline {
extern const TreeKernels tree_kernels;
}
namespace avx2 {
extern const TreeKernels tree_kernels;
}
namespace avx512 {
extern const TreeKernels tree_kernels;
}

} // namespace pcl_uvol
