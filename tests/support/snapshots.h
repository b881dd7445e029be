// SPDX-License-Identifier: BSD-3-Clause
// Snapshots as simulation codes write them, made of known numbers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace uvol_test {

/** \brief How a binary snapshot of Gadget is laid out. */
struct GadgetLayout {
  bool has_labels = false;
  bool big_endian = false;
  bool doubles = false;
  std::array<std::uint32_t, 6> here{}, total{};
  std::array<double, 6> masses{};
  std::uint32_t files = 1;
  std::uint32_t first = 0; ///< number of the first particle
  double time = 0.25, redshift = 0.0, omega = 0.0, hubble = 1.0, box = 0.0;
};

/** \brief The number that the generator gives to a component of a particle. */
double
snapshotNumber(std::uint32_t particle, int field, int component);

/** \brief The bytes of a file with POS, VEL, ID, MASS where the table has none, U, RHO,
 * HSML. Particles are numbered kind by kind. */
std::string
makeGadget(const GadgetLayout& layout);

} // namespace uvol_test
