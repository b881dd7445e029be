// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/projector.h"

#include "common/dispatch.h"
#include "common/parallel.h"
#include "render/image_space/block_view.h"
#include "render/image_space/side_kernel.h"

#include <algorithm>
#include <limits>

namespace pcl_uvol {

namespace {

/** Rows of a band: its keys fit into the cache of a core. */
constexpr int band_rows = 128;

constexpr std::size_t blocks_per_task = 256;

const KernelTable<ProjectionKernel> projection_table{
    baseline::projectPoints, avx2::projectPoints, avx512::projectPoints};
const KernelTable<SideKernel> side_table{
    baseline::findSides, avx2::findSides, avx512::findSides};
const KernelTable<const DiscKernels*> disc_table{
    &baseline::disc_kernels, &avx2::disc_kernels, &avx512::disc_kernels};

Projection
projectionOf(const Frame& frame)
{
  const View& view = frame.view;
  Projection projection;
  std::copy(view.rotation, view.rotation + 9, projection.rotation);
  std::copy(view.translation, view.translation + 3, projection.translation);
  for (int axis = 0; axis < 3; ++axis)
    projection.eye[axis] = -(view.rotation[axis] * view.translation[0] +
                             view.rotation[3 + axis] * view.translation[1] +
                             view.rotation[6 + axis] * view.translation[2]);
  projection.focal = view.focal;
  projection.center_x = view.center_x;
  projection.center_y = view.center_y;
  projection.near = view.near;
  projection.per_far = 1.0f / view.far;
  projection.cull_back_faces = frame.culls();
  projection.two_sided = !frame.culls();
  projection.outward = frame.outward();
  projection.has_sides = frame.hasSides();
  projection.away_depth = frame.hasSides() ? away_depth : 0.0f;
  projection.edge_on_cosine = edge_on_cosine;
  projection.facing_weight = facing_weight;
  projection.facing_reach = facing_reach;
  projection.smallest_footprint = frame.smallestDisc();
  projection.largest_filler = largest_filler;
  projection.smallest_bend = smallest_bend;
  projection.smallest_turn = smallest_turn;
  return projection;
}

/** How a block is drawn. */
struct BlockPlan {
  PixelBox box; ///< that its points and discs can reach
  bool has_discs, is_blended;
};

BlockPlan
planBlock(const SurfaceBlock& block, const Frame& frame)
{
  const BlockView seen(frame, block);
  if (seen.isBehindEye() || (frame.culls() && seen.looksAway()))
    return {{0, 0, 0, 0}, false, false};
  return {seen.box(), seen.mayHoldDiscs(frame.smallestDisc()), seen.isSparse()};
}

} // namespace

void
PixelBuffer::resize(const View& view)
{
  constexpr int lanes = 16; // of the widest register
  static_assert(margin % blend_segment == 0 && lanes % blend_segment == 0);
  width = view.bufferWidth();
  height = view.bufferHeight();
  const std::ptrdiff_t columns = (width + lanes - 1) / lanes * lanes + 2 * margin;
  const std::size_t size =
      static_cast<std::size_t>(columns) * static_cast<std::size_t>(height + 2);
  if (columns == stride && size == keys.size())
    return;
  stride = columns;
  keys.assign(size, background_key);
}

Projector::Projector(const Frame& frame, PixelBuffer& buffer)
    : frame_(frame)
    , buffer_(buffer)
    , projection_(projectionOf(frame))
    , project_(projection_table.get())
    , disc_kernels_(*disc_table.get())
{
  const SurfaceCloud& cloud = frame.cloud;
  const float* const footprints =
      frame.hasFootprints() ? cloud.getFootprints().data() : nullptr;
  points_ = {{cloud.getCoordinates(0).data(),
              cloud.getCoordinates(1).data(),
              cloud.getCoordinates(2).data()},
             cloud.getNormals().data(),
             footprints,
             footprints,
             cloud.getBends().data(),
             cloud.getRims().data(),
             blend_reach,
             smallest_cover};
}

PixelBand
Projector::bandOf(std::size_t begin, std::size_t end) const
{
  return {buffer_.row(0),
          buffer_.stride,
          buffer_.width,
          static_cast<int>(begin),
          static_cast<int>(end)};
}

void
Projector::project(StepTimer& step)
{
  const std::vector<SurfaceBlock>& blocks = frame_.cloud.getBlocks();
  std::vector<BlockPlan> plans(blocks.size());
  parallelBlocks(
      blocks.size(), blocks_per_task, frame_.threads, [&](auto begin, auto end) {
        for (std::size_t i = begin; i < end; ++i)
          plans[i] = planBlock(blocks[i], frame_);
      });
  buffer_.bounds = {0, 0, 0, 0};
  for (const BlockPlan& plan : plans)
    buffer_.bounds = plan.box.unitedWith(buffer_.bounds);

  const auto rows = static_cast<std::size_t>(buffer_.height);
  discs_.assign((rows + band_rows - 1) / band_rows, {});
  parallelBlocks(rows, band_rows, frame_.threads, [&](auto begin, auto end) {
    const PixelBand band = bandOf(begin, end);
    std::vector<std::uint32_t>& discs = discs_[begin / band_rows];
    for (int row = band.first_row; row < band.last_row; ++row)
      std::fill_n(
          buffer_.row(row), buffer_.stride - 2 * PixelBuffer::margin, background_key);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const auto [box, has_discs, is_blended] = plans[i];
      if (box.isEmpty() || box.top >= band.last_row || box.bottom <= band.first_row)
        continue;
      ProjectedPoints points = points_;
      if (!has_discs)
        points.radii = nullptr;
      else if (!is_blended) {
        points.radii = frame_.cloud.getFillers().data();
        points.stretch = 1.0f;
        points.smallest_cover = std::numeric_limits<float>::max();
      }
      const std::size_t known = discs.size();
      discs.resize(known + projected_points);
      const std::size_t added = project_(projection_,
                                         points,
                                         blocks[i].begin,
                                         blocks[i].end,
                                         band,
                                         discs.data() + known);
      disc_kernels_.draw(projection_,
                         points,
                         discs.data() + known,
                         added,
                         is_blended ? 0.0f : filler_depth,
                         band);
      discs.resize(is_blended ? known + added : known);
    }
    step.advance(end - begin);
  });
}

void
Projector::blend(StepTimer& step)
{
  const bool has_discs = std::any_of(
      discs_.begin(), discs_.end(), [](const auto& discs) { return !discs.empty(); });
  const std::size_t keys = has_discs ? buffer_.keys.size() : 0;
  if (keys != buffer_.blended_keys) {
    buffer_.blended.reset(keys > 0 ? new float[blended_values * keys] : nullptr);
    buffer_.blended_keys = keys;
  }
  buffer_.blend_marks.assign(keys / blend_segment, 0);
  const bool has_sides = frame_.hasSides() || frame_.cloud.hasSurfaces();
  buffer_.sides.resize(has_sides ? keys : 0);
  if (!has_discs)
    return;
  const auto rows = static_cast<std::size_t>(buffer_.height);
  parallelBlocks(rows, band_rows, frame_.threads, [&](auto begin, auto end) {
    const std::vector<std::uint32_t>& discs = discs_[begin / band_rows];
    const auto* const looks =
        reinterpret_cast<const std::uint32_t*>(frame_.cloud.getLooks().data());
    const PixelBand band = bandOf(begin, end);
    if (has_sides && !discs.empty())
      side_table.get()(projection_, looks, band, buffer_.firstSide());
    if (discs.empty())
      return;
    std::vector<float> deepest(static_cast<std::size_t>(
        cellsInRow(band.width) * ((band_rows + cell_rows - 1) / cell_rows)));
    disc_kernels_.findDeepest(band, deepest.data());
    disc_kernels_.blend(projection_,
                        points_,
                        looks,
                        discs.data(),
                        discs.size(),
                        band,
                        deepest.data(),
                        buffer_.blendSums());
    step.advance(end - begin);
  });
}

} // namespace pcl_uvol
