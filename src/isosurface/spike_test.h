// SPDX-License-Identifier: BSD-3-Clause
// Whether a sample has a value that stands alone: one unlike those of all around it,
// which agree with one another.
#pragma once

#include "isosurface/isopoints.h"
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief What parts a spike from noise. */
struct SpikeBounds {
  float deviations;       ///< from the median of the neighbours, in median deviations
  std::size_t companions; ///< of the neighbours, nearer to it than to the median
};

/** \brief The median of the neighbours where a value is a spike among them, else the
 * value.
 * \param others values of the neighbours; changed */
PCL_UVOL_EXPORTS float
settleValue(float own, std::vector<float>& others, const SpikeBounds& bounds);

/** \brief Tells spikes among samples next to an isovalue, one after another; one object
 * per thread. */
class SpikeTest {
public:
  /** \brief The most samples on a spike's side of the isovalue among those in cells
   * that touch its own, which are about 11. */
  static constexpr std::size_t most_alike = 1;

  /** \param input must outlive the test */
  SpikeTest(const IsopointInput& input, float isovalue)
      : input_(input)
      , isovalue_(isovalue)
  {
  }

  /** \brief Whether isopoints around a sample stand for nothing but its value: it alone
   * lies on its side of the isovalue, and farther from it than its neighbours. Values
   * that vary by decades are judged by their logarithms as well. */
  bool
  isSpike(std::uint32_t sample);

private:
  bool
  isOutlier(float own) const;

  const IsopointInput& input_;
  float isovalue_;
  std::vector<std::uint32_t> neighbors_;
  std::vector<float> others_;
};

/** \brief Count spikes among the samples next to an isovalue.
 * \param tally gets their number
 * \param report gets it as "spikes" */
void
countSpikes(const IsopointInput& input,
            const std::vector<std::uint32_t>& crossing,
            float isovalue,
            SurfaceTally& tally,
            Report& report);

} // namespace pcl_uvol
