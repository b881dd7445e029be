// SPDX-License-Identifier: BSD-3-Clause
// How wide a view between neighbours is. Plain arrays, no library headers: the file is
// compiled once per instruction set.
#pragma once

#include <cstddef>

namespace pcl_uvol {

/** Directions per step, whatever the instruction set. */
constexpr std::size_t cone_lanes = 16;

/** \brief Unit vectors, coordinate by coordinate. */
struct UnitVectors {
  const float *x, *y, *z;
  std::size_t count;
};

/** \brief Of all directions the one that is farthest from any neighbour: the cosine of
 * its angle to the nearest one; -1 without neighbours.
 * \param directions aligned to 64 bytes, their count a multiple of cone_lanes */
using EmptyConeKernel = float (*)(const UnitVectors& directions,
                                  const UnitVectors& neighbors);

namespace baseline {
float
emptiestCone(const UnitVectors&, const UnitVectors&);
}
namespace avx2 {
float
emptiestCone(const UnitVectors&, const UnitVectors&);
}
namespace avx512 {
float
emptiestCone(const UnitVectors&, const UnitVectors&);
}

} // namespace pcl_uvol
