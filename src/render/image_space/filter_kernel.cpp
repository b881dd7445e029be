// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/filter_kernel.h"

#include "common/lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

/** Weighted sum of the 3 x 3 numbers around those of a register. */
Floats
filtered(const float* values, std::ptrdiff_t stride, const FilterWeights& weights)
{
  const auto column = [&](const float* v) {
    return load<Floats>(v - stride) + load<Floats>(v + stride) +
           weights.edge * load<Floats>(v);
  };
  return column(values - 1) + column(values + 1) + weights.edge * column(values) +
         weights.more * load<Floats>(values);
}

/** 0 below the edge, 1 above twice of it, smooth between. */
Floats
smoothStep(const Floats& value, float edge)
{
  const Floats t = clamp01((value - edge) / edge);
  return t * t * (3.0f - 2.0f * t);
}

void
smooth(const ShadedRow& source,
       std::ptrdiff_t stride,
       int count,
       const FilterWeights& weights,
       const ShadedRow& target)
{
  for (int i = 0; i < count; i += lanes) {
    const Floats opacity = load<Floats>(source.opacity + i);
    const Ints is_surface = opacity > 0.0f;
    store(target.opacity + i, opacity);
    // Background is zero in all planes and has no weight.
    const Floats weight = filtered(source.opacity + i, stride, weights);
    const Floats scale = is_surface ? 1.0f / weight : Floats{};
    for (int k = 0; k < 3; ++k)
      store(target.color[k] + i,
            filtered(source.color[k] + i, stride, weights) * scale);
    if (source.normal[0] == nullptr)
      continue;
    Floats normal[3], sq_length{};
    for (int k = 0; k < 3; ++k) {
      normal[k] = filtered(source.normal[k] + i, stride, weights);
      sq_length += normal[k] * normal[k];
    }
    const Floats shrink =
        (is_surface & (sq_length > 0.0f)) ? 1.0f / squareRoot(sq_length) : Floats{};
    for (int k = 0; k < 3; ++k)
      store(target.normal[k] + i, normal[k] * shrink);
  }
}

void
laplaceRow(const float* depth, std::ptrdiff_t stride, int count, float* laplace)
{
  for (int i = 0; i < count; i += lanes) {
    const float* const d = depth + i;
    store(laplace + i,
          4.0f * load<Floats>(d) - load<Floats>(d - 1) - load<Floats>(d + 1) -
              load<Floats>(d - stride) - load<Floats>(d + stride));
  }
}

void
silhouettes(const float* laplace,
            std::ptrdiff_t stride,
            int count,
            float threshold,
            int thickness,
            float* lines)
{
  const int reach = thickness - 1;
  const float sq_radius =
      (static_cast<float>(reach) + 0.5f) * (static_cast<float>(reach) + 0.5f);
  for (int i = 0; i < count; i += lanes) {
    Floats lowest{};
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        if (static_cast<float>(dx * dx + dy * dy) <= sq_radius)
          lowest = minimum(lowest, load<Floats>(laplace + dy * stride + i + dx));
    store(lines + i, smoothStep(-lowest, threshold));
  }
}

void
features(const ShadedRow& row,
         std::ptrdiff_t stride,
         int count,
         float threshold,
         float layer_distance,
         float* lines)
{
  for (int i = 0; i < count; i += lanes) {
    const Ints is_surface = load<Floats>(row.opacity + i) > 0.0f;
    const Floats depth = load<Floats>(row.depth + i);
    // A neighbour that differs alone is an outlier.
    Floats largest{}, curvature{};
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0)
          continue;
        const std::ptrdiff_t there = dy * stride + i + dx;
        Floats cosine{};
        for (int k = 0; k < 3; ++k)
          cosine +=
              load<Floats>(row.normal[k] + i) * load<Floats>(row.normal[k] + there);
        const Ints is_same =
            (load<Floats>(row.opacity + there) > 0.0f) &
            (absolute(load<Floats>(row.depth + there) - depth) <= layer_distance);
        const Floats turn = is_same ? 1.0f - cosine : Floats{};
        curvature = maximum(curvature, minimum(largest, turn));
        largest = maximum(largest, turn);
      }
    const Floats line = is_surface ? smoothStep(curvature, threshold) : Floats{};
    store(lines + i, maximum(load<Floats>(lines + i), line));
  }
}

void
drawLines(const ShadedRow& row, const float* lines, int count, const float* color)
{
  for (int i = 0; i < count; i += lanes) {
    const Floats line = load<Floats>(lines + i);
    for (int k = 0; k < 3; ++k)
      store(row.color[k] + i,
            load<Floats>(row.color[k] + i) * (1.0f - line) + color[k] * line);
    store(row.opacity + i, load<Floats>(row.opacity + i) * (1.0f - line) + line);
  }
}

void
antiAlias(const ShadedRow& source,
          std::ptrdiff_t stride,
          const float* laplace,
          int count,
          float threshold,
          const ShadedRow& target)
{
  constexpr FilterWeights gaussian{2.0f, 0.0f};
  const float* const from[4] = {
      source.color[0], source.color[1], source.color[2], source.opacity};
  float* const to[4] = {
      target.color[0], target.color[1], target.color[2], target.opacity};
  for (int i = 0; i < count; i += lanes) {
    const Ints is_edge = absolute(load<Floats>(laplace + i)) >= threshold;
    const bool any = laneBits(is_edge) != 0;
    for (int k = 0; k < 4; ++k) {
      Floats value = load<Floats>(from[k] + i);
      if (any)
        value =
            is_edge ? filtered(from[k] + i, stride, gaussian) * (1.0f / 16.0f) : value;
      store(to[k] + i, value);
    }
  }
}

Ints
toByte(const Floats& value)
{
  return toInts(clamp01(value) * 255.0f + 0.5f);
}

void
output(const ShadedRow& row,
       int count,
       const RowBackground& background,
       std::uint32_t* image)
{
  for (int i = 0; i < count; i += lanes) {
    const Floats opacity = load<Floats>(row.opacity + i);
    const Floats behind = 1.0f - opacity;
    const Floats scale = opacity > 0.0f ? 1.0f / opacity : Floats{};
    Ints pixels = background.is_transparent ? toByte(opacity) << 24
                                            : fill(std::int32_t(0xff) << 24);
    for (int k = 0; k < 3; ++k) {
      const Floats color = load<Floats>(row.color[k] + i);
      pixels |= toByte(background.is_transparent ? color * scale
                                                 : color + behind * background.color[k])
                << (8 * k);
    }
    store(image + i, pixels);
  }
}

} // namespace

extern const FilterKernels filter_kernels{
    smooth, laplaceRow, silhouettes, features, drawLines, antiAlias, output};

} // namespace pcl_uvol::PCL_UVOL_SIMD
