// SPDX-License-Identifier: BSD-3-Clause
// Derivative stencils of many samples as vector kernels read them: sixteen samples side
// by side, weights in 16 bits. Plain arrays, no library headers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_uvol {

/** Samples of a group, whatever the instruction set. */
constexpr std::size_t stencil_lanes = 16;

/** First and second derivatives: rows of a stencil, at most. */
constexpr std::size_t most_stencil_rows = 9;

/** Refers to Stencils. A derivative is its scale times the sum over the neighbours of
 * weight times difference of values. */
struct StencilView {
  std::size_t rows, neighbors;  ///< per sample
  const std::uint32_t* indices; ///< [group][neighbour][lane]
  const std::int16_t* weights;  ///< [group][neighbour][row][lane]
  const float* scales;          ///< [group][row][lane]

  const std::uint32_t*
  indicesOf(std::size_t group) const
  {
    return indices + group * neighbors * stencil_lanes;
  }

  const std::int16_t*
  computeWeights(std::size_t group) const
  {
    return weights + group * neighbors * rows * stencil_lanes;
  }

  const float*
  scalesOf(std::size_t group) const
  {
    return scales + group * rows * stencil_lanes;
  }
};

} // namespace pcl_uvol
