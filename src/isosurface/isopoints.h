// SPDX-License-Identifier: BSD-3-Clause
// The kernel of isosurface extraction on plain arrays: edges, roots, orientation
// (thesis 2.4).
#pragma once

#include "neighbors/neighbor_candidates.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief What the isopoints of one isovalue are made from. */
struct IsopointInput {
  const SampleSet& samples;
  const std::vector<float>& values; ///< in leaf order
  const NodeRanges& ranges;
  const NeighborCandidates& candidates;
  AngleCriterion criterion;
  Outside outside;
  Interpolation interpolation;
  unsigned threads;
  bool errors_only = false; ///< see IsosurfaceParameters
};

/** \brief An edge by sample indices, the lower one in the upper half: sorts by (lower,
 * higher). */
using EdgeKey = std::uint64_t;

/** \brief The edges from some samples that cross an isovalue, ascending.
 *
 * Neighbourhoods are not symmetric (2.4): an edge may be found from one end or from
 * both.
 * \param crossing samples that touch one of the other side: no others can have it for a
 * neighbour
 * \param tally gets the number of spikes among them, see SpikeTest
 * \param report gets it as "spikes" */
std::vector<EdgeKey>
findEdges(const IsopointInput& input,
          const std::vector<std::uint32_t>& crossing,
          float isovalue,
          SurfaceTally& tally,
          Report& report);

/** \brief Linear interpolation along an edge and the outside vector (2.4). */
void
placeIsopoint(const IsopointInput& input,
              EdgeKey key,
              float isovalue,
              PointIso& point,
              IsoEdge& edge);

/** \brief Which isopoints stay: of those that fall together, where edges meet in a
 * sample exactly at the isovalue or cross in one point, as on lattices, the first.
 * \param normals outside vectors; those that stay for several are averaged */
std::vector<std::uint8_t>
mergeCoincident(const std::vector<Position>& positions,
                std::vector<Position>& normals,
                unsigned threads);

/** \brief Append the isopoints of one isovalue and their edges.
 * \param sources input index of each sample
 * \param tally gets what is counted of them
 * \param report gets "crossing_samples", "edges", "spikes", "coincident" and times; of
 * linear isopoints "examined", "examined_bridged" and "examined_rim": of how many, all
 * or some in all parts, fits tell the support, and what it is */
void
appendIsopoints(const IsopointInput& input,
                const std::vector<std::uint32_t>& sources,
                float isovalue,
                pcl::PointCloud<PointIso>& isopoints,
                IsoEdges& edges,
                SurfaceTally& tally,
                Report& report);

} // namespace pcl_uvol
