// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/occlusion_kernel.h"

#include "render/image_space/octahedral_lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

void
place(const Shading& s,
      const PixelKey* keys,
      int cell,
      int column,
      int row,
      int count,
      const CellRow& cells)
{
  const float* const r = s.rotation;
  const float qy = (static_cast<float>(row) + 0.5f - s.center_y) * s.per_focal;
  for (int i = 0; i < count; i += lanes) {
    alignas(64) std::int32_t ids[lanes], depths[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const PixelKey key = keys[i + lane];
      ids[lane] = static_cast<std::int32_t>(key);
      depths[lane] = static_cast<std::int32_t>(key >> 32);
    }
    const Ints id = load<Ints>(ids);
    const Ints is_surface = id != -1;
    const Floats depth = load<Floats>(depths);
    Floats n[3];
    unpackDirection(gatherEven(s.looks, is_surface ? id : Ints{}), n);
    const Floats per_length =
        1.0f / squareRoot(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const Ints columns = (laneNumbers() + i) * cell + column;
    const Floats qx = (toFloats(columns) + 0.5f - s.center_x) * s.per_focal;
    const Floats z = depth * s.far * (1.0f / squareRoot(qx * qx + qy * qy + 1.0f));
    const Floats seen[3] = {(r[0] * n[0] + r[1] * n[1] + r[2] * n[2]) * per_length,
                            (r[3] * n[0] + r[4] * n[1] + r[5] * n[2]) * per_length,
                            (r[6] * n[0] + r[7] * n[1] + r[8] * n[2]) * per_length};
    const Ints is_away = seen[0] * qx + seen[1] * qy + seen[2] > 0.0f;
    const Floats turn = (s.two_sided ? is_away : Ints{}) ? fill(-1.0f) : fill(1.0f);
    const Floats positions[3] = {qx * z, qy * z, z};
    for (int k = 0; k < 3; ++k) {
      store(cells.position[k] + i, is_surface ? positions[k] : fill(beyond_all));
      store(cells.normal[k] + i, seen[k] * turn);
    }
    store(cells.depth + i, is_surface ? depth : fill(no_depth));
  }
}

/** Sine of the angle by which the surface a step away rises over the tangent plane,
 * less what roughness may be, and less with its distance. */
Floats
rise(const CellRow& cells,
     std::ptrdiff_t there,
     const Floats* position,
     const Floats* normal,
     const Floats& per_sq_radius,
     const OcclusionSearch& search)
{
  Floats along{}, sq_distance{};
  for (int k = 0; k < 3; ++k) {
    const Floats step = load<Floats>(cells.position[k] + there) - position[k];
    along += step * normal[k];
    sq_distance += step * step;
  }
  const Floats sine =
      (along - search.roughness) / squareRoot(maximum(sq_distance, fill(1e-30f)));
  return (sine - search.least_sine) * (1.0f / (1.0f - search.least_sine)) *
         clamp01(falloff * (1.0f - sq_distance * per_sq_radius));
}

void
open(const CellRow& cells, const OcclusionSearch& search, int count, float* openness)
{
  for (int i = 0; i < count; i += lanes) {
    const Ints is_surface = load<Floats>(cells.depth + i) < no_depth;
    if (laneBits(is_surface) == 0) {
      store(openness + i, fill(1.0f));
      continue;
    }
    Floats position[3], normal[3];
    for (int k = 0; k < 3; ++k) {
      position[k] = load<Floats>(cells.position[k] + i);
      normal[k] = load<Floats>(cells.normal[k] + i);
    }
    const Floats radius = position[2] * search.radius;
    const Floats per_sq_radius = 1.0f / (radius * radius);
    Floats closed{};
    for (int direction = 0; direction < search.directions; ++direction) {
      const std::ptrdiff_t* const steps = search.offsets + direction * search.steps;
      Floats highest{};
      for (int step = 0; step < search.steps; ++step)
        highest = maximum(
            highest,
            rise(cells, i + steps[step], position, normal, per_sq_radius, search));
      closed += highest;
    }
    const Floats open = 1.0f - closed * (1.0f / static_cast<float>(search.directions));
    store(openness + i, is_surface ? open : fill(1.0f));
  }
}

void
darken(const CellsOfPixels& cells, int column, int count, const ShadedRow& shaded)
{
  for (int i = 0; i < count; i += lanes) {
    const Floats depth = load<Floats>(shaded.depth + i);
    const Floats opacity = load<Floats>(shaded.opacity + i);
    if (laneBits(opacity > 0.0f) == 0)
      continue;
    const Floats place =
        toFloats(laneNumbers() + (column + i - cells.half)) * cells.per_cell;
    const Ints before = toInts(place + 1.0f) - 1;
    const Floats part = place - toFloats(before);
    const Floats per_step = 1.0f / (cells.tolerance * depth);
    Floats sum = fill(open_weight), weights = fill(open_weight);
    for (int row = 0; row < 2; ++row)
      for (int next = 0; next < 2; ++next) {
        const std::ptrdiff_t first = row * cells.stride;
        const Ints cell = before + next;
        const Floats step = gather(cells.depth + first, cell) - depth;
        const Floats likeness = maximum(1.0f - absolute(step) * per_step, Floats{});
        const Floats weight = (row == 1 ? cells.part : 1.0f - cells.part) *
                              (next == 1 ? part : 1.0f - part) * likeness;
        sum += weight * gather(cells.openness + first, cell);
        weights += weight;
      }
    const Floats light = 1.0f - cells.strength * (1.0f - sum / weights);
    for (int k = 0; k < 3; ++k)
      store(shaded.color[k] + i, load<Floats>(shaded.color[k] + i) * light);
  }
}

} // namespace

extern const OcclusionKernels occlusion_kernels{place, open, darken};

} // namespace pcl_uvol::PCL_UVOL_SIMD
