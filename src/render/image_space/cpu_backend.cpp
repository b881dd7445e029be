// SPDX-License-Identifier: BSD-3-Clause
#include "fill_kernel.h"
#include "projector.h"
#include "tile_finisher.h"
#include <pcl_uvol/common/dispatch.h>
#include <pcl_uvol/common/parallel.h>
#include <pcl_uvol/render/image_space/cpu_backend.h>

#include <algorithm>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr std::size_t rows_per_task = 16;
constexpr std::size_t fills_per_task = 1u << 13;

const KernelTable<const FillKernels*> fill_table{
    &baseline::fill_kernels, &avx2::fill_kernels, &avx512::fill_kernels};

/** Finds the fills of a row. */
using FindFills =
    std::function<std::size_t(PixelKey* row, int first, int last, PixelFill* fills)>;

/** Fill until nothing changes, at most so often. Only rows beside a change are looked
 * at again. \return iterations that filled something */
int
fillPixels(PixelBuffer& buffer, int most, unsigned threads, const FindFills& find)
{
  // Around the surface one more pixel could be filled per iteration, but hardly is.
  PixelBounds& bounds = buffer.bounds;
  const int columns = bounds.last_column - bounds.first_column;
  if (columns <= 0)
    return 0;
  std::vector<int> active;
  for (int row = bounds.first_row; row < bounds.last_row; ++row)
    active.push_back(row);
  int iterations = 0;
  for (; iterations < most && !active.empty(); ++iterations) {
    const auto fills = parallelGather<PixelFill>(
        active.size(), rows_per_task, threads, [&](auto begin, auto end, auto& found) {
          for (std::size_t i = begin; i < end; ++i) {
            const std::size_t size = found.size();
            found.resize(size + static_cast<std::size_t>(columns));
            found.resize(size + find(buffer.row(active[i]),
                                     bounds.first_column,
                                     bounds.last_column,
                                     found.data() + size));
          }
        });
    if (fills.empty())
      break;
    parallelBlocks(fills.size(), fills_per_task, threads, [&](auto begin, auto end) {
      for (std::size_t i = begin; i < end; ++i)
        *fills[i].pixel = fills[i].key;
    });
    std::vector<bool> is_active(static_cast<std::size_t>(buffer.height), false);
    for (const PixelFill& fill : fills) {
      const auto row = static_cast<int>((fill.pixel - buffer.row(0)) / buffer.stride);
      for (int near = std::max(row - 1, bounds.first_row);
           near < std::min(row + 2, bounds.last_row);
           ++near)
        is_active[static_cast<std::size_t>(near)] = true;
    }
    active.clear();
    for (int row = bounds.first_row; row < bounds.last_row; ++row)
      if (is_active[static_cast<std::size_t>(row)])
        active.push_back(row);
  }
  return iterations;
}

void
resizePlanes(const Frame& frame, Image& image)
{
  image.width = static_cast<std::uint32_t>(frame.view.width);
  image.height = static_cast<std::uint32_t>(frame.view.height);
  image.color.resize(4 * image.pixels());
  image.depth.resize(frame.planes.depth ? image.pixels() : 0);
  image.normal.resize(frame.planes.normal ? 3 * image.pixels() : 0);
  image.id.resize(frame.planes.id ? image.pixels() : 0);
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
  const ImageSpaceSettings& settings = frame.settings;
  PixelBuffer& pixels = buffers_->pixels;
  pixels.resize(frame.view);
  resizePlanes(frame, image);
  Projector projector(frame, pixels);
  {
    const StepTimer timer(report, "project");
    projector.project();
  }
  const FillKernels& kernels = *fill_table.get();
  const float layer_distance = frame.layerDistance();
  {
    const StepTimer timer(report, "fill_background");
    const int iterations = fillPixels(pixels,
                                      settings.background_fill,
                                      frame.threads,
                                      [&](auto row, auto first, auto last, auto fills) {
                                        return kernels.findBackground(
                                            row, pixels.stride, first, last, fills);
                                      });
    report.count("background_iterations", static_cast<std::uint64_t>(iterations));
  }
  {
    const StepTimer timer(report, "fill_occluded");
    const int iterations =
        fillPixels(pixels,
                   settings.occluded_fill,
                   frame.threads,
                   [&](auto row, auto first, auto last, auto fills) {
                     return kernels.findOccluded(
                         row, pixels.stride, first, last, layer_distance, fills);
                   });
    report.count("occluded_iterations", static_cast<std::uint64_t>(iterations));
  }
  {
    const StepTimer timer(report, "blend");
    projector.blend();
  }
  PassClock clock;
  finishTiles(frame, pixels, buffers_->scratch, image, clock);
  // What the threads spent, shared out: they work side by side.
  constexpr const char* names[PassClock::Passes] = {
      "shade", "smooth", "lines", "anti_alias", "output"};
  const double threads = resolveThreads(frame.threads);
  for (std::size_t i = 0; i < PassClock::Passes; ++i)
    report.time(names[i],
                static_cast<double>(clock.nanoseconds[i].load()) * 1e-6 / threads);
}

} // namespace pcl_uvol
