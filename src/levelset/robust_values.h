// SPDX-License-Identifier: BSD-3-Clause
// Values of a field as a level set takes them: none so far from the isovalue that it
// outweighs all others.
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/stage.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Samples next to the zero level of a function, ascending.
 * \param values by sample */
std::vector<std::uint32_t>
findCrossing(const SampleSet& samples,
             const std::vector<float>& values,
             unsigned threads);

/** \brief What tameValues() leaves. */
struct TamedValues {
  std::vector<std::uint32_t> crossing; ///< samples next to the zero level; none if the
                                       ///< spikes were all
  bool had_spikes;                     ///< as many as are worth a warning
};

/** \brief Bring a field near 1 at the surface, by a power of two, replace spikes there
 * by the median of their neighbours, and limit all other values.
 * \param f minus the isovalue, by sample; only its signs and ratios matter to a level
 * set
 * \param k neighbours that a spike is told by
 * \param report gets the count "outliers", of spikes, and a warning if there are many
 */
TamedValues
tameValues(const SampleSet& samples,
           std::vector<float>& f,
           std::size_t k,
           unsigned threads,
           Report& report);

} // namespace pcl_uvol
