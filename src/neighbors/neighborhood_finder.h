// SPDX-License-Identifier: BSD-3-Clause
// Candidates and angle criterion together: the neighbours of samples.
#pragma once

#include "neighbors/angle_criterion.h"
#include "neighbors/neighbor_candidates.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Neighbours of one sample after another; one object per thread. */
class PCL_UVOL_EXPORTS NeighborhoodFinder {
public:
  /** \param samples, candidates must outlive the finder */
  NeighborhoodFinder(const SampleSet& samples,
                     const NeighborCandidates& candidates,
                     AngleCriterion criterion)
      : candidates_(candidates)
      , filter_(samples.getPositions(), criterion)
  {
  }

  /** \brief Neighbours of a sample, sorted by (squared distance, index); valid until
   * the next call. */
  const std::vector<std::uint32_t>&
  find(std::uint32_t sample)
  {
    candidates_.find(sample, neighbors_);
    candidate_count_ += neighbors_.size();
    filter_.apply(sample, neighbors_);
    return neighbors_;
  }

  /** \brief Candidates seen by all calls so far, before the angle criterion. */
  std::uint64_t
  getCandidateCount() const
  {
    return candidate_count_;
  }

private:
  const NeighborCandidates& candidates_;
  AngleFilter filter_;
  std::vector<std::uint32_t> neighbors_;
  std::uint64_t candidate_count_ = 0;
};

/** \brief Neighbours of all samples, in leaf order.
 * \param report gets the counts "candidates" and "neighbors" and the time of
 * "neighborhoods". Memory: 4 bytes per neighbour (about 5 per sample) + 8 per sample,
 * twice while they are joined. */
PCL_UVOL_EXPORTS NeighborGraph
computeNaturalNeighbors(const SampleSet& samples,
                        const NeighborCandidates& candidates,
                        AngleCriterion criterion,
                        unsigned threads,
                        Report& report);

} // namespace pcl_uvol
