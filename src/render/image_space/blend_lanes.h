// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: what discs add to the sums of pixels.
#pragma once

#include "common/lanes.h"
#include "render/image_space/disc_kernel.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

/** Pixels that share a register: so many columns of two rows. */
constexpr int patch_columns = lanes / 2;

/** All sums of a pixel. */
using PixelSums = float __attribute__((vector_size(blended_values * sizeof(float))));

/** What a disc adds to pixels: its normal changes over it. */
struct DiscValues {
  PixelSums middle, along_a, along_b;
};

/** Of the pixels of a patch: places on a disc in its axes, and weights. */
struct DiscPlaces {
  Floats a, b, weights;
};

/** Clear the sums of a pixel's segment if it is the first one there. */
inline void
reachSegment(const BlendSums& blended, std::ptrdiff_t pixel)
{
  const std::ptrdiff_t segment = BlendSums::segmentOf(pixel);
  if (blended.marks[segment] != 0)
    return;
  blended.marks[segment] = 1;
  const std::ptrdiff_t first = segment * blend_segment - blend_segment / 2;
  __builtin_memset(blended.values + blended_values * first,
                   0,
                   sizeof(float) * blended_values * blend_segment);
}

/** The same for all pixels of a row of a patch that have a bit. */
inline void
reachSegments(const BlendSums& blended, std::ptrdiff_t pixel, std::uint32_t bits)
{
  static_assert(patch_columns <= blend_segment, "at most two segments");
  if (bits == 0)
    return;
  reachSegment(blended, pixel + __builtin_ctz(bits));
  reachSegment(blended, pixel + (31 - __builtin_clz(bits)));
}

#if defined(__AVX512F__)

/** By the bits of two pixels. */
constexpr __mmask16 masks_of_pairs[] = {0, 0xff, 0xff00, 0xffff};

/** Adds what a disc has to pixels, two side by side at once. */
class PixelAdder {
public:
  explicit PixelAdder(const DiscValues& values)
      : middle_(twice(values.middle))
      , along_a_(twice(values.along_a))
      , along_b_(twice(values.along_b))
  {
  }

  /** To the pixels of a row of a patch that have a bit.
   * \param first lane of the row */
  void
  add(const BlendSums& blended,
      std::ptrdiff_t pixel,
      int first,
      std::uint32_t bits,
      const DiscPlaces& places) const
  {
    if (bits == 0)
      return;
      // All pairs of a row are cheaper than to predict which ones have a bit.
#pragma GCC unroll 4
    for (int lane = 0; lane < patch_columns; lane += 2) {
      const Ints of_pixel = (laneNumbers() >> 3) + (first + lane);
      float* const sums = blended.values + blended_values * (pixel + lane);
      const Floats here = (middle_ + along_a_ * take(places.a, of_pixel)) +
                          along_b_ * take(places.b, of_pixel);
      const Floats more = here * take(places.weights, of_pixel);
      const __m512 before = _mm512_loadu_ps(sums);
      _mm512_storeu_ps(
          sums,
          _mm512_mask_add_ps(
              before, masks_of_pairs[bits >> lane & 3], before, bitCast<__m512>(more)));
    }
  }

private:
  static_assert(lanes == 2 * blended_values);

  static Floats
  twice(const PixelSums& sums)
  {
    Floats both;
    for (int k = 0; k < lanes; ++k)
      both[k] = sums[k % blended_values];
    return both;
  }

  /** Values of the lanes that indices name. */
  static Floats
  take(const Floats& values, const Ints& index)
  {
    return bitCast<Floats>(_mm512_maskz_permutexvar_ps(
        0xffff, bitCast<__m512i>(index), bitCast<__m512>(values)));
  }

  Floats middle_, along_a_, along_b_;
};

#else

/** Adds what a disc has to pixels. */
class PixelAdder {
public:
  explicit PixelAdder(const DiscValues& values)
      : values_(values)
  {
  }

  /** To the pixels of a row of a patch that have a bit.
   * \param first lane of the row */
  void
  add(const BlendSums& blended,
      std::ptrdiff_t pixel,
      int first,
      std::uint32_t bits,
      const DiscPlaces& places) const
  {
    alignas(64) float weights[lanes], a[lanes], b[lanes];
    store(weights, places.weights);
    store(a, places.a);
    store(b, places.b);
    for (; bits != 0; bits &= bits - 1) {
      const int column = __builtin_ctz(bits), lane = first + column;
      float* const sums = blended.values + blended_values * (pixel + column);
      const PixelSums here =
          (values_.middle + values_.along_a * a[lane]) + values_.along_b * b[lane];
      store(sums, load<PixelSums>(sums) + here * weights[lane]);
    }
  }

private:
  DiscValues values_;
};

#endif

} // namespace pcl_uvol::PCL_UVOL_SIMD
