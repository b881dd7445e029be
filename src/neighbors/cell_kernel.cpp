// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/cell_kernel.h"

#include "common/lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

/** Numbers of 64 bits in a register. */
constexpr std::size_t wide_lanes = register_bytes / 8;

using Doubles = double __attribute__((vector_size(register_bytes)));

static_assert(cell_padding >= wide_lanes, "kernels read whole registers");

unsigned
measureHeights(const double* const* points,
               std::size_t count,
               const double* plane,
               double margin,
               double* heights)
{
  Longs over{}, inside{};
  for (std::size_t i = 0; i < count; i += wide_lanes) {
    const Doubles height = plane[0] * load<Doubles>(points[0] + i) +
                           plane[1] * load<Doubles>(points[1] + i) +
                           plane[2] * load<Doubles>(points[2] + i) - plane[3];
    store(heights + i, height);
    const Longs is_over = height > margin;
    over |= is_over;
    inside |= ~is_over & ~Longs(height < -margin);
  }
  return (laneBits(over) != 0 ? 1u : 0u) | (laneBits(inside) != 0 ? 2u : 0u);
}

double
findFirst(const double* const* points,
          std::size_t count,
          const double* plane,
          const double* sphere,
          const std::uint16_t* corners,
          double* distances,
          std::size_t* first)
{
  const Doubles never = Doubles{} + __builtin_inf();
  for (std::size_t i = 0; i < count; i += wide_lanes) {
    const Doubles x = load<Doubles>(points[0] + i), y = load<Doubles>(points[1] + i),
                  z = load<Doubles>(points[2] + i);
    const Doubles ahead = plane[0] * x + plane[1] * y + plane[2] * z - plane[3];
    const Doubles outside = load<Doubles>(points[3] + i) - sphere[0] * x -
                            sphere[1] * y - sphere[2] * z - sphere[3];
    store(distances + i, ahead > 0.0 ? outside / ahead : never);
  }
  for (int corner = 0; corner < 3; ++corner)
    distances[corners[corner]] = __builtin_inf();
  Doubles least = never;
  for (std::size_t i = 0; i < count; i += wide_lanes) {
    const Doubles distance = load<Doubles>(distances + i);
    least = distance < least ? distance : least;
  }
  double nearest = least[0];
  for (std::size_t lane = 1; lane < wide_lanes; ++lane)
    nearest = least[lane] < nearest ? least[lane] : nearest;
  *first = 0;
  while (*first + 1 < count && distances[*first] != nearest)
    ++*first;
  return nearest;
}

std::size_t
findNearest(const double* const* points, std::size_t count, const double* place)
{
  // Half the squared distance, but for what is common to all.
  Doubles least = Doubles{} + __builtin_inf();
  Longs row{}, nearest{};
  for (std::size_t lane = 0; lane < wide_lanes; ++lane)
    row[lane] = static_cast<long long>(lane);
  for (std::size_t i = 0; i < count; i += wide_lanes) {
    const Doubles distance = load<Doubles>(points[3] + i) -
                             place[0] * load<Doubles>(points[0] + i) -
                             place[1] * load<Doubles>(points[1] + i) -
                             place[2] * load<Doubles>(points[2] + i);
    const Longs is_nearer = distance < least;
    least = is_nearer ? distance : least;
    nearest = is_nearer ? row : nearest;
    row += static_cast<long long>(wide_lanes);
  }
  std::size_t first = 0;
  for (std::size_t lane = 1; lane < wide_lanes; ++lane)
    if (least[lane] < least[first] ||
        (least[lane] == least[first] && nearest[lane] < nearest[first]))
      first = lane;
  return static_cast<std::size_t>(nearest[first]);
}

} // namespace

extern const CellKernels cell_kernels{measureHeights, findFirst, findNearest};

} // namespace pcl_uvol::PCL_UVOL_SIMD
