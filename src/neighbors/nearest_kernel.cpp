// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_kernel.h"

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

void
measure(const float* x,
        const float* y,
        const float* z,
        std::size_t count,
        const float* point,
        float* sq_dist)
{
  const float px = point[0], py = point[1], pz = point[2];
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = x[i] - px, dy = y[i] - py, dz = z[i] - pz;
    sq_dist[i] = dx * dx + dy * dy + dz * dz;
  }
}

std::size_t
countWithin(const float* values, std::size_t count, float limit)
{
  std::uint32_t within = 0;
  for (std::size_t i = 0; i < count; ++i)
    within += static_cast<std::uint32_t>(values[i] <= limit);
  return within;
}

std::size_t
keepWithin(const float* values,
           const std::uint32_t* indices,
           std::size_t count,
           float limit,
           float* kept_values,
           std::uint32_t* kept_indices)
{
  std::size_t kept = 0, i = 0;
#if defined(__AVX512F__)
  // The one instruction that compilers do not find by themselves.
  constexpr std::size_t lanes = 16;
  static_assert(lanes <= kernel_room, "whole registers are written");
  const __m512 limits = _mm512_set1_ps(limit);
  for (; i + lanes <= count; i += lanes) {
    const __m512 value = _mm512_loadu_ps(values + i);
    const __mmask16 within = _mm512_cmp_ps_mask(value, limits, _CMP_LE_OQ);
    _mm512_storeu_ps(kept_values + kept, _mm512_maskz_compress_ps(within, value));
    _mm512_storeu_si512(
        kept_indices + kept,
        _mm512_maskz_compress_epi32(within, _mm512_loadu_si512(indices + i)));
    kept += static_cast<std::size_t>(__builtin_popcount(within));
  }
#endif
  for (; i < count; ++i) {
    kept_values[kept] = values[i];
    kept_indices[kept] = indices[i];
    kept += static_cast<std::size_t>(values[i] <= limit);
  }
  return kept;
}

} // namespace

extern const NearestKernels nearest_kernels{measure, countWithin, keepWithin};

} // namespace pcl_uvol::PCL_UVOL_SIMD
