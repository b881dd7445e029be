// SPDX-License-Identifier: BSD-3-Clause
// The polynomials whose derivatives stand for those of a scattered field (thesis 3.2).
#pragma once

#include <pcl_uvol/common/parameters.h>

#include <array>

namespace pcl_uvol {

/** \brief Which polynomial is fitted to the neighbours. */
enum class FitScheme {
  Linear,   ///< thesis 3.2: a plane through the sample and its neighbours, unweighted;
            ///< first order, little noise
  Quadratic ///< nine terms that pass through the sample's own value, weight
            ///< exp(-2 d^2 / h^2), h a little more than the farthest neighbour; second
            ///< order, with second derivatives (default)
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<FitScheme>, 2>
listWords(FitScheme)
{
  return {{{FitScheme::Linear, "linear"}, {FitScheme::Quadratic, "quadratic"}}};
}

} // namespace pcl_uvol
