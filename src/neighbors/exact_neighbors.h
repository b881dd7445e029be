// SPDX-License-Identifier: BSD-3-Clause
// The natural neighbours that thesis 2.1 and 2.2 approximate.
#pragma once

#include "neighbors/neighbor_candidates.h"

namespace pcl_uvol {

/** \brief Samples whose Voronoi cells share a face, found by cutting every cell out
 * with the bisectors of ever farther samples: about 15.5 of random samples. Faces that
 * only rounding makes, as between diagonal samples of a lattice, and those farther out
 * than 256 diagonals of the samples' box do not count. Memory: 4 bytes per neighbour
 * and 8 per sample, twice while rows are joined. */
class PCL_UVOL_EXPORTS ExactNeighbors : public NeighborCandidates {
public:
  /** \param report gets the time of "voronoi_cells"
   * \throws InvalidArgument for the samples of a piece, whose cells others may cut */
  ExactNeighbors(const SampleSet& samples, unsigned threads, Report& report);

  void
  find(std::uint32_t sample, std::vector<std::uint32_t>& candidates) const override;

  std::vector<std::uint32_t>
  findCrossing(const NodeRanges& ranges,
               float isovalue,
               unsigned threads) const override;

  /** \brief Bytes per sample that has as many neighbours as a random one. */
  static constexpr double
  bytesPerSample()
  {
    return 2.0 * (4.0 * 15.5 + 8.0);
  }

private:
  NeighborGraph faces_; ///< rows ascend; one of two samples alone may see their face
};

} // namespace pcl_uvol
