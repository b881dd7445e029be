// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/cpu_backend.h"

#include "common/dispatch.h"
#include "common/parallel.h"
#include "render/image_space/fill_kernel.h"
#include "render/image_space/projector.h"
#include "render/image_space/tile_shader.h"

#include <algorithm>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr std::size_t rows_per_task = 32;

const KernelTable<const FillKernels*> fill_table{
    &baseline::fill_kernels, &avx2::fill_kernels, &avx512::fill_kernels};

/** Finds the fills of a row. */
using FindFills =
    std::function<std::size_t(PixelKey* row, int first, int last, PixelFill* fills)>;

/** Iterations of one fill. Only pixels beside a change are looked at again: those of a
 * cell, some columns of a row, at once. */
class PixelFiller {
public:
  PixelFiller(PixelBuffer& buffer, unsigned threads, const FindFills& find)
      : buffer_(buffer)
      , threads_(threads)
      , find_(find)
      , rows_(buffer.bounds.height())
      , columns_(buffer.bounds.width())
      , cells_((columns_ + cell_columns - 1) / cell_columns)
  {
  }

  /** Fill until nothing changes, at most so often; returns the iterations that filled
   * something.
   * \param step of the iterations */
  std::uint64_t
  run(int most, StepTimer& step)
  {
    if (rows_ <= 0 || columns_ <= 0)
      return 0;
    changed_.assign(index(rows_, cells_) + 1, 1);
    int iterations = 0;
    for (; iterations < most && iterate(); ++iterations)
      step.advance(1);
    return static_cast<std::uint64_t>(iterations);
  }

private:
  static constexpr int cell_columns = 64;

  bool
  iterate()
  {
    before_ = changed_;
    std::fill(changed_.begin(), changed_.end(), std::uint8_t(0));
    const auto border = parallelGather<PixelFill>(
        static_cast<std::size_t>(rows_),
        rows_per_task,
        threads_,
        [&](auto begin, auto end, auto& found) {
          fillRows(static_cast<int>(begin), static_cast<int>(end), found);
        });
    apply(border.data(), border.size());
    return std::find(changed_.begin(), changed_.end(), 1) != changed_.end();
  }

  /** A row is filled when the next one has been looked at; the first and the last one,
   * which other threads look at, are left to the caller. Rows count from the bounds. */
  void
  fillRows(int first, int last, std::vector<PixelFill>& border)
  {
    const auto columns = static_cast<std::size_t>(columns_);
    std::vector<PixelFill> fills(columns), next(columns);
    std::size_t count = 0;
    for (int row = first; row < last; ++row) {
      const std::size_t found = findRow(row, next.data());
      apply(fills.data(), count);
      count = found;
      fills.swap(next);
      if (row == first || row == last - 1) {
        border.insert(border.end(), fills.data(), fills.data() + found);
        count = 0;
      }
    }
  }

  std::size_t
  findRow(int row, PixelFill* fills)
  {
    const PixelBox& bounds = buffer_.bounds;
    std::size_t count = 0;
    for (int cell = 0; cell < cells_; ++cell) {
      if (!isActive(row, cell))
        continue;
      const int column = bounds.left + cell * cell_columns;
      const std::size_t found = find_(buffer_.row(bounds.top + row),
                                      column,
                                      std::min(column + cell_columns, bounds.right),
                                      fills + count);
      changed_[index(row, cell)] = found > 0;
      count += found;
    }
    return count;
  }

  /** The index of a cell; one more row and column lie all around. */
  std::size_t
  index(int row, int cell) const
  {
    const auto per_row = static_cast<std::ptrdiff_t>(cells_) + 2;
    return static_cast<std::size_t>(per_row * (row + 1) + cell + 1);
  }

  bool
  isActive(int row, int cell) const
  {
    std::uint8_t any = 0;
    for (int r = row - 1; r <= row + 1; ++r) {
      const std::uint8_t* const around = &before_[index(r, cell - 1)];
      any |= around[0] | around[1] | around[2];
    }
    return any != 0;
  }

  static void
  apply(const PixelFill* fills, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
      *fills[i].pixel = fills[i].key;
  }

  PixelBuffer& buffer_;
  unsigned threads_;
  const FindFills& find_;
  int rows_, columns_, cells_;
  std::vector<std::uint8_t> changed_, before_; ///< by cell
};

void
fill(const Frame& frame, PixelBuffer& pixels, Report& report)
{
  const ImageSpaceSettings& settings = frame.settings;
  const FillKernels& kernels = *fill_table.get();
  {
    StepTimer step(report,
                   "fill_background",
                   static_cast<std::uint64_t>(settings.background_fill));
    const FindFills find = [&](auto row, auto first, auto last, auto fills) {
      return kernels.findBackground(row, pixels.stride, first, last, fills);
    };
    report.count(
        "background_iterations",
        PixelFiller(pixels, frame.threads, find).run(settings.background_fill, step));
  }
  StepTimer step(
      report, "fill_occluded", static_cast<std::uint64_t>(settings.occluded_fill));
  const float layer_distance = frame.layerDistance();
  const FindFills find = [&](auto row, auto first, auto last, auto fills) {
    return kernels.findOccluded(row, pixels.stride, first, last, layer_distance, fills);
  };
  report.count(
      "occluded_iterations",
      PixelFiller(pixels, frame.threads, find).run(settings.occluded_fill, step));
}

} // namespace

struct CpuBackend::Buffers {
  PixelBuffer pixels;
  TileScratchPool scratch;
};

CpuBackend::CpuBackend()
    : buffers_(std::make_unique<Buffers>())
{
}

CpuBackend::~CpuBackend() = default;

std::string
CpuBackend::describe() const
{
  constexpr KernelTable<const char*> names{
      "cpu (baseline)", "cpu (avx2)", "cpu (avx512)"};
  return names.get();
}

void
CpuBackend::render(const Frame& frame, Image& image, Report& report)
{
  PixelBuffer& pixels = buffers_->pixels;
  pixels.resize(frame.view);
  resizePlanes(frame, image);
  Projector projector(frame, pixels);
  const auto rows = static_cast<std::uint64_t>(pixels.height);
  {
    StepTimer step(report, "project", rows);
    projector.project(step);
  }
  fill(frame, pixels, report);
  {
    StepTimer step(report, "blend", rows);
    projector.blend(step);
  }
  PassClock clock;
  shadeTiles(frame, pixels, buffers_->scratch, image, clock, report);
  // What the threads spent, shared out: they work side by side.
  constexpr const char* names[PassClock::Passes] = {
      "shade", "smooth", "lines", "anti_alias", "output"};
  const double threads = resolveThreads(frame.threads);
  for (std::size_t i = 0; i < PassClock::Passes; ++i)
    report.time(names[i],
                static_cast<double>(clock.nanoseconds[i].load()) * 1e-6 / threads);
}

} // namespace pcl_uvol
