// SPDX-License-Identifier: BSD-3-Clause
// Where a sample's neighbours are looked for, before the angle criterion thins them
// out: in touching cells of the kd-tree (thesis 2.2), in adjacent regions of a discrete
// Voronoi diagram (2.1), or at the faces of exact cells (exact_neighbors.h).
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief Neighbour candidates of samples: if one sample is a candidate of another one,
 * that is one of it. Any number of threads may ask at once. */
class PCL_UVOL_EXPORTS NeighborCandidates {
public:
  using ConstPtr = std::shared_ptr<const NeighborCandidates>;

  NeighborCandidates() = default;
  NeighborCandidates(const NeighborCandidates&) = delete;
  NeighborCandidates&
  operator=(const NeighborCandidates&) = delete;
  virtual ~NeighborCandidates() = default;

  /** \brief Each once, in no particular order.
   * \param candidates cleared first */
  virtual void
  find(std::uint32_t sample, std::vector<std::uint32_t>& candidates) const = 0;

  /** \brief The samples with a candidate on the other side of an isovalue (a value
   * equal to it counts as above), ascending.
   * \param ranges of the tree of the samples */
  virtual std::vector<std::uint32_t>
  findCrossing(const NodeRanges& ranges, float isovalue, unsigned threads) const = 0;
};

/** \brief Samples whose cells of the kd-tree touch (Definition 2.4): about 11. */
class PCL_UVOL_EXPORTS TouchingCells : public NeighborCandidates {
public:
  /** \param samples must outlive the candidates */
  explicit TouchingCells(const SampleSet& samples)
      : samples_(samples)
  {
  }

  void
  find(std::uint32_t sample, std::vector<std::uint32_t>& candidates) const override;

  std::vector<std::uint32_t>
  findCrossing(const NodeRanges& ranges,
               float isovalue,
               unsigned threads) const override;

private:
  const SampleSet& samples_;
};

/** \brief How a discrete Voronoi diagram serves for candidates. */
struct VoronoiCandidateSettings {
  /** Cubic cells along the longest side of the samples' box; 0 (default): as many as
   * give 4 samples to a cell on average. */
  std::uint32_t cells = 0;
  std::shared_ptr<NearestSites> way; ///< default: a FeatureTransform
};

/** \brief Samples in the same cell of a grid, and in cells whose Voronoi regions are
 * adjacent. Many more than touching cells where samples crowd: time per sample grows
 * with the number of samples in a cell. Memory: 4 bytes per cell and 12 per sample. */
class PCL_UVOL_EXPORTS VoronoiCandidates : public NeighborCandidates {
public:
  /** \param report gets the counts and times of VoronoiGrid, and the time of
   * "adjacent_regions"
   * \throws InvalidArgument for a grid that is too large, and where samples crowd so
   * much that they have more than 2000 candidates in the mean */
  VoronoiCandidates(const SampleSet& samples,
                    const VoronoiCandidateSettings& settings,
                    unsigned threads,
                    Report& report);

  void
  find(std::uint32_t sample, std::vector<std::uint32_t>& candidates) const override;

  std::vector<std::uint32_t>
  findCrossing(const NodeRanges& ranges,
               float isovalue,
               unsigned threads) const override;

private:
  NeighborGraph members_;              ///< samples per site
  NeighborGraph adjacent_;             ///< sites per site
  std::vector<std::uint32_t> site_of_; ///< per sample
};

/** \brief Those of a discrete Voronoi diagram if its settings are given, else those of
 * the kd-tree.
 * \param samples must outlive the candidates
 * \throws as VoronoiCandidates */
PCL_UVOL_EXPORTS NeighborCandidates::ConstPtr
makeCandidates(const SampleSet& samples,
               const std::optional<VoronoiCandidateSettings>& voronoi,
               unsigned threads,
               Report& report);

/** \brief Those of any source.
 * \param voronoi_cells of a diagram along the longest side
 * \throws as VoronoiCandidates and ExactNeighbors */
PCL_UVOL_EXPORTS NeighborCandidates::ConstPtr
makeCandidates(const SampleSet& samples,
               NeighborSource source,
               std::uint32_t voronoi_cells,
               unsigned threads,
               Report& report);

} // namespace pcl_uvol
