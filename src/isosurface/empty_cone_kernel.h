// SPDX-License-Identifier: BSD-3-Clause
// How wide a view between neighbours is. Plain arrays, no library headers: the file is
// compiled once per instruction set.
#pragma once

#include <cstddef>

namespace pcl_uvol {

/** Directions that are looked into: a multiple of every register's width. */
constexpr std::size_t cone_directions = 80;

/** \brief Unit vectors, coordinate by coordinate. */
struct UnitVectors {
  const float *x, *y, *z;
  std::size_t count;
};

/** \brief Of all directions the one that is farthest from any neighbour: the cosine of
 * its angle to the nearest one; -1 without neighbours.
 * \param directions unit vectors: all x, all y, all z; aligned to 64 bytes */
using EmptyConeKernel = float (*)(const float (*directions)[cone_directions],
                                  const UnitVectors& neighbors);

namespace baseline {
float
emptiestCone(const float (*)[cone_directions], const UnitVectors&);
}
namespace avx2 {
float
emptiestCone(const float (*)[cone_directions], const UnitVectors&);
}
namespace avx512 {
float
emptiestCone(const float (*)[cone_directions], const UnitVectors&);
}

} // namespace pcl_uvol
