// SPDX-License-Identifier: BSD-3-Clause
// The volumes that the Voronoi cell of a new place takes from the cells of samples.
#pragma once

#include "neighbors/simple_cell.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Cuts a cell into parts, each of which was nearest to one of the samples
 * around. Every part is cut out separately, so that rounding in one does not spread to
 * others: this works for any layout of the samples, for which DelaunayCavity needs
 * samples in general position. One object per thread. */
class CellParts {
public:
  /** \brief Compute the volumes of the parts.
   * \param cell of the place, without empty faces
   * \param volumes of each face; 0 for those of a cube */
  void
  measure(const SimpleCell& cell, double* volumes);

private:
  /** Cut out the part of a face's sample. */
  void
  findPart(const SimpleCell& cell, std::uint16_t face);

  /** The face whose sample is nearest to a vertex of the part. */
  std::uint16_t
  findNearest(std::size_t vertex);

  SimpleCell part_;
  std::vector<double> x_, y_, z_, limits_;         ///< with cell_padding
  std::vector<std::vector<std::uint16_t>> beside_; ///< faces at the edges of each
};

} // namespace pcl_uvol::detail
