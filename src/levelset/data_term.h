// SPDX-License-Identifier: BSD-3-Clause
// The data term of a level set: f - f_iso as a distance, and how noisy it is.
#pragma once

#include "levelset/band.h"

#include <vector>

namespace pcl_uvol {

/** \brief By place of a band, in units of length. */
struct DataTerm {
  std::vector<float> target; ///< (f - f_iso) / |grad f|
  std::vector<float> trust;  ///< by place of the centres, in (0, 1]
  double noise;              ///< standard deviation of target, by the residuals of fits
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

} // namespace pcl_uvol
