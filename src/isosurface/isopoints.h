// SPDX-License-Identifier: BSD-3-Clause
// The kernel of isosurface extraction on plain arrays: edges, roots, orientation
// (thesis 2.4).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The scalar in leaf order. */
struct SampleValues {
  std::vector<float> values;
  std::vector<std::uint32_t> sources; ///< input index whose value it is
};

/** \brief Bring values into leaf order; a merged sample takes the lower median of its
 * members' values, and becomes the member that has it.
 * \param report gets the count "conflicting_duplicates": merged samples of unequal
 * values */
SampleValues
gatherValues(const SampleSet& samples,
             const std::vector<float>& input_values,
             unsigned threads,
             Report& report);

/** \brief What the isopoints of one isovalue are made from. */
struct IsopointInput {
  const SampleSet& samples;
  const SampleValues& scalar;
  const NodeRanges& ranges;
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
