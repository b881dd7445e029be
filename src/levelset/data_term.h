// SPDX-License-Identifier: BSD-3-Clause
// The data term of a level set: f - f_iso as a distance, and how noisy it is.
#pragma once

#include "levelset/band.h"

#include <vector>

namespace pcl_uvol {

/** \brief What the data ask for, by place of a band, in units of length. */
struct DataTerm {
  std::vector<float> target; ///< (f - f_iso) / |grad f|
  std::vector<float> trust;  ///< by place of the centres, in (0, 1]
  double noise;              ///< standard deviation of target, by the residuals of fits
                             ///< or, where these do not follow it, by close pairs
  double slope;              ///< median of |grad f|
  double slope_error;        ///< mean of | |grad target| - 1 |
};

/** \brief Scale a field to a distance.
 *
 * The slope at a sample is that of the gradients' mean over its neighbours: of single
 * gradients noise would make it too steep. Slopes are at least a tenth of their median.
 * \param f minus the isovalue, by sample index */
DataTerm
makeDataTerm(const Band& band,
             const SampleSet& samples,
             const std::vector<float>& f,
             unsigned threads,
             Report& report);

/** \brief How far the slope of a function is from that of a distance, 1: the mean over
 * the centres next to its zero level.
 * \param phi by place */
double
measureSlopeError(const Band& band, const std::vector<float>& phi, unsigned threads);

/** \brief A function over its slopes, as those of fields are: a distance at its zero
 * level, which stays where it is.
 * \param phi by place */
std::vector<float>
scaleToDistance(const Band& band, std::vector<float> phi, unsigned threads);

} // namespace pcl_uvol
