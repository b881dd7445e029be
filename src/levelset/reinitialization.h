// SPDX-License-Identifier: BSD-3-Clause
// Back to a distance function with the same zero level (thesis 3.4).
#pragma once

#include "levelset/band.h"
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <vector>

namespace pcl_uvol {

/** \brief Signed distance to the isopoints of a function's zero level, by place of the
 * band: along the normal of the nearest isopoint where that is close, else to it.
 * \param phi by sample index; its signs stay but where the isopoints say otherwise
 * \return phi itself, by place, where there is no zero level */
std::vector<float>
distanceToZeroLevel(const Band& band,
                    const SampleSet& samples,
                    const std::vector<float>& phi,
                    double spacing,
                    unsigned threads,
                    Report& report);

/** \brief The Eikonal equation of thesis 3.4 until the slope is 1, with the viscosity
 * that upwind differences have: without it the step is unstable on any samples.
 * \param phi by place */
std::vector<float>
relaxToDistance(const Band& band,
                const std::vector<float>& phi,
                double spacing,
                unsigned threads);

} // namespace pcl_uvol
