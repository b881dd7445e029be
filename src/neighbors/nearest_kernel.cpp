// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_kernel.h"

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

#if defined(__AVX512F__)
constexpr std::size_t lanes = 16;
static_assert(lanes <= kernel_room, "whole registers are written");

/** Every third of 48 floats, from the given one on. */
__m512
everyThird(int first, __m512 a, __m512 b, __m512 c)
{
  const __m512i index = _mm512_add_epi32(
      _mm512_mullo_epi32(
          _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15),
          _mm512_set1_epi32(3)),
      _mm512_set1_epi32(first));
  const __mmask16 of_last = _mm512_cmpge_epi32_mask(index, _mm512_set1_epi32(32));
  return _mm512_mask_permutexvar_ps(
      _mm512_permutex2var_ps(a, index, b), of_last, index, c);
}

/** The coordinates that lie between two bounds. */
__mmask16
between(__m512 x, float low, float high)
{
  return static_cast<__mmask16>(
      _mm512_cmp_ps_mask(x, _mm512_set1_ps(low), _CMP_GE_OQ) &
      _mm512_cmp_ps_mask(x, _mm512_set1_ps(high), _CMP_LE_OQ));
}
#endif

std::size_t
keepInside(const float* positions,
           std::uint32_t begin,
           std::uint32_t end,
           const float* low,
           const float* high,
           const BoxedSamples& kept)
{
  std::size_t count = 0;
  std::uint32_t i = begin;
#if defined(__AVX512F__)
  // Compilers find neither the transposition nor the compression by themselves.
  for (; i < end; i += static_cast<std::uint32_t>(lanes)) {
    const std::uint32_t here = end - i < lanes ? end - i : lanes;
    const std::uint64_t floats = (std::uint64_t(1) << (3 * here)) - 1;
    const float* const p = positions + std::size_t(3) * i;
    const __m512 a = _mm512_maskz_loadu_ps(static_cast<__mmask16>(floats), p);
    const __m512 b =
        _mm512_maskz_loadu_ps(static_cast<__mmask16>(floats >> 16), p + 16);
    const __m512 c =
        _mm512_maskz_loadu_ps(static_cast<__mmask16>(floats >> 32), p + 32);
    const __m512 x = everyThird(0, a, b, c), y = everyThird(1, a, b, c),
                 z = everyThird(2, a, b, c);
    const auto inside = static_cast<__mmask16>(
        ((1u << here) - 1) & between(x, low[0], high[0]) & between(y, low[1], high[1]) &
        between(z, low[2], high[2]));
    const __m512i index = _mm512_add_epi32(
        _mm512_set1_epi32(static_cast<int>(i)),
        _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    _mm512_storeu_ps(kept.x + count, _mm512_maskz_compress_ps(inside, x));
    _mm512_storeu_ps(kept.y + count, _mm512_maskz_compress_ps(inside, y));
    _mm512_storeu_ps(kept.z + count, _mm512_maskz_compress_ps(inside, z));
    _mm512_storeu_si512(kept.indices + count,
                        _mm512_maskz_compress_epi32(inside, index));
    count += static_cast<std::size_t>(__builtin_popcount(inside));
  }
#else
  // Written first and counted if inside: no branches to be mispredicted.
  for (; i < end; ++i) {
    const float* const p = positions + std::size_t(3) * i;
    kept.x[count] = p[0];
    kept.y[count] = p[1];
    kept.z[count] = p[2];
    kept.indices[count] = i;
    count += static_cast<std::size_t>(
        static_cast<int>(p[0] >= low[0]) & static_cast<int>(p[0] <= high[0]) &
        static_cast<int>(p[1] >= low[1]) & static_cast<int>(p[1] <= high[1]) &
        static_cast<int>(p[2] >= low[2]) & static_cast<int>(p[2] <= high[2]));
  }
#endif
  return count;
}

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

extern const NearestKernels nearest_kernels{
    keepInside, measure, countWithin, keepWithin};

} // namespace pcl_uvol::PCL_UVOL_SIMD
