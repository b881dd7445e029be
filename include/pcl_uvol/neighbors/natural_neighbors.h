// SPDX-License-Identifier: BSD-3-Clause
// Approximate natural neighbours of every sample: candidates of the kd-tree (thesis
// 2.2) or a discrete Voronoi diagram (2.1), thinned by the angle criterion (2.3).
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/angle_criterion.h>
#include <pcl_uvol/neighbors/neighbor_candidates.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>
#include <pcl_uvol/neighbors/sample_set.h>

#include <pcl/pcl_base.h>

#include <cstdint>
#include <memory>
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

/** \brief Natural neighbours of every point of a cloud.
 *
 * \code
 * pcl_uvol::NaturalNeighbors<pcl::PointXYZ> natural;
 * natural.setInputCloud(cloud);
 * pcl_uvol::NeighborGraph graph;
 * natural.compute(graph);
 * \endcode
 * Points with a non-finite coordinate have no neighbours; of exact duplicates the first
 * has those of all, the others none. */
template <typename PointT>
class NaturalNeighbors : public pcl::PCLBase<PointT>,
                         public ParameterStage<NaturalNeighborParameters> {
public:
  using Ptr = std::shared_ptr<NaturalNeighbors<PointT>>;
  using ConstPtr = std::shared_ptr<const NaturalNeighbors<PointT>>;

  /** \brief Default: AngleCriterion::Kept. */
  void
  setAngleCriterion(AngleCriterion criterion)
  {
    parameters_.criterion = criterion;
  }
  AngleCriterion
  getAngleCriterion() const
  {
    return parameters_.criterion;
  }

  /** \brief Where candidates come from. Default: NeighborSource::KdTree.
   * \param voronoi_cells of a diagram along its longest side; 0: 4 samples to a cell */
  void
  setNeighborSource(NeighborSource source, std::uint32_t voronoi_cells = 0)
  {
    parameters_.source = source;
    parameters_.voronoi_cells = voronoi_cells;
  }
  NeighborSource
  getNeighborSource() const
  {
    return parameters_.source;
  }

  /** \brief One row per point of the input cloud, sorted by (squared distance, index),
   * indices into the input cloud.
   * \throws InvalidArgument without an input cloud or without a finite point */
  void
  compute(NeighborGraph& graph);
};

} // namespace pcl_uvol
