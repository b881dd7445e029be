// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: one register of floats or integers, and what the compiler's
// vector types lack. Included by *_kernel.cpp only, once per instruction set.
#pragma once

#include "common/register_bytes.h"

#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace pcl_uvol::PCL_UVOL_SIMD {

/** Numbers of 32 bits in a register. */
constexpr int lanes = register_bytes / 4;

using Floats = float __attribute__((vector_size(register_bytes)));
using Ints = std::int32_t __attribute__((vector_size(register_bytes)));
using Longs = std::int64_t __attribute__((vector_size(register_bytes)));

template <typename Register, typename Element>
inline Register
load(const Element* values)
{
  Register loaded;
  __builtin_memcpy(&loaded, values, sizeof loaded);
  return loaded;
}

template <typename Register, typename Element>
inline void
store(Element* values, const Register& stored)
{
  __builtin_memcpy(values, &stored, sizeof stored);
}

/** The same bits as another type. */
template <typename To, typename From>
inline To
bitCast(const From& from)
{
  static_assert(sizeof(To) == sizeof(From), "of one size");
  To to;
  __builtin_memcpy(&to, &from, sizeof to);
  return to;
}

inline Floats
fill(float value)
{
  return Floats{} + value;
}

inline Ints
fill(std::int32_t value)
{
  return Ints{} + value;
}

inline Floats
minimum(const Floats& a, const Floats& b)
{
  return a < b ? a : b;
}

inline Floats
maximum(const Floats& a, const Floats& b)
{
  return a > b ? a : b;
}

inline Floats
clamp01(const Floats& a)
{
  return minimum(maximum(a, Floats{}), fill(1.0f));
}

inline Ints
bitsOf(const Floats& a)
{
  return bitCast<Ints>(a);
}

inline Floats
fromBits(const Ints& a)
{
  return bitCast<Floats>(a);
}

inline Floats
absolute(const Floats& a)
{
  return fromBits(bitsOf(a) & 0x7fffffff);
}

/** The magnitude of one number with the sign of another. */
inline Floats
copySign(const Floats& magnitude, const Floats& sign)
{
  constexpr std::int32_t sign_bit = INT32_MIN;
  return fromBits((bitsOf(magnitude) & ~sign_bit) | (bitsOf(sign) & sign_bit));
}

inline Floats
toFloats(const Ints& a)
{
  return __builtin_convertvector(a, Floats);
}

/** Towards zero. */
inline Ints
toInts(const Floats& a)
{
  return __builtin_convertvector(a, Ints);
}

inline Floats
squareRoot(Floats a)
{
  for (int lane = 0; lane < lanes; ++lane)
    a[lane] = __builtin_sqrtf(a[lane]);
  return a;
}

/** 0, 1, 2, ... */
inline Ints
laneNumbers()
{
  Ints numbers{};
  for (int lane = 0; lane < lanes; ++lane)
    numbers[lane] = lane;
  return numbers;
}

/** One bit per lane of a comparison of 32-bit numbers. */
inline std::uint32_t
laneBits(const Ints& comparison)
{
#if defined(__AVX512F__)
  return _mm512_movepi32_mask(bitCast<__m512i>(comparison));
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(bitCast<__m256>(comparison)));
#else
  std::uint32_t bits = 0;
  for (int lane = 0; lane < lanes; ++lane)
    bits |= static_cast<std::uint32_t>(comparison[lane] & 1) << lane;
  return bits;
#endif
}

/** One bit per lane of a comparison of 64-bit numbers. */
inline std::uint32_t
laneBits(const Longs& comparison)
{
#if defined(__AVX512F__)
  return _mm512_movepi64_mask(bitCast<__m512i>(comparison));
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_pd(bitCast<__m256d>(comparison)));
#else
  std::uint32_t bits = 0;
  for (int lane = 0; lane < lanes / 2; ++lane)
    bits |= static_cast<std::uint32_t>(comparison[lane] & 1) << lane;
  return bits;
#endif
}

/** The upper 32 bits of the numbers of two registers. */
inline Ints
upperHalves(const Longs& a, const Longs& b)
{
#if defined(__AVX512F__)
  const Ints odd = 2 * laneNumbers() + 1;
  return bitCast<Ints>(_mm512_permutex2var_epi32(
      bitCast<__m512i>(a), bitCast<__m512i>(odd), bitCast<__m512i>(b)));
#elif defined(__AVX2__)
  constexpr int odd = 0xdd, middle_swapped = 0xd8;
  const __m256 by_halves =
      _mm256_shuffle_ps(bitCast<__m256>(a), bitCast<__m256>(b), odd);
  return bitCast<Ints>(
      _mm256_permute4x64_epi64(bitCast<__m256i>(by_halves), middle_swapped));
#else
  Ints upper{};
  for (int lane = 0; lane < lanes / 2; ++lane) {
    upper[lane] = static_cast<std::int32_t>(a[lane] >> 32);
    upper[lanes / 2 + lane] = static_cast<std::int32_t>(b[lane] >> 32);
  }
  return upper;
#endif
}

/** The lower 32 bits of the numbers of two registers. */
inline Ints
lowerHalves(const Longs& a, const Longs& b)
{
  return upperHalves(a << 32, b << 32);
}

/** base[index] of every lane. */
inline Floats
gather(const float* base, const Ints& index)
{
#if defined(__AVX512F__)
  const __m512 gathered = _mm512_mask_i32gather_ps(
      _mm512_setzero_ps(), 0xffff, bitCast<__m512i>(index), base, 4);
  return bitCast<Floats>(gathered);
#elif defined(__AVX2__)
  const __m256 gathered = _mm256_i32gather_ps(base, bitCast<__m256i>(index), 4);
  return bitCast<Floats>(gathered);
#else
  Floats gathered{};
  for (int lane = 0; lane < lanes; ++lane)
    gathered[lane] = base[index[lane]];
  return gathered;
#endif
}

/** As many whole numbers of 16 bits as a register has lanes. */
inline Floats
loadShorts(const std::int16_t* values)
{
#if defined(__AVX512F__)
  // Compilers take the widening apart.
  const __m256i shorts = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(values));
  const auto ints = bitCast<Ints>(_mm512_maskz_cvtepi16_epi32(0xffff, shorts));
  return __builtin_convertvector(ints, Floats);
#else
  using Shorts =
      std::int16_t __attribute__((vector_size(register_bytes / 2), aligned(2)));
  return __builtin_convertvector(*reinterpret_cast<const Shorts*>(values), Floats);
#endif
}

/** Bytes of two rows, half a register of each. */
inline Ints
loadBytes(const std::uint8_t* first, const std::uint8_t* second)
{
#if defined(__AVX512F__)
  // Through memory the parts would have to wait for one another.
  std::int64_t rows[2];
  __builtin_memcpy(&rows[0], first, sizeof rows[0]);
  __builtin_memcpy(&rows[1], second, sizeof rows[1]);
  const __m128i bytes = _mm_set_epi64x(rows[1], rows[0]);
  return bitCast<Ints>(_mm512_maskz_cvtepu8_epi32(0xffff, bytes));
#else
  Ints bytes{};
  for (int lane = 0; lane < lanes / 2; ++lane) {
    bytes[lane] = first[lane];
    bytes[lanes / 2 + lane] = second[lane];
  }
  return bytes;
#endif
}

/** The lowest byte of every lane. */
inline void
storeBytes(std::uint8_t* bytes, const Ints& stored)
{
  using Bytes = std::uint8_t __attribute__((vector_size(lanes)));
  store(bytes, __builtin_convertvector(stored, Bytes));
}

/** base[2 * index] of every lane. */
inline Ints
gatherEven(const std::uint32_t* base, const Ints& index)
{
#if defined(__AVX512F__)
  // The form without a mask starts from an undefined register, which warns.
  const __m512i gathered = _mm512_mask_i32gather_epi32(
      _mm512_setzero_si512(), 0xffff, bitCast<__m512i>(index), base, 8);
  return bitCast<Ints>(gathered);
#elif defined(__AVX2__)
  const __m256i gathered = _mm256_i32gather_epi32(
      reinterpret_cast<const int*>(base), bitCast<__m256i>(index), 8);
  return bitCast<Ints>(gathered);
#else
  Ints gathered{};
  for (int lane = 0; lane < lanes; ++lane)
    gathered[lane] = static_cast<std::int32_t>(base[2 * index[lane]]);
  return gathered;
#endif
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
