// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/blend_kernel.h"

#include "common/lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

/** Numbers of 64 bits in a register. */
constexpr std::size_t wide_lanes = register_bytes / 8;

using Doubles = double __attribute__((vector_size(register_bytes)));
using HalfFloats = float __attribute__((vector_size(register_bytes / 2)));

static_assert(ball_padding >= wide_lanes, "kernels read whole registers");

Doubles
larger(const Doubles& a, const Doubles& b)
{
  return a > b ? a : b;
}

/** Append the indices of the lanes of a comparison that holds. */
std::size_t
append(const Longs& holds, std::size_t first, std::size_t count, std::uint32_t* indices)
{
  for (std::uint32_t bits = laneBits(holds); bits != 0; bits &= bits - 1)
    indices[count++] = static_cast<std::uint32_t>(first) +
                       static_cast<std::uint32_t>(__builtin_ctz(bits));
  return count;
}

/** Coordinates of a register of centres. */
Doubles
loadCenters(const float* row)
{
  return __builtin_convertvector(load<HalfFloats>(row), Doubles);
}

std::size_t
findHolding(const float* const* centers,
            const double* per_sq_radius,
            std::size_t count,
            const double* place,
            std::uint32_t* held,
            double* part)
{
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; i += wide_lanes) {
    const Doubles dx = place[0] - loadCenters(centers[0] + i),
                  dy = place[1] - loadCenters(centers[1] + i),
                  dz = place[2] - loadCenters(centers[2] + i);
    const Doubles parts =
        (dx * dx + dy * dy + dz * dz) * load<Doubles>(per_sq_radius + i);
    const Longs holds = parts < 1.0;
    const std::size_t before = found;
    found = append(holds, i, found, held);
    for (std::size_t k = before; k < found; ++k)
      part[k] = parts[held[k] - i];
  }
  return found;
}

std::size_t
findReaching(const float* const* centers,
             const double* sq_radius,
             double sq_factor,
             std::size_t count,
             const double* low,
             const double* high,
             std::uint32_t* reaching)
{
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; i += wide_lanes) {
    Doubles sq_gap{};
    for (int axis = 0; axis < 3; ++axis) {
      const Doubles x = loadCenters(centers[axis] + i);
      const Doubles gap = larger(larger(low[axis] - x, x - high[axis]), Doubles{});
      sq_gap += gap * gap;
    }
    found =
        append(sq_gap < sq_factor * load<Doubles>(sq_radius + i), i, found, reaching);
  }
  return found;
}

/** Four sums side by side: as many on all machines, in one order. Functions neither
 * take nor return them by value, which machines without such registers do differently.
 */
using Sums = double __attribute__((vector_size(32)));

double
dot(const double* coefficients, const Sums* terms)
{
  Sums sum{};
  for (std::size_t i = 0; i < cubic_terms / 4; ++i) {
    Sums factors;
    __builtin_memcpy(&factors, coefficients + 4 * i, sizeof factors);
    sum += factors * terms[i];
  }
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

void
evaluateCubics(const double* coefficients,
               std::size_t fields,
               const double* place,
               double* values,
               double* gradients)
{
  const double x = place[0], y = place[1], z = place[2];
  const double xx = x * x, xy = x * y, xz = x * z, yy = y * y, yz = y * z, zz = z * z;
  const Sums terms[] = {{1.0, x, y, z},
                        {xx, xy, xz, yy},
                        {yz, zz, xx * x, xx * y},
                        {xx * z, x * yy, x * yz, x * zz},
                        {yy * y, yy * z, y * zz, zz * z}};
  for (std::size_t f = 0; f < fields; ++f)
    values[f] = dot(coefficients + f * cubic_terms, terms);
  if (gradients == nullptr)
    return;
  const Sums by_x[] = {{0.0, 1.0, 0.0, 0.0},
                       {2.0 * x, y, z, 0.0},
                       {0.0, 0.0, 3.0 * xx, 2.0 * xy},
                       {2.0 * xz, yy, yz, zz},
                       {0.0, 0.0, 0.0, 0.0}};
  const Sums by_y[] = {{0.0, 0.0, 1.0, 0.0},
                       {0.0, x, 0.0, 2.0 * y},
                       {z, 0.0, 0.0, xx},
                       {0.0, 2.0 * xy, xz, 0.0},
                       {3.0 * yy, 2.0 * yz, zz, 0.0}};
  const Sums by_z[] = {{0.0, 0.0, 0.0, 1.0},
                       {0.0, 0.0, x, 0.0},
                       {y, 2.0 * z, 0.0, 0.0},
                       {xx, 0.0, xy, 2.0 * xz},
                       {0.0, yy, 2.0 * yz, 3.0 * zz}};
  for (std::size_t f = 0; f < fields; ++f) {
    const double* const c = coefficients + f * cubic_terms;
    gradients[3 * f] = dot(c, by_x);
    gradients[3 * f + 1] = dot(c, by_y);
    gradients[3 * f + 2] = dot(c, by_z);
  }
}

} // namespace

extern const BlendKernels blend_kernels{findHolding, findReaching, evaluateCubics};

} // namespace pcl_uvol::PCL_UVOL_SIMD
