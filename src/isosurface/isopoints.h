// SPDX-License-Identifier: BSD-3-Clause
// The kernel of isosurface extraction on plain arrays: edges, roots, orientation
// (thesis 2.4).
#pragma once

#include "../neighbors/sample_values.h"
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/neighbors/neighbor_candidates.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief What the isopoints of one isovalue are made from. */
struct IsopointInput {
  const SampleSet& samples;
  const SampleValues& scalar;
  const NodeRanges& ranges;
  const NeighborCandidates& candidates;
  AngleCriterion criterion;
  Outside outside;
  Interpolation interpolation;
  unsigned threads;
};

/** \brief Append the isopoints of one isovalue and their edges.
 * \param report gets "crossing_samples", "edges", "coincident" and the times */
void
appendIsopoints(const IsopointInput& input,
                float isovalue,
                pcl::PointCloud<PointIso>& isopoints,
                IsoEdges& edges,
                Report& report);

} // namespace pcl_uvol
