// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/fill_kernel.h"

#include "common/lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

constexpr int keys_per_register = lanes / 2;

constexpr int ring_cells = 8;

/** The cells around a register of pixels, in circular order. */
struct Ring {
  Longs cells[ring_cells];

  Ring(const PixelKey* row, std::ptrdiff_t stride)
      : cells{load<Longs>(row - stride - 1),
              load<Longs>(row - stride),
              load<Longs>(row - stride + 1),
              load<Longs>(row + 1),
              load<Longs>(row + stride + 1),
              load<Longs>(row + stride),
              load<Longs>(row + stride - 1),
              load<Longs>(row - 1)}
  {
  }

  Longs
  smallest() const
  {
    Longs least = cells[0];
    for (int i = 1; i < ring_cells; ++i)
      least = cells[i] < least ? cells[i] : least;
    return least;
  }
};

/** Where one of the eight masks matches: four white cells in a row. With three holes
 * stay open, with five silhouettes grow. */
Longs
matchesMask(const Longs* is_white)
{
  Longs pairs[ring_cells], matches{};
  for (int i = 0; i < ring_cells; ++i)
    pairs[i] = is_white[i] & is_white[(i + 1) % ring_cells];
  for (int i = 0; i < ring_cells; ++i)
    matches |= pairs[i] & pairs[(i + 2) % ring_cells];
  return matches;
}

/** Lanes that lie before the last pixel. */
std::uint32_t
lanesBefore(int last, int column)
{
  return last - column >= keys_per_register ? ~0u : (1u << (last - column)) - 1u;
}

PixelFill*
append(PixelKey* pixels, const Longs& keys, std::uint32_t bits, PixelFill* fills)
{
  alignas(64) PixelKey key[keys_per_register];
  store(key, keys);
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    *fills++ = {pixels + lane, key[lane]};
  }
  return fills;
}

std::size_t
findBackground(
    PixelKey* row, std::ptrdiff_t stride, int first, int last, PixelFill* fills)
{
  PixelFill* next = fills;
  for (int column = first; column < last; column += keys_per_register) {
    PixelKey* const pixels = row + column;
    const Longs is_background = load<Longs>(pixels) == background_key;
    if (laneBits(is_background) == 0)
      continue;
    const Ring ring(pixels, stride);
    const Longs smallest = ring.smallest();
    if (laneBits(is_background & (smallest < background_key)) == 0)
      continue;
    Longs is_white[ring_cells];
    for (int i = 0; i < ring_cells; ++i)
      is_white[i] = ring.cells[i] == background_key;
    const Longs to_fill = is_background & ~matchesMask(is_white);
    next =
        append(pixels, smallest, laneBits(to_fill) & lanesBefore(last, column), next);
  }
  return static_cast<std::size_t>(next - fills);
}

/** The smallest key that is not in front of a register of pixels. */
Longs
frontLimit(const Longs& keys, float layer_distance)
{
  // The depth is the upper half of a key; below it a number that floats cannot take.
  constexpr std::int64_t upper_half = -(std::int64_t(1) << 32);
  const Longs upper = keys & upper_half;
  const Floats limit = maximum(bitCast<Floats>(upper) - layer_distance, Floats{});
  return bitCast<Longs>(limit) & upper_half;
}

std::size_t
findOccluded(PixelKey* row,
             std::ptrdiff_t stride,
             int first,
             int last,
             float layer_distance,
             PixelFill* fills)
{
  PixelFill* next = fills;
  for (int column = first; column < last; column += keys_per_register) {
    PixelKey* const pixels = row + column;
    const Longs keys = load<Longs>(pixels);
    const Longs is_surface = keys != background_key;
    if (laneBits(is_surface) == 0)
      continue;
    const Ring ring(pixels, stride);
    const Longs limit = frontLimit(keys, layer_distance);
    const Longs smallest = ring.smallest();
    if (laneBits(is_surface & (smallest < limit)) == 0)
      continue;
    Longs is_white[ring_cells];
    for (int i = 0; i < ring_cells; ++i)
      is_white[i] = ring.cells[i] >= limit;
    const Longs to_fill = is_surface & ~matchesMask(is_white);
    next =
        append(pixels, smallest, laneBits(to_fill) & lanesBefore(last, column), next);
  }
  return static_cast<std::size_t>(next - fills);
}

} // namespace

extern const FillKernels fill_kernels{findBackground, findOccluded};

} // namespace pcl_uvol::PCL_UVOL_SIMD
