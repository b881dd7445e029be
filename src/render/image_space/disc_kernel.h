// SPDX-License-Identifier: BSD-3-Clause
// Oriented discs in the pixels of a band: footprints of points that lie farther apart
// than pixels. Plain arrays, no library headers: the file is compiled once per
// instruction set.
#pragma once

#include "projection_kernel.h"

namespace pcl_uvol {

/** Numbers per pixel that overlapping discs are blended into: weighted sums of normal
 * and colour (0 to 255), the sum of the weights, and one to fill a power of two. */
constexpr int blended_values = 8;

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

  /** \brief Add discs, one after another, to all pixels they cover where they lie in
   * front of, or at most their radius behind, what is seen there.
   * \param looks of all points: packed normal, then colour
   * \param blended of the pixel of the band's first key, in the band's stride */
  void (*blend)(const Projection& projection,
                const ProjectedPoints& points,
                const std::uint32_t* looks,
                const std::uint32_t* discs,
                std::size_t count,
                const PixelBand& band,
                float* blended);
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
