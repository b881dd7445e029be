// SPDX-License-Identifier: BSD-3-Clause
// Whether a level set takes the values of a field or their logarithms: both have the
// same isosurface.
#pragma once

#include "common/value_frame.h"
#include "neighbors/sample_set.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief f_iso log(f / f_iso), which has the sign of f - f_iso and its slope at the
 * isosurface, in the unit of the frame; where f is less than a tenth of f_iso, the
 * tangent from there.
 * \param values in the frame
 * \param isovalue not 0 */
std::vector<float>
takeLogarithms(const std::vector<float>& values,
               const ValueFrame& frame,
               double isovalue);

/** \brief Whether the logarithms lie nearer to quadratics than the values do, by the
 * median over samples next to the surface: those of densities that vary by decades
 * within a few spacings. What quadratics do not follow would count as noise.
 * \param crossing samples next to the surface; none: they are not */
bool
areLogarithmsSmoother(const SampleSet& samples,
                      const std::vector<std::uint32_t>& crossing,
                      const std::vector<float>& f,
                      const std::vector<float>& logarithms,
                      unsigned threads);

} // namespace pcl_uvol
