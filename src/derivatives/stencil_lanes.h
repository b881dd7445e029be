// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: the derivatives of a field at a register of samples.
#pragma once

#include "common/lanes.h"
#include "derivatives/stencil_view.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

/** Registers of a group. */
constexpr int stencil_registers = static_cast<int>(stencil_lanes) / lanes;

/** Neighbours ahead that stencils are fetched into the cache. */
constexpr std::size_t neighbors_ahead = 8;

template <typename T>
inline void
fetchAhead(const T* next, std::size_t count)
{
  const char* const ahead =
      reinterpret_cast<const char*>(next + neighbors_ahead * count);
#pragma GCC unroll 8
  for (std::size_t i = 0; i < count * sizeof(T); i += 64)
    __builtin_prefetch(ahead + i);
}

/** The first derivatives of a stencil at the samples of one register of a group; the
 * others' lanes do not matter to a sample, so that all instruction sets give the same
 * bytes.
 * \param value of an index, for a register of them
 * \param own values of the samples themselves */
template <std::size_t rows, typename Value>
inline void
differentiate(const StencilView& stencils,
              std::size_t group,
              int part,
              const Value& value,
              const Floats& own,
              Floats* derivatives)
{
  const std::uint32_t* indices = stencils.indicesOf(group) + part * lanes;
  const std::int16_t* weights = stencils.computeWeights(group) + part * lanes;
  Floats sums[rows]{};
  for (std::size_t j = 0; j < stencils.neighbors; ++j) {
    fetchAhead(weights, rows * stencil_lanes);
    fetchAhead(indices, stencil_lanes);
    const Floats difference = value(load<Ints>(indices)) - own;
#pragma GCC unroll 9
    for (std::size_t row = 0; row < rows; ++row)
      sums[row] += loadShorts(weights + row * stencil_lanes) * difference;
    indices += stencil_lanes;
    weights += stencils.rows * stencil_lanes;
  }
  const float* const scales = stencils.scalesOf(group) + part * lanes;
  for (std::size_t row = 0; row < rows; ++row)
    derivatives[row] = sums[row] * load<Floats>(scales + row * stencil_lanes);
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
