// SPDX-License-Identifier: BSD-3-Clause
// How wide a view between neighbours is. Plain arrays, no library headers: the file is
// compiled once per instruction set.
#pragma once

#include <cstddef>

namespace pcl_uvol {

/** Directions that are looked into: a multiple of every register's width. */
constexpr std::size_t cone_directions = 80;

/** Neighbours come in multiples of it, whatever the instruction set. */
constexpr std::size_t cone_lanes = 16;

/** \brief The direction that is farthest from any neighbour: the cosine of
 * its angle to the nearest one; -1 without neighbours.
 * \param directions unit vectors: all x, all y, all z; aligned to 64 bytes
 * \param x, y, z neighbours as seen from the point, aligned to 64 bytes; scaled to unit
 * length, those at the point itself become NaN and do not count
 * \param count a multiple of cone_lanes, filled up with zeros */
using EmptyConeKernel = float (*)(const float (*directions)[cone_directions],
                                  float* x,
                                  float* y,
                                  float* z,
                                  std::size_t count);

namespace baseline {
float
emptiestCone(const float (*)[cone_directions], float*, float*, float*, std::size_t);
}
namespace avx2 {
float
emptiestCone(const float (*)[cone_directions], float*, float*, float*, std::size_t);
}
namespace avx512 {
float
emptiestCone(const float (*)[cone_directions], float*, float*, float*, std::size_t);
}

} // namespace pcl_uvol
