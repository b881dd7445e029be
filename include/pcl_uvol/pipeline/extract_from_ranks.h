// SPDX-License-Identifier: BSD-3-Clause
// Isosurface extraction by several processes, each of which holds a part of the
// samples.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/distributed/samples.h>
#include <pcl_uvol/isosurface/piece_isopoints.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Extract the isosurface of the samples of all processes.
 *
 * The first levels of the kd-tree part the samples into pieces, which are dealt out to
 * the processes: as many pieces as processes, or at least four times as many where
 * these are no power of two. Pieces lend each other bricks, subtrees of some hundred
 * samples, along the cuts and around isopoints close to them: what is sent after the
 * samples were dealt out grows with the cuts, not with the samples. The isopoints of
 * all processes together are those of IsosurfaceExtraction with the same settings, byte
 * for byte. \param samples of this process; there may be none \return per isovalue the
 * isopoints that lie in this process's pieces, ordered by their edges \param report
 * gets the counts, times and warnings of IsosurfaceExtraction for this process, the
 * counts "pieces", "bytes_dealt_out" and "bytes_exchanged", and the times of
 * "decomposition" and "exchange" \throws InvalidArgument on all processes if there is
 * no sample at all. Memory: about 130 bytes per sample. */
PCL_UVOL_EXPORTS std::vector<std::vector<GlobalIsopoint>>
extractFromRanks(Samples&& samples,
                 const IsosurfaceSettings& settings,
                 Communicator& communicator,
                 unsigned threads,
                 Report& report);

/** \brief Bring the isopoints of all processes to the first one, in the order in which
 * IsosurfaceExtraction gives them. \return nothing, per isovalue, on the others */
PCL_UVOL_EXPORTS std::vector<std::vector<GlobalIsopoint>>
gatherIsopoints(std::vector<std::vector<GlobalIsopoint>>&& isopoints,
                Communicator& communicator,
                unsigned threads);

} // namespace pcl_uvol
