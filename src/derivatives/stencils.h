// SPDX-License-Identifier: BSD-3-Clause
// Derivatives at many samples again and again: positions never move, so that every
// derivative is a fixed stencil, and a sweep over the samples a sparse product.
#pragma once

#include "common/large_array.h"
#include "derivatives/local_fit.h"
#include "derivatives/stencil_view.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/stage.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The derivatives of fits at some of the samples ("centres").
 *
 * Weights are rounded to 16 bits of the largest one of their sample and derivative: a
 * sweep is bound by memory, and 3e-5 of a derivative is far below what the fit itself
 * leaves. Memory per centre with k neighbours: k (4 + 2 rows) + 4 rows + 8 bytes, which
 * is 616 for 26 neighbours and the quadratic scheme, 288 for the linear one. */
class Stencils {
public:
  /** \param centers sample indices, in spatial order for speed
   * \param k neighbours per centre: the nearest
   * \param report gets the count "isotropic_fits", of centres whose quadratic would not
   * smooth (see LocalFit::makeIsotropic), and the time of "stencils" */
  void
  compute(const SampleSet& samples,
          const std::vector<std::uint32_t>& centers,
          FitScheme scheme,
          std::size_t k,
          unsigned threads,
          Report& report);

  /** \brief Centres. */
  std::size_t
  size() const
  {
    return stiffness_.size();
  }

  std::size_t
  groups() const
  {
    return (size() + stencil_lanes - 1) / stencil_lanes;
  }

  /** \brief Neighbours: sample indices at first, whatever renumber() makes of them
   * then. Of the lanes beyond the last centre and of neighbours that do not exist the
   * weights are 0. */
  StencilView
  view() const
  {
    return {rows_, neighbors_, indices_.data(), weights_.data(), scales_.data()};
  }

  /** \brief Replace every neighbour's index.
   * \param to by sample index */
  void
  renumber(const std::vector<std::uint32_t>& to);

  /** \brief Per centre: the sum over the neighbours of the absolute weights of the
   * second derivatives, taken across any normal: a bound of the change of mean
   * curvature times slope by a change of the values by 1. 0 with the linear scheme. */
  const std::vector<float>&
  getStiffness() const
  {
    return stiffness_;
  }

  /** \brief Per centre: distance of the nearest and of the farthest neighbour. @{ */
  const std::vector<float>&
  getNearest() const
  {
    return nearest_;
  }

  const std::vector<float>&
  getReach() const
  {
    return reach_;
  }
  /** @} */

private:
  void
  store(const LocalFit& fit,
        const std::uint32_t* neighbors,
        std::size_t count,
        std::size_t center);

  std::size_t rows_ = 0, neighbors_ = 0;
  LargeArray<std::uint32_t> indices_;
  LargeArray<std::int16_t> weights_;
  std::vector<float> scales_, stiffness_, nearest_, reach_;
};

} // namespace pcl_uvol
