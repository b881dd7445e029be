// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/nearest_kernel.h"

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

#if defined(__AVX512F__)
constexpr std::size_t wide_run = 16;
static_assert(wide_run <= kernel_room, "whole registers are written");

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

/** Up to 16 positions, coordinate by coordinate. */
struct Transposed {
  __m512 x, y, z;
};

/** \param here number of positions, the others are 0 */
Transposed
transpose(const float* p, std::uint32_t here)
{
  const std::uint64_t floats = (std::uint64_t(1) << (3 * here)) - 1;
  const __m512 a = _mm512_maskz_loadu_ps(static_cast<__mmask16>(floats), p);
  const __m512 b = _mm512_maskz_loadu_ps(static_cast<__mmask16>(floats >> 16), p + 16);
  const __m512 c = _mm512_maskz_loadu_ps(static_cast<__mmask16>(floats >> 32), p + 32);
  return {everyThird(0, a, b, c), everyThird(1, a, b, c), everyThird(2, a, b, c)};
}

/** Squared distances of coordinates to an interval. */
__m512
sqGap(__m512 x, float low, float high)
{
  // With a mask: g++ 12 warns of the register that the plain ones leave undefined.
  constexpr __mmask16 all = 0xffff;
  const __m512 outside = _mm512_maskz_max_ps(all,
                                             _mm512_sub_ps(_mm512_set1_ps(low), x),
                                             _mm512_sub_ps(x, _mm512_set1_ps(high)));
  const __m512 gap = _mm512_maskz_max_ps(all, outside, _mm512_setzero_ps());
  return _mm512_mul_ps(gap, gap);
}
#else
float
sqGap(float x, float low, float high)
{
  const float below = low - x, above = x - high;
  const float gap = below > above ? below : above;
  return gap > 0.0f ? gap * gap : 0.0f;
}
#endif

std::size_t
keepNear(const float* positions,
         std::uint32_t begin,
         std::uint32_t end,
         const float* low,
         const float* high,
         float sq_limit,
         const CopiedSamples& kept)
{
  std::size_t count = 0;
  std::uint32_t i = begin;
#if defined(__AVX512F__)
  // Compilers find neither the transposition nor the compression by themselves.
  for (; i < end; i += static_cast<std::uint32_t>(wide_run)) {
    const std::uint32_t here = end - i < wide_run ? end - i : wide_run;
    const auto [x, y, z] = transpose(positions + std::size_t(3) * i, here);
    const __m512 sq_gap = _mm512_add_ps(
        _mm512_add_ps(sqGap(x, low[0], high[0]), sqGap(y, low[1], high[1])),
        sqGap(z, low[2], high[2]));
    const __mmask16 near =
        _mm512_mask_cmp_ps_mask(static_cast<__mmask16>((1u << here) - 1),
                                sq_gap,
                                _mm512_set1_ps(sq_limit),
                                _CMP_LE_OQ);
    const __m512i index = _mm512_add_epi32(
        _mm512_set1_epi32(static_cast<int>(i)),
        _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    _mm512_storeu_ps(kept.x + count, _mm512_maskz_compress_ps(near, x));
    _mm512_storeu_ps(kept.y + count, _mm512_maskz_compress_ps(near, y));
    _mm512_storeu_ps(kept.z + count, _mm512_maskz_compress_ps(near, z));
    _mm512_storeu_si512(kept.indices + count, _mm512_maskz_compress_epi32(near, index));
    count += static_cast<std::size_t>(__builtin_popcount(near));
  }
#else
  // Written first and counted if near: no branches to be mispredicted.
  const float low_x = low[0], low_y = low[1], low_z = low[2];
  const float high_x = high[0], high_y = high[1], high_z = high[2];
  for (; i < end; ++i) {
    const float* const p = positions + std::size_t(3) * i;
    kept.x[count] = p[0];
    kept.y[count] = p[1];
    kept.z[count] = p[2];
    kept.indices[count] = i;
    const float sq_gap = sqGap(p[0], low_x, high_x) + sqGap(p[1], low_y, high_y) +
                         sqGap(p[2], low_z, high_z);
    count += static_cast<std::size_t>(sq_gap <= sq_limit);
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

void
measureRun(const float* positions,
           std::uint32_t begin,
           std::uint32_t end,
           const float* point,
           float* sq_dist)
{
  const float px = point[0], py = point[1], pz = point[2];
  std::uint32_t i = begin;
#if defined(__AVX512F__)
  for (; i < end; i += static_cast<std::uint32_t>(wide_run)) {
    const std::uint32_t here = end - i < wide_run ? end - i : wide_run;
    const auto [x, y, z] = transpose(positions + std::size_t(3) * i, here);
    const __m512 dx = _mm512_sub_ps(x, _mm512_set1_ps(px)),
                 dy = _mm512_sub_ps(y, _mm512_set1_ps(py)),
                 dz = _mm512_sub_ps(z, _mm512_set1_ps(pz));
    _mm512_storeu_ps(
        sq_dist + (i - begin),
        _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy)),
                      _mm512_mul_ps(dz, dz)));
  }
#else
  for (; i < end; ++i) {
    const float* const p = positions + std::size_t(3) * i;
    const float dx = p[0] - px, dy = p[1] - py, dz = p[2] - pz;
    sq_dist[i - begin] = dx * dx + dy * dy + dz * dz;
  }
#endif
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
  for (; i + wide_run <= count; i += wide_run) {
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
    keepNear, measure, measureRun, countWithin, keepWithin};

} // namespace pcl_uvol::PCL_UVOL_SIMD
