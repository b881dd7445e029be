// SPDX-License-Identifier: BSD-3-Clause
// Positions of samples in a box: uniform, jittered, lattice, clustered, or as dense as
// a function says.
#pragma once

#include <pcl_uvol/common/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A scalar at a position. */
using ScalarFunction = std::function<double(double, double, double)>;

/** \brief An axis-parallel box. */
struct Box {
  std::array<double, 3> lower, upper;
};

/** \brief How samples are spread over a box. */
enum class Sampling {
  Uniform,   ///< independent
  Jittered,  ///< one at random in every cell of a lattice
  Lattice,   ///< the centres of these cells
  Clustered, ///< every other one in one of 64 Gaussian clusters, the others uniform
  Density    ///< in proportion to the positive part of a function, as SPH particles are
};

/** \brief Names for users, in the order of the enumeration. */
PCL_UVOL_EXPORTS const std::vector<std::string>&
samplingNames();

/** \brief Positions in a box, three numbers per sample, by seed and index alone.
 *
 * Jittered and Lattice give the largest lattice of about cubic cells with no more than
 * count cells, the others count samples.
 * \param density read by Sampling::Density only
 * \throws InvalidArgument for a box that is not finite, or, with Density, a function
 * that is nowhere positive */
PCL_UVOL_EXPORTS std::vector<double>
samplePositions(Sampling sampling,
                const Box& box,
                const ScalarFunction& density,
                std::size_t count,
                std::uint64_t seed,
                unsigned threads);

} // namespace pcl_uvol
