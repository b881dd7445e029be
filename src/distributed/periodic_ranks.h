// SPDX-License-Identifier: BSD-3-Clause
// A box that repeats whose samples many processes hold parts of: each gives those that
// it holds their images.
#pragma once

#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief findPeriodicBox() for the samples of all processes, which have one origin.
 *
 * \param report gets the count of this process and the warnings of all */
PCL_UVOL_EXPORTS PeriodicBox
findPeriodicBox(const Dataset& part,
                const std::array<double, 3>& sides,
                Communicator& communicator,
                Report& report);

/** \brief cutAtWidestGap() for the samples of all processes. */
PCL_UVOL_EXPORTS PeriodicBox
cutAtWidestGap(const Dataset& part,
               const PeriodicBox& box,
               Communicator& communicator,
               unsigned threads);

/** \brief addPeriodicImages() for the samples of a process: as far as those of all
 * processes need them.
 *
 * Neighbours are looked for across processes, among the samples near the faces, until
 * the reach suffices: they are dealt out for that, and the samples that the processes
 * have stay where they are. */
PCL_UVOL_EXPORTS PeriodicSamples
addPeriodicImages(const Dataset& part,
                  const std::vector<std::uint32_t>& use,
                  const PeriodicBox& box,
                  const PeriodicReach& reach,
                  Communicator& communicator,
                  unsigned threads,
                  Report& report);

} // namespace pcl_uvol
