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

/** \brief A part of a tree whose samples fit into registers. */
struct Subtree {
  float* records; ///< x, y, z and an index, one after another; come into leaf order
  int count;
  std::uint64_t number;     ///< of its root
  const std::int8_t* cycle; ///< axes of the splits, from its root's depth on
  const float *low, *high;  ///< corners of its root's cell, across whose longest sides
                            ///< splits run instead; null for none
  SplitPlane* planes;       ///< by node number, get the indices of records
  std::int8_t* axes;        ///< by node number, set if there is a cell
};

/** \brief One instruction set's versions. */
struct TreeKernels {
  /** Most numbers that valueAtRank takes. An array has room for all of them. */
  static constexpr int most_values = 32;

  /** \brief The value that would stand at that place if so many numbers were sorted. */
  float (*valueAtRank)(const float* values, int count, int rank);

  /** Samples of a subtree that registers hold: 16, 8, or 1 for none. */
  std::uint32_t most_in_registers;

  /** \brief Build a subtree of at most that many samples.
   * \return false if positions are equal */
  bool (*build)(const Subtree& subtree);
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
