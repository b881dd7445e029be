// SPDX-License-Identifier: BSD-3-Clause
// Pixels to be filled (thesis 4.3.2). Plain arrays, no library headers: the file is
// compiled once per instruction set.
#pragma once

#include "render/image_space/projection_kernel.h"

namespace pcl_uvol {

/** A pixel and what it is filled with. */
struct PixelFill {
  PixelKey* pixel;
  PixelKey key;
};

/** \brief One instruction set's versions. Each looks at the pixels first to last of a
 * row, whose neighbours all exist, and writes down which are to be filled, with the
 * smallest key around them; returns their number. Nothing is filled yet, so that every
 * pixel sees its neighbours as they were. */
struct FillKernels {
  /** \brief Background pixels, unless a mask of Figure 4.8 says that they lie beyond
   * the silhouette.
   * \param fills room for last - first */
  std::size_t (*findBackground)(
      PixelKey* row, std::ptrdiff_t stride, int first, int last, PixelFill* fills);

  /** \brief Pixels of a surface behind another one, found by the same masks; white
   * cells are those not in front of the pixel by the distance of two layers. (The text
   * has depths greater than d + d~ there, which would fill every pixel that has no
   * deeper layer beside it.) */
  std::size_t (*findOccluded)(PixelKey* row,
                              std::ptrdiff_t stride,
                              int first,
                              int last,
                              float layer_distance,
                              PixelFill* fills);
};

namespace baseline {
extern const FillKernels fill_kernels;
}
namespace avx2 {
extern const FillKernels fill_kernels;
}
namespace avx512 {
extern const FillKernels fill_kernels;
}

} // namespace pcl_uvol
