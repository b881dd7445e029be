// SPDX-License-Identifier: BSD-3-Clause
// The samples that a level set is advanced at: those near its zero level (Rosenthal,
// Molchanov, Linsen 2010), or all.
#pragma once

#include "derivatives/stencils.h"
#include "neighbors/sample_set.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Samples and their stencils, numbered anew by "places": the samples that are
 * advanced ("centres"), up to a whole group of stencils, then the neighbours that are
 * not. */
struct Band {
  std::vector<std::uint32_t> centers; ///< sample indices, ascending
  std::vector<std::uint32_t> others;  ///< sample indices, ascending
  std::vector<float> distance;        ///< of centres, to the nearest crossing sample;
                                      ///< empty without a band
  Stencils stencils;                  ///< neighbours by place

  /** A centre beside each of the others, the nearest that has it for a neighbour. */
  struct Support {
    std::uint32_t place;
    float distance;
  };
  std::vector<Support> supports;

  /** \brief Places of centres: whole groups. */
  std::size_t
  centerPlaces() const
  {
    return stencils.groups() * stencil_lanes;
  }

  std::size_t
  places() const
  {
    return centerPlaces() + others.size();
  }

  /** \brief Continue a distance function from the centres to the others.
   * \param phi by place */
  void
  extrapolate(std::vector<float>& phi) const;

  /** \brief Call visit(place, sample) for all samples there are. */
  template <typename Visit>
  void
  forPlaces(const Visit& visit) const
  {
    for (std::size_t i = 0; i < centers.size(); ++i)
      visit(i, centers[i]);
    for (std::size_t i = 0; i < others.size(); ++i)
      visit(centerPlaces() + i, others[i]);
  }
};

/** \brief Spacing s of samples with 1 / s^3 per volume.
 * \param reach distance of the farthest of so many neighbours */
double
spacingOf(double reach, double neighbors);

/** \brief The median spacing of the samples around some of them: s of 1 / s^3 samples
 * per volume.
 * \param k neighbours that it is measured by */
double
medianSpacing(const SampleSet& samples,
              const std::vector<std::uint32_t>& around,
              std::size_t k,
              unsigned threads);

/** \brief Stencils for the samples within a distance of the crossing ones.
 * \param crossing samples next to the zero level, ascending
 * \param width in units of length; 0: all samples
 * \param report as Stencils::compute, and the time of "band" */
Band
makeBand(const SampleSet& samples,
         const std::vector<std::uint32_t>& crossing,
         double width,
         FitScheme scheme,
         std::size_t k,
         unsigned threads,
         Report& report);

} // namespace pcl_uvol
