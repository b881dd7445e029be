// SPDX-License-Identifier: BSD-3-Clause
// How far beyond the faces of a box the neighbours of samples lie that many processes
// hold parts of.
#pragma once

#include "distributed/samples.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>

#include <cstddef>

namespace pcl_uvol {

/** \brief What the neighbours of samples near the faces need, in the stretched space.
 */
struct NeighborNeed {
  double beyond = 0.0; ///< how far beyond the faces they lie at most
  double within = 0.0; ///< how far from the faces they lie at most, within the box
};

/** \brief Find the nearest samples of those near the faces, on all processes.
 *
 * \param samples of this process and their images; their values are the distances to
 * the faces, those of images are larger than the reach
 *
 * \param scale factors by which positions are stretched
 *
 * \param neighbors nearest samples that are wanted
 *
 * \param reach of the images: samples so near to the faces are asked
 *
 * \return the same on all processes; infinite where there are fewer samples. Samples
 * whose neighbours lie no farther beyond the faces than the reach count for nothing.
 *
 * \throws InvalidArgument on all processes if there is no sample at all */
PCL_UVOL_EXPORTS NeighborNeed
measureNeed(Samples&& samples,
            const Position& scale,
            std::size_t neighbors,
            double reach,
            Communicator& communicator,
            unsigned threads,
            const ProgressCallback& progress);

} // namespace pcl_uvol
