// SPDX-License-Identifier: BSD-3-Clause
// How much a level set should smooth: the weight mu of the data, by an estimate of how
// far the surface will be from the true one.
#pragma once

#include "levelset/band.h"
#include "levelset/data_term.h"
#include "levelset/deviation.h"
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <vector>

namespace pcl_uvol {

/** \brief For how long a weight acts. */
struct MuStage {
  double mu;
  double time; ///< in squared spacings
};

/** \brief What smoothing a field as well as possible takes. */
struct MuChoice {
  std::vector<MuStage> stages; ///< none where the data are best as they are
  NoiseShares shares;          ///< after the last one
};

/** \brief Weights from large to small, one after another, that lead from the data to
 * the function with the least expected deviation.
 *
 * The deviation is that of fits at samples near the surface, as isopoints are made from
 * fits, by Stein's unbiased risk estimate: the mean square of what was taken away, less
 * the variance of the noise, plus twice that times the share of the noise that is left.
 * That share shows in a second copy of the data, with a little known noise on it, that
 * is smoothed as well (Ramani, Blu, Unser 2008).
 *
 * Going down from large weights never damages the surface on the way, and stopping
 * where the estimate rises keeps what would shrink if it went on. Steps are
 * asynchronous whatever the parameters say, so that the choice does not depend on them.
 * \param term of a band around the surface of the data */
MuChoice
chooseMu(const Band& band,
         const SampleSet& samples,
         const DataTerm& term,
         const LevelSetParameters& parameters,
         double spacing,
         unsigned threads,
         Report& report);

/** \brief What a given weight leaves of the noise, once the surface is nearly at rest.
 * \param term of a band around the surface of the data, or around a part of it */
NoiseShares
measureShares(const Band& band,
              const SampleSet& samples,
              const DataTerm& term,
              const LevelSetParameters& parameters,
              double spacing,
              double mu,
              unsigned threads);

} // namespace pcl_uvol
