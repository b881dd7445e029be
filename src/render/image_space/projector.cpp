// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/projector.h"

#include "common/dispatch.h"
#include "common/parallel.h"
#include "render/image_space/block_view.h"
#include "render/image_space/side_kernel.h"

#include <algorithm>
#include <limits>
#include <tuple>

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

std::size_t
cellsOf(const PixelBand& band)
{
  const int rows = band.last_row - band.first_row;
  return static_cast<std::size_t>(cellsInRow(band.width)) *
         static_cast<std::size_t>((rows + cell_rows - 1) / cell_rows);
}

/** Discs of one block after another, in the order in which the blocks were drawn. */
class DrawnDiscs {
public:
  /** Call add(discs), which appends those of a block. */
  template <typename Add>
  void
  addBlock(const Add& add)
  {
    const std::size_t begin = discs_.size();
    add(discs_);
    if (discs_.size() > begin)
      runs_.push_back({begin, discs_.size()});
  }

  /** In the order of the points: blocks are consecutive ones. */
  std::vector<std::uint32_t>
  sort()
  {
    std::sort(runs_.begin(), runs_.end(), [this](const Run& a, const Run& b) {
      return discs_[a.begin] < discs_[b.begin];
    });
    std::vector<std::uint32_t> sorted;
    sorted.reserve(discs_.size());
    for (const Run& run : runs_)
      sorted.insert(sorted.end(), &discs_[run.begin], discs_.data() + run.end);
    return sorted;
  }

private:
  struct Run {
    std::size_t begin, end;
  };

  std::vector<std::uint32_t> discs_;
  std::vector<Run> runs_;
};

/** Tells when to look again at what is seen so far: first after some blocks, then after
 * a part of those that were drawn. */
class LookSchedule {
public:
  bool
  isDue()
  {
    if (++drawn_ < next_)
      return false;
    next_ = drawn_ + std::max(drawn_ / 4, least);
    return true;
  }

private:
  static constexpr std::size_t least = 32;

  std::size_t drawn_ = 0, next_ = least;
};

} // namespace

struct Projector::BlockPlan {
  const SurfaceBlock* block;
  PixelBox box;  ///< that its points and discs can reach
  float nearest; ///< along the line of sight
  bool has_discs, is_blended;
};

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

std::vector<Projector::BlockPlan>
Projector::planBlocks() const
{
  const std::vector<SurfaceBlock>& blocks = frame_.cloud.getBlocks();
  std::vector<BlockPlan> plans(blocks.size());
  parallelBlocks(
      blocks.size(), blocks_per_task, frame_.threads, [&](auto begin, auto end) {
        for (std::size_t i = begin; i < end; ++i) {
          const BlockView seen(frame_, blocks[i]);
          plans[i] = {&blocks[i],
                      seen.box(),
                      seen.nearest(),
                      seen.mayHoldDiscs(frame_.smallestDisc()),
                      seen.isSparse()};
          if (seen.isBehindEye() || (frame_.culls() && seen.looksAway()))
            plans[i].box = {0, 0, 0, 0};
        }
      });
  return plans;
}

void
Projector::project(StepTimer& step)
{
  std::vector<BlockPlan> plans = planBlocks();
  buffer_.bounds = {0, 0, 0, 0};
  for (const BlockPlan& plan : plans)
    buffer_.bounds = plan.box.unitedWith(buffer_.bounds);
  std::sort(plans.begin(), plans.end(), [](const BlockPlan& a, const BlockPlan& b) {
    return std::tie(a.nearest, a.block) < std::tie(b.nearest, b.block);
  });
  const auto rows = static_cast<std::size_t>(buffer_.height);
  discs_.assign((rows + band_rows - 1) / band_rows, {});
  parallelBlocks(rows, band_rows, frame_.threads, [&](auto begin, auto end) {
    discs_[begin / band_rows] = projectBand(plans, bandOf(begin, end));
    step.advance(end - begin);
  });
}

std::vector<std::uint32_t>
Projector::projectBand(const std::vector<BlockPlan>& plans, const PixelBand& band) const
{
  for (int row = band.first_row; row < band.last_row; ++row)
    std::fill_n(
        buffer_.row(row), buffer_.stride - 2 * PixelBuffer::margin, background_key);
  std::vector<float> deepest(cellsOf(band));
  const float* known_deepest = nullptr;
  LookSchedule looks;
  DrawnDiscs drawn;
  for (const BlockPlan& plan : plans) {
    const PixelBox& box = plan.box;
    if (box.isEmpty() || box.top >= band.last_row || box.bottom <= band.first_row)
      continue;
    drawn.addBlock(
        [&](auto& discs) { projectBlock(plan, band, known_deepest, discs); });
    if (looks.isDue()) {
      disc_kernels_.findDeepest(band, all_keys, deepest.data());
      known_deepest = deepest.data();
    }
  }
  return drawn.sort();
}

void
Projector::projectBlock(const BlockPlan& plan,
                        const PixelBand& band,
                        const float* deepest,
                        std::vector<std::uint32_t>& discs) const
{
  ProjectedPoints points = points_;
  if (!plan.has_discs)
    points.radii = nullptr;
  else if (!plan.is_blended) {
    points.radii = frame_.cloud.getFillers().data();
    points.stretch = 1.0f;
    points.smallest_cover = std::numeric_limits<float>::max();
  }
  const std::size_t known = discs.size();
  discs.resize(known + projected_points);
  const std::size_t added = project_(projection_,
                                     points,
                                     plan.block->begin,
                                     plan.block->end,
                                     band,
                                     deepest,
                                     discs.data() + known);
  disc_kernels_.draw(projection_,
                     points,
                     discs.data() + known,
                     added,
                     plan.is_blended ? 0.0f : filler_depth,
                     band);
  discs.resize(plan.is_blended ? known + added : known);
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
    std::vector<float> deepest(cellsOf(band));
    disc_kernels_.findDeepest(band, background_key, deepest.data());
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
