// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/tile_shader.h"

#include "common/dispatch.h"
#include "common/parallel.h"
#include "render/image_space/occlusion_map.h"
#include "render/image_space/shading_setup.h"
#include "render/lighting.h"

#include <algorithm>
#include <chrono>

namespace pcl_uvol {

namespace {

constexpr int tile_columns = 256, tile_rows = 32;

/** Columns on both sides of a tile: a register, and more than filters reach. */
constexpr int side = 16;

/** Pixels from row to row of a tile's planes. */
constexpr std::ptrdiff_t stride = tile_columns + 2 * side;

constexpr std::size_t plane_count = 8; // colour, opacity, depth, normal

const KernelTable<ShadingKernel> shading_table{
    baseline::shadeRow, avx2::shadeRow, avx512::shadeRow};
const KernelTable<const FilterKernels*> filter_table{
    &baseline::filter_kernels, &avx2::filter_kernels, &avx512::filter_kernels};

FilterWeights
computeWeights(SmoothingFilter filter)
{
  switch (filter) {
  case SmoothingFilter::Box:
    return {1.0f, 0.0f};
  case SmoothingFilter::Gaussian:
    return {2.0f, 0.0f};
  default:
    return {2.0f, 12.0f};
  }
}

} // namespace

/** Planes of two stages of a tile's pixels, what a pass reads and what it writes, and
 * what lines need besides. */
struct TileScratch {
  std::array<std::vector<float>, plane_count> planes[2];
  std::vector<float> laplace, lines;
};

namespace {

/** Adds the time of its life to a pass. */
class PassTimer {
public:
  PassTimer(PassClock& clock, PassClock::Pass pass)
      : time_(clock.nanoseconds[pass])
      , start_(std::chrono::steady_clock::now())
  {
  }
  PassTimer(const PassTimer&) = delete;
  PassTimer&
  operator=(const PassTimer&) = delete;
  ~PassTimer()
  {
    time_ += static_cast<std::uint64_t>(
        std::chrono::nanoseconds(std::chrono::steady_clock::now() - start_).count());
  }

private:
  std::atomic<std::uint64_t>& time_;
  std::chrono::steady_clock::time_point start_;
};

/** Shades the pixels of one tile after another, smooths them, draws lines and writes
 * them to the image; one object per thread. Rows and columns are those of the tile,
 * which may be negative around it. */
class TileShader {
public:
  TileShader(const Frame& frame,
             PixelBuffer& buffer,
             const Shading& shading,
             const OcclusionMap& occlusion,
             Image& image,
             PassClock& clock,
             TileScratch& scratch)
      : frame_(frame)
      , buffer_(buffer)
      , shading_(shading)
      , occlusion_(occlusion)
      , image_(image)
      , clock_(clock)
      , planes_(scratch.planes)
      , laplace_(scratch.laplace)
      , lines_(scratch.lines)
      , shade_(shading_table.get())
      , filters_(*filter_table.get())
  {
    const ImageSpaceSettings& s = frame.settings;
    smoothings_ = s.smoothing == SmoothingFilter::None ? 0 : s.smoothing_iterations;
    has_normals_ = s.feature_lines || frame.planes.normal;
    has_lines_ = s.silhouettes || s.feature_lines;
    // Anti-aliasing and feature lines reach one pixel each.
    halo_ = std::max(smoothings_ + 2, s.silhouettes ? s.silhouette_thickness + 1 : 0);
    const auto plane_size =
        static_cast<std::size_t>((tile_rows + 2 * halo_ + 2) * stride + 2 * side);
    for (int stage = 0; stage < 2; ++stage)
      for (auto& plane : planes_[stage])
        plane.resize(plane_size);
    laplace_.resize(plane_size);
    lines_.resize(plane_size);
  }

  /** The tile that begins at a pixel of the image. */
  void
  drawTile(int row, int column)
  {
    first_row_ = row;
    first_column_ = column;
    rows_ = std::min(tile_rows, frame_.view.height - row);
    columns_ = std::min(tile_columns, frame_.view.width - column);
    count_ = (columns_ + side - 1) / side * side + 2 * side;
    if (isEmpty()) {
      clear();
      write();
      return;
    }
    shade();
    for (int i = 1; i <= smoothings_; ++i)
      smooth(i);
    if (has_lines_)
      drawLines();
    if (frame_.settings.anti_aliasing)
      antiAlias();
    write();
  }

private:
  const PixelKey*
  keys(int row) const
  {
    return buffer_.row(first_row_ + row + View::guard) + first_column_ + View::guard;
  }

  bool
  isInBuffer(int row) const
  {
    const int there = first_row_ + row + View::guard;
    return there >= 0 && there < buffer_.height;
  }

  /** Nothing to be seen in the tile and around it. */
  bool
  isEmpty() const
  {
    const int top = first_row_ + View::guard, left = first_column_ + View::guard;
    const PixelBox around{
        left - side, top - halo_, left + columns_ + side, top + rows_ + halo_};
    if (around.clippedTo(buffer_.bounds).isEmpty())
      return true;
    for (int row = -halo_; row < rows_ + halo_; ++row) {
      if (!isInBuffer(row))
        continue;
      const PixelKey* const begin = keys(row) - side;
      PixelKey different = 0;
      for (int i = 0; i < count_; ++i)
        different |= begin[i] ^ background_key;
      if (different != 0)
        return false;
    }
    return true;
  }

  /** A row of a plane, from the first column around the tile on. */
  float*
  at(std::vector<float>& plane, int row)
  {
    return plane.data() + (row + halo_ + 1) * stride + side - 1;
  }

  ShadedRow
  rowOf(int stage, int row)
  {
    auto& planes = planes_[stage];
    // Depth is one for all stages.
    ShadedRow shaded{{at(planes[0], row), at(planes[1], row), at(planes[2], row)},
                     at(planes[3], row),
                     at(planes_[0][4], row),
                     {nullptr, nullptr, nullptr}};
    if (has_normals_)
      for (std::size_t k = 0; k < 3; ++k)
        shaded.normal[k] = at(planes[5 + k], row);
    return shaded;
  }

  void
  clear()
  {
    for (auto& plane : planes_[stage_])
      std::fill(plane.begin(), plane.end(), 0.0f);
    auto& depth = planes_[0][4];
    std::fill(depth.begin(), depth.end(), 1.0f);
  }

  void
  shade()
  {
    const PassTimer timer(clock_, PassClock::Shade);
    static const std::vector<PixelKey> background(stride, background_key);
    stage_ = 0;
    for (int row = -halo_; row < rows_ + halo_; ++row) {
      const PixelKey* const seen =
          isInBuffer(row) ? keys(row) - side : background.data();
      shade_(shading_,
             seen,
             first_column_ + View::guard - side,
             first_row_ + View::guard + row,
             count_,
             isInBuffer(row) ? blendedAt(seen) : BlendSums{},
             rowOf(stage_, row));
      if (isInBuffer(row))
        occlusion_.darken(first_column_ + View::guard - side,
                          first_row_ + View::guard + row,
                          count_,
                          rowOf(stage_, row));
    }
  }

  /** The sums of pixels that begin at a key of the buffers. */
  BlendSums
  blendedAt(const PixelKey* key) const
  {
    static_assert((View::guard - side + blend_segment / 2) % blend_segment == 0 &&
                      tile_columns % blend_segment == 0,
                  "a tile begins with a segment");
    const BlendSums all = buffer_.blendSums();
    if (all.marks == nullptr)
      return all;
    const std::ptrdiff_t place = key - buffer_.row(0);
    return {all.values + blended_values * place,
            all.marks + BlendSums::segmentOf(place),
            nullptr};
  }

  void
  smooth(int iteration)
  {
    const PassTimer timer(clock_, PassClock::Smooth);
    const FilterWeights weights = computeWeights(frame_.settings.smoothing);
    const int around = halo_ - iteration;
    for (int row = -around; row < rows_ + around; ++row)
      filters_.smooth(
          rowOf(stage_, row), stride, count_, weights, rowOf(1 - stage_, row));
    stage_ = 1 - stage_;
  }

  void
  drawLines()
  {
    const PassTimer timer(clock_, PassClock::Lines);
    const ImageSpaceSettings& s = frame_.settings;
    const float line_color[3] = {s.line_color.r, s.line_color.g, s.line_color.b};
    const auto depth_threshold = static_cast<float>(s.silhouette_threshold);
    const auto normal_threshold = static_cast<float>(s.feature_threshold);
    laplaceRows(s.silhouettes ? s.silhouette_thickness : 1);
    for (int row = -1; row < rows_ + 1; ++row) {
      float* const lines = at(lines_, row);
      if (s.silhouettes)
        filters_.silhouettes(at(laplace_, row),
                             stride,
                             count_,
                             depth_threshold,
                             s.silhouette_thickness,
                             lines);
      else
        std::fill_n(lines, count_, 0.0f);
      if (s.feature_lines)
        filters_.features(rowOf(stage_, row),
                          stride,
                          count_,
                          normal_threshold,
                          depth_threshold,
                          lines);
    }
    for (int row = -1; row < rows_ + 1; ++row)
      filters_.drawLines(rowOf(stage_, row), at(lines_, row), count_, line_color);
  }

  void
  laplaceRows(int around)
  {
    for (int row = -around; row < rows_ + around; ++row)
      filters_.laplace(rowOf(0, row).depth, stride, count_, at(laplace_, row));
  }

  void
  antiAlias()
  {
    const PassTimer timer(clock_, PassClock::AntiAlias);
    const auto threshold = static_cast<float>(frame_.settings.anti_aliasing_threshold);
    laplaceRows(0);
    for (int row = 0; row < rows_; ++row)
      filters_.antiAlias(rowOf(stage_, row),
                         stride,
                         at(laplace_, row),
                         count_,
                         threshold,
                         rowOf(1 - stage_, row));
    // Normals are not blended.
    if (has_normals_)
      for (std::size_t k = 5; k < plane_count; ++k)
        planes_[1 - stage_][k].swap(planes_[stage_][k]);
    stage_ = 1 - stage_;
  }

  RowBackground
  backgroundOf(int row) const
  {
    const Background& b = frame_.settings.background;
    const Color color = backgroundAt(b,
                                     (static_cast<float>(first_row_ + row) + 0.5f) /
                                         static_cast<float>(frame_.view.height));
    return {{color.r, color.g, color.b}, b.kind == Background::Kind::Transparent};
  }

  void
  write()
  {
    const PassTimer timer(clock_, PassClock::Output);
    std::uint32_t pixels[stride];
    for (int row = 0; row < rows_; ++row) {
      const ShadedRow shaded = rowOf(stage_, row);
      filters_.output(shaded, count_, backgroundOf(row), pixels);
      const std::size_t place =
          static_cast<std::size_t>(first_row_ + row) * image_.width +
          static_cast<std::size_t>(first_column_);
      std::copy_n(reinterpret_cast<const std::uint8_t*>(pixels + side),
                  4 * columns_,
                  image_.color.data() + 4 * place);
      if (frame_.planes.depth)
        std::copy_n(shaded.depth + side, columns_, image_.depth.data() + place);
      for (int i = 0; frame_.planes.normal && i < columns_; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          image_.normal[3 * (place + static_cast<std::size_t>(i)) + k] =
              shaded.normal[k][side + i];
      for (int i = 0; frame_.planes.id && i < columns_; ++i) {
        const auto id = static_cast<std::uint32_t>(keys(row)[i]);
        image_.id[place + static_cast<std::size_t>(i)] =
            id == Image::background ? id : frame_.cloud.getInputIndices()[id];
      }
    }
  }

  const Frame& frame_;
  PixelBuffer& buffer_;
  const Shading& shading_;
  const OcclusionMap& occlusion_;
  Image& image_;
  PassClock& clock_;
  std::array<std::vector<float>, plane_count>* planes_; // of two stages
  std::vector<float>&laplace_, &lines_;
  ShadingKernel shade_;
  const FilterKernels& filters_;
  int smoothings_ = 0, halo_ = 0;
  bool has_normals_ = false, has_lines_ = false;
  int first_row_ = 0, first_column_ = 0, rows_ = 0, columns_ = 0, count_ = 0;
  int stage_ = 0; // where the newest colours are
};

} // namespace

void
shadeTiles(const Frame& frame,
           PixelBuffer& buffer,
           TileScratchPool& pool,
           Image& image,
           PassClock& clock,
           Report& report)
{
  const ShadingSetup setup(frame);
  const int columns = (frame.view.width + tile_columns - 1) / tile_columns;
  const int rows = (frame.view.height + tile_rows - 1) / tile_rows;
  const OcclusionMap occlusion(frame, buffer, setup.get(), report);
  StepTimer step(report, "finish", static_cast<std::uint64_t>(rows));
  parallelBlocks(
      static_cast<std::size_t>(rows), 1, frame.threads, [&](auto begin, auto) {
        const auto scratch = pool.take();
        TileShader shader(
            frame, buffer, setup.get(), occlusion, image, clock, *scratch);
        for (int column = 0; column < columns; ++column)
          shader.drawTile(static_cast<int>(begin) * tile_rows, column * tile_columns);
        pool.giveBack(scratch);
        step.advance(1);
      });
}

std::shared_ptr<TileScratch>
TileScratchPool::take()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (free_.empty())
    return std::make_shared<TileScratch>();
  auto scratch = free_.back();
  free_.pop_back();
  return scratch;
}

void
TileScratchPool::giveBack(const std::shared_ptr<TileScratch>& scratch)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  free_.push_back(scratch);
}

} // namespace pcl_uvol
