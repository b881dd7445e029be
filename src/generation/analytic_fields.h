// SPDX-License-Identifier: BSD-3-Clause
// Scalar fields given by formulas, and scattered positions to sample them at: truth for
// tests and data to try things on.
#pragma once

#include <pcl_uvol/common/export.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A scalar field on a cube. */
struct AnalyticField {
  const char* name;
  double lower, upper; ///< of the cube it is meant for, along every axis
  double (*value)(const std::array<double, 3>& position);
  std::vector<double> isovalues; ///< surfaces worth looking at
  const char* description;
};

/** \brief All there are: radial, sphere, torus, gyroid, marschner_lobb, hydrogen, star.
 */
PCL_UVOL_EXPORTS const std::vector<AnalyticField>&
analyticFields();

/** \brief The field of that name.
 * \throws InvalidArgument that lists the names */
PCL_UVOL_EXPORTS const AnalyticField&
findAnalyticField(const std::string& name);

/** \brief How samples are spread over a cube. */
enum class Scatter {
  Uniform,   ///< independent
  Jittered,  ///< one at random in every cell of a lattice
  Lattice,   ///< the centres of these cells
  Clustered, ///< density falls with the squared distance from the centre, in a ball
  Tracks,    ///< rows of a robot or a drone along x, which meander a little
  Casts,     ///< vertical profiles below a ship's stations
  Holes      ///< straight drill holes, steep, from collars on top
};

/** \brief True where samples lie on lines: along them ten times as dense as across,
 * along drill holes 25 times. */
PCL_UVOL_EXPORTS bool
isOnLines(Scatter scatter);

/** \brief The line that the sample of that index among n lies on, counted from 0. */
PCL_UVOL_EXPORTS std::uint64_t
lineOf(Scatter scatter, std::uint64_t index, std::uint64_t n);

/** \brief Number of samples: Jittered and Lattice round down to a cube number. */
PCL_UVOL_EXPORTS std::uint64_t
scatterCount(Scatter scatter, std::uint64_t n);

/** \brief Position of the sample of that index among n in the cube [lower, upper]^3. */
PCL_UVOL_EXPORTS std::array<double, 3>
scatterAt(Scatter scatter,
          std::uint64_t seed,
          std::uint64_t index,
          std::uint64_t n,
          double lower,
          double upper);

} // namespace pcl_uvol
