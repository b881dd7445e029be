// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/occlusion_map.h"

#include "common/dispatch.h"
#include "common/parallel.h"

#include <algorithm>

namespace pcl_uvol {

namespace {

/** Cells around the grid that pixels around a tile may ask for, and a register. */
constexpr int least_border = 16;

constexpr std::size_t occlusion_rows = 8;

const KernelTable<const OcclusionKernels*> kernel_table{
    &baseline::occlusion_kernels, &avx2::occlusion_kernels, &avx512::occlusion_kernels};

/** Cells in whole registers of any instruction set. */
int
roundUp(int count)
{
  constexpr int most_lanes = 16;
  return (count + most_lanes - 1) / most_lanes * most_lanes;
}

template <typename Visit>
void
forRows(int count, unsigned threads, const Visit& visit)
{
  parallelBlocks(static_cast<std::size_t>(count),
                 occlusion_rows,
                 threads,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t row = begin; row < end; ++row)
                     visit(static_cast<int>(row));
                 });
}

} // namespace

OcclusionMap::OcclusionMap(const Frame& frame,
                           const PixelBuffer& buffer,
                           const Shading& shading,
                           Report& report)
    : grid_(frame)
    , strength_(static_cast<float>(frame.settings.ambient_occlusion))
{
  if (grid_.isEmpty())
    return;
  const StepTimer timer(report, "occlusion");
  border_ = std::max(grid_.reach(), least_border);
  const int count = roundUp(grid_.columns);
  stride_ = count + 2 * border_;
  const auto size = static_cast<std::size_t>((grid_.rows + 2 * border_) * stride_);
  for (int k = 0; k < 3; ++k) {
    position_[k].assign(size, beyond_all);
    normal_[k].assign(size, 0.0f);
  }
  depth_.assign(size, no_depth);
  openness_.assign(size, 1.0f);
  const OcclusionKernels& kernels = *kernel_table.get();
  forRows(grid_.rows, frame.threads, [&](int row) {
    std::vector<PixelKey> keys(static_cast<std::size_t>(count), background_key);
    const int there = grid_.middle(row);
    if (there >= buffer.height)
      return;
    for (int column = 0; column < grid_.columns; ++column)
      if (grid_.middle(column) < buffer.width)
        keys[static_cast<std::size_t>(column)] =
            buffer.row(there)[grid_.middle(column)];
    kernels.place(
        shading, keys.data(), grid_.cell, grid_.middle(0), there, count, rowOf(row));
  });
  std::vector<std::ptrdiff_t> offsets;
  for (const auto& offset : grid_.offsets)
    offsets.push_back(offset.row * stride_ + offset.column);
  const OcclusionSearch search{offsets.data(),
                               OcclusionGrid::directions,
                               OcclusionGrid::steps,
                               grid_.radius,
                               OcclusionGrid::least_sine,
                               grid_.roughness};
  forRows(grid_.rows, frame.threads, [&](int row) {
    kernels.open(rowOf(row), search, count, openness_.data() + place(row));
  });
}

CellRow
OcclusionMap::rowOf(int row)
{
  const std::ptrdiff_t first = place(row);
  CellRow cells{};
  for (int k = 0; k < 3; ++k) {
    cells.position[k] = position_[k].data() + first;
    cells.normal[k] = normal_[k].data() + first;
  }
  cells.depth = depth_.data() + first;
  return cells;
}

void
OcclusionMap::darken(int column, int row, int count, const ShadedRow& shaded) const
{
  if (grid_.isEmpty())
    return;
  const float place_of_row = static_cast<float>(row - grid_.cell / 2) * grid_.per_cell;
  const int before = static_cast<int>(place_of_row + 1.0f) - 1;
  const std::ptrdiff_t first = place(before);
  kernel_table.get()->darken({openness_.data() + first,
                              depth_.data() + first,
                              stride_,
                              place_of_row - static_cast<float>(before),
                              grid_.cell / 2,
                              grid_.per_cell,
                              grid_.tolerance,
                              strength_},
                             column,
                             count,
                             shaded);
}

} // namespace pcl_uvol
