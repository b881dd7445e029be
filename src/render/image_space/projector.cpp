// SPDX-License-Identifier: BSD-3-Clause
#include "projector.h"

#include <pcl_uvol/common/dispatch.h>
#include <pcl_uvol/common/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** Rows of a band: its keys fit into the cache of a core. */
constexpr int band_rows = 128;

constexpr std::size_t blocks_per_task = 256;

const KernelTable<ProjectionKernel> projection_table{
    baseline::projectPoints, avx2::projectPoints, avx512::projectPoints};
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
  projection.cull_back_faces =
      frame.settings.cull_back_faces && !frame.cloud.isTwoSided();
  projection.two_sided = frame.cloud.isTwoSided();
  projection.smallest_footprint = smallest_footprint;
  return projection;
}

/** True if no point of the block looks towards the eye: all normals lie in a cone about
 * the axis, all points in a ball. */
bool
looksAway(const SurfaceBlock& block, const Projection& projection)
{
  if (block.spread >= 1.0f)
    return false;
  float sq_dist = 0.0f, along = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float to_eye = projection.eye[axis] - block.center[axis];
    sq_dist += to_eye * to_eye;
    along += to_eye * block.axis[axis];
  }
  const float distance = std::sqrt(sq_dist);
  if (block.radius >= distance)
    return false;
  const float sine_ball = block.radius / distance;
  const float cosine_ball = std::sqrt(1.0f - sine_ball * sine_ball);
  const float cosine_cone = std::sqrt(1.0f - block.spread * block.spread);
  return cosine_cone * cosine_ball > block.spread * sine_ball && // less than 90 degrees
         along < -distance * (block.spread * cosine_ball + cosine_cone * sine_ball);
}

/** A range of pixels around a projected coordinate. */
void
pixelRange(float center, float extent, int size, int& first, int& last)
{
  const auto clamped = [&](float pixel) {
    return static_cast<int>(std::clamp(pixel, 0.0f, static_cast<float>(size)));
  };
  first = clamped(std::floor(center - extent) - 1.0f);
  last = clamped(std::ceil(center + extent) + 1.0f);
}

/** Pixels that the points of a block and their discs can reach; an empty range if there
 * are none. */
PixelBounds
reach(const SurfaceBlock& block,
      const Projection& projection,
      const PixelBuffer& buffer,
      bool has_discs)
{
  constexpr PixelBounds none{0, 0, 0, 0};
  if (projection.cull_back_faces && looksAway(block, projection))
    return none;
  const float* const r = projection.rotation;
  float c[3];
  for (int row = 0; row < 3; ++row)
    c[row] = r[3 * row] * block.center[0] + r[3 * row + 1] * block.center[1] +
             r[3 * row + 2] * block.center[2] + projection.translation[row];
  const float radius = block.radius + (has_discs ? block.largest_footprint : 0.0f);
  if (c[2] + radius < projection.near)
    return none;
  const float nearest = c[2] - radius;
  if (nearest < projection.near)
    return {0, buffer.height, 0, buffer.width};
  PixelBounds bounds;
  const auto range = [&](float x, float center, int size, int& first, int& last) {
    const float slope = x / c[2];
    const float extent =
        projection.focal * radius * std::sqrt(1.0f + slope * slope) / nearest;
    pixelRange(center + projection.focal * slope, extent, size, first, last);
  };
  range(c[1], projection.center_y, buffer.height, bounds.first_row, bounds.last_row);
  range(
      c[0], projection.center_x, buffer.width, bounds.first_column, bounds.last_column);
  if (bounds.first_row >= bounds.last_row || bounds.first_column >= bounds.last_column)
    return none;
  return bounds;
}

PixelBounds
united(const std::vector<PixelBounds>& parts, const PixelBuffer& buffer)
{
  PixelBounds all{buffer.height, 0, buffer.width, 0};
  for (const PixelBounds& part : parts) {
    if (part.first_row >= part.last_row)
      continue;
    all.first_row = std::min(all.first_row, part.first_row);
    all.last_row = std::max(all.last_row, part.last_row);
    all.first_column = std::min(all.first_column, part.first_column);
    all.last_column = std::max(all.last_column, part.last_column);
  }
  return all;
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
  points_ = {{cloud.getCoordinates(0).data(),
              cloud.getCoordinates(1).data(),
              cloud.getCoordinates(2).data()},
             cloud.getNormals().data(),
             frame.hasFootprints() ? cloud.getFootprints().data() : nullptr};
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
Projector::project()
{
  const std::vector<SurfaceBlock>& blocks = frame_.cloud.getBlocks();
  std::vector<PixelBounds> reached(blocks.size());
  parallelBlocks(
      blocks.size(), blocks_per_task, frame_.threads, [&](auto begin, auto end) {
        for (std::size_t i = begin; i < end; ++i)
          reached[i] = reach(blocks[i], projection_, buffer_, points_.radii != nullptr);
      });
  buffer_.bounds = united(reached, buffer_);

  const auto rows = static_cast<std::size_t>(buffer_.height);
  discs_.assign((rows + band_rows - 1) / band_rows, {});
  parallelBlocks(rows, band_rows, frame_.threads, [&](auto begin, auto end) {
    const PixelBand band = bandOf(begin, end);
    std::vector<std::uint32_t>& discs = discs_[begin / band_rows];
    for (int row = band.first_row; row < band.last_row; ++row)
      std::fill_n(
          buffer_.row(row), buffer_.stride - 2 * PixelBuffer::margin, background_key);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (reached[i].first_row >= band.last_row ||
          reached[i].last_row <= band.first_row)
        continue;
      const bool is_blended = isSparse(blocks[i], frame_.view);
      ProjectedPoints points = points_;
      if (points.radii != nullptr && !is_blended)
        points.radii = frame_.cloud.getFillers().data();
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
  });
}

void
Projector::blend()
{
  const bool has_discs = std::any_of(
      discs_.begin(), discs_.end(), [](const auto& discs) { return !discs.empty(); });
  const std::size_t keys = has_discs ? buffer_.keys.size() : 0;
  buffer_.blended.resize(blended_values * keys);
  buffer_.blend_marks.assign(keys / blend_segment, 0);
  if (!has_discs)
    return;
  const auto rows = static_cast<std::size_t>(buffer_.height);
  parallelBlocks(rows, band_rows, frame_.threads, [&](auto begin, auto end) {
    const std::vector<std::uint32_t>& discs = discs_[begin / band_rows];
    disc_kernels_.blend(
        projection_,
        points_,
        reinterpret_cast<const std::uint32_t*>(frame_.cloud.getLooks().data()),
        discs.data(),
        discs.size(),
        bandOf(begin, end),
        buffer_.blendSums());
  });
}

} // namespace pcl_uvol
