// SPDX-License-Identifier: BSD-3-Clause
// Isosurface extraction by several processes, each of which holds a part of the
// samples.
#pragma once

#include "distributed/run_stage.h"
#include "isosurface/piece_isopoints.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <vector>

namespace pcl_uvol {

/** \brief What one of several processes has of an isosurface. */
struct RankIsosurface {
  std::vector<std::vector<GlobalIsopoint>> isopoints; ///< per isovalue
  StageSamples samples;
  SurfaceTally tally;
};

/** \brief Extract the isosurface of the samples of all processes.
 *
 * The isopoints of all processes together are those of IsosurfaceExtraction with the
 * same settings, byte for byte.
 * \param samples of this process, see readSamples, values in the frame; there may be
 * none
 * \return the isopoints that lie in this process's pieces, ordered by their edges
 * \param report gets the counts, times and warnings of IsosurfaceExtraction for this
 * process, and those of runOnRanks
 * \throws InvalidArgument for bad settings, and on all processes if there is no sample
 * at all. Memory: about 130 bytes per sample. */
PCL_UVOL_EXPORTS RankIsosurface
extractFromRanks(Samples&& samples,
                 const IsosurfaceParameters& settings,
                 const ValueFrame& frame,
                 Communicator& communicator,
                 unsigned threads,
                 Report& report);

/** \brief Bring the isopoints of all processes to the first one, in the order in which
 * IsosurfaceExtraction gives them.
 * \return nothing, per isovalue, on the others */
PCL_UVOL_EXPORTS std::vector<std::vector<GlobalIsopoint>>
gatherIsopoints(std::vector<std::vector<GlobalIsopoint>>&& isopoints,
                Communicator& communicator,
                unsigned threads);

} // namespace pcl_uvol
