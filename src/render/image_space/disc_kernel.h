// SPDX-License-Identifier: BSD-3-Clause
// Oriented discs in the pixels of a band: footprints of points that lie farther apart
// than pixels. Plain arrays, no library headers: the file is compiled once per
// instruction set.
#pragma once

#include "render/image_space/projection_kernel.h"

namespace pcl_uvol {

/** Numbers per pixel that overlapping discs are blended into: weighted sums of normal
 * and colour (0 to 255), the sum of the weights, and one to fill a power of two. */
constexpr int blended_values = 8;

/** Pixels of a row whose sums are cleared together, when the first disc reaches them.
 */
constexpr int blend_segment = 16;

/** What discs are blended into, from the first key of the buffers on, in their stride.
 */
struct BlendSums {
  float* values = nullptr;       ///< blended_values per pixel; of marked segments only
  std::uint8_t* marks = nullptr; ///< per segment: not 0 if a disc reached it
  /** Per pixel: discs of other sides are not added; null: there are none. */
  const std::uint8_t* sides = nullptr;

  /** \brief Segment of the pixel of a key. Half a segment off the first column, as the
   * tiles of an image are. */
  static std::ptrdiff_t
  segmentOf(std::ptrdiff_t key)
  {
    return (key + blend_segment / 2) / blend_segment;
  }
};

/** Pixels of a band are told about by cells of so many of them. @{ */
constexpr int cell_rows = 8, cell_columns = 16;
/** @} */

/** Larger than all keys. */
constexpr PixelKey all_keys = background_key + 1;

/** \brief Cells side by side in so many columns. */
constexpr int
cellsInRow(int width)
{
  return (width + cell_columns - 1) / cell_columns;
}

/** \brief One instruction set's versions. */
struct DiscKernels {
  /** \brief Put discs into all pixels whose centre they cover.
   * \param back how much deeper than they are, in radii */
  void (*draw)(const Projection& projection,
               const ProjectedPoints& points,
               const std::uint32_t* discs,
               std::size_t count,
               float back,
               const PixelBand& band);

  /** \brief Find the largest depth of a point that is seen in each cell of a band; 0
   * where there is none.
   * \param beyond keys that are not smaller do not count: background_key, or with
   * all_keys the depth of a cell that shows some background is infinite
   * \param deepest of the cells, row by row */
  void (*findDeepest)(const PixelBand& band, PixelKey beyond, float* deepest);

  /** \brief Add discs, stretched, one after another, to all pixels of their side that
   * they cover where they lie at most their radius in front of or behind what is seen
   * there. Discs that look to the eye are added to pixels of the other side as well if
   * their centres are nearer: the pixels would be lit from behind at outlines.
   * \param looks of all points: packed normal, then colour
   * \param deepest as findDeepest() gives: hidden discs are passed over */
  void (*blend)(const Projection& projection,
                const ProjectedPoints& points,
                const std::uint32_t* looks,
                const std::uint32_t* discs,
                std::size_t count,
                const PixelBand& band,
                const float* deepest,
                const BlendSums& blended);
};

namespace baseline {
extern const DiscKernels disc_kernels;
}
namespace avx2 {
extern const DiscKernels disc_kernels;
}
namespace avx512 {
extern const DiscKernels disc_kernels;
}

} // namespace pcl_uvol
