// SPDX-License-Identifier: BSD-3-Clause
// How far the zero level of a smoothed function lies from the true surface: what is
// left of the noise, and what smoothing has moved.
#pragma once

#include "levelset/band.h"
#include "levelset/data_term.h"

#include <vector>

namespace pcl_uvol {

/** \brief Standard deviations of independent noise of deviation 1, after smoothing. */
struct NoiseShares {
  double of_surface = 0.0;  ///< of fits to phi next to its zero level
  double of_residual = 0.0; ///< of what was taken away: of target - phi
};

/** \brief Standard deviation of the zero level from the true surface beside each centre
 * of a band, in units of length.
 *
 * The residuals target - phi of a centre and its neighbours scatter by the part of the
 * noise that was taken away: the shares tell from it the part that is left. Their mean
 * tells the rest: where it is larger than the scatter explains, smoothing has moved the
 * surface. Noise may differ from place to place; what is left of it is the same part
 * everywhere, since lengths are local spacings.
 * \param phi by place
 * \param shares where nearly nothing was taken away, 0 is the answer: fits to phi see
 * the noise themselves */
std::vector<float>
findDeviations(const Band& band,
               const std::vector<float>& phi,
               const DataTerm& term,
               const NoiseShares& shares,
               unsigned threads);

} // namespace pcl_uvol
