// SPDX-License-Identifier: BSD-3-Clause
// Where isopoints lie between the samples, and what the samples' other fields are
// there.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The edge of one isopoint: two points of the input cloud and the parameter of
 * the foot, 0 at the first and 1 at the second. */
struct IsoEdge {
  std::uint32_t first, second; ///< indices into the input cloud
  float t;                     ///< in [0, 1]
};

/** \brief One edge per isopoint, in the order of the isopoints. */
using IsoEdges = std::vector<IsoEdge>;

/** \brief Add to a cloud of isopoints every field of the samples' cloud that it lacks,
 * under its own name, type and count.
 *
 * Floating-point fields are interpolated linearly, NaN where a sample that counts is
 * NaN; integers, labels and packed colours come from the nearer sample. \param
 * isopoints as many points as edges; comes out packed without padding fields \throws
 * InvalidArgument if sizes disagree or an edge points outside the samples */
PCL_UVOL_EXPORTS void
interpolateFields(const pcl::PCLPointCloud2& samples,
                  const IsoEdges& edges,
                  pcl::PCLPointCloud2& isopoints);

} // namespace pcl_uvol
