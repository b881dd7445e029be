// SPDX-License-Identifier: BSD-3-Clause
// From filled pixels to the image: shading, smoothing, lines, anti-aliasing and output,
// tile by tile, so that what lies between the passes stays in the cache.
#pragma once

#include "render/image_space/filter_kernel.h"
#include "render/image_space/pixel_buffer.h"

#include <array>
#include <atomic>
#include <memory>
#include <mutex>

namespace pcl_uvol {

/** \brief Time that all threads spent on the passes over tiles. */
struct PassClock {
  enum Pass { Shade, Smooth, Lines, AntiAlias, Output, Passes };
  std::array<std::atomic<std::uint64_t>, Passes> nanoseconds{};
};

struct TileScratch;

/** \brief Keeps what threads work in from frame to frame. */
class TileScratchPool {
public:
  std::shared_ptr<TileScratch>
  take();

  void
  giveBack(const std::shared_ptr<TileScratch>& scratch);

private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<TileScratch>> free_;
};

/** \brief Shade all tiles of an image, whose planes have their sizes.
 * \param report gets the time and progress of "finish" */
void
shadeTiles(const Frame& frame,
           PixelBuffer& buffer,
           TileScratchPool& pool,
           Image& image,
           PassClock& clock,
           Report& report);

} // namespace pcl_uvol
