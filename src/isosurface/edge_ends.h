// SPDX-License-Identifier: BSD-3-Clause
// The samples between which isopoints lie, where these come from several pieces.
#pragma once

#include "isosurface/piece_isopoints.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The points that edges end at, and the edges between them. */
struct EdgeEnds {
  std::vector<std::uint64_t> points; ///< sources of samples, ascending, each once
  IsoEdges edges;                    ///< one per isopoint; their ends index points
};

/** \brief Number the ends of isopoints' edges.
 * \param isopoints one isovalue after another
 * \throws InvalidArgument for more points than an edge can number */
PCL_UVOL_EXPORTS EdgeEnds
findEdgeEnds(const std::vector<std::vector<GlobalIsopoint>>& isopoints);

} // namespace pcl_uvol
