// SPDX-License-Identifier: BSD-3-Clause
// Filters on the rows of a tile: smoothing, lines, anti-aliasing (thesis 4.3.3 to
// 4.3.5), and the pixels of the image. Plain arrays, no library headers: the file is
// compiled once per instruction set.
#pragma once

#include "render/image_space/shading_kernel.h"

namespace pcl_uvol {

/** A 3 x 3 filter (1, edge, 1; edge, edge^2 + more, edge; 1, edge, 1). */
struct FilterWeights {
  float edge, more;
};

/** What an image's row is laid over. */
struct RowBackground {
  float color[3];
  bool is_transparent;
};

/** \brief One instruction set's versions. Rows of count pixels, a multiple of 16; the
 * row before and after lies a stride away, the pixels left and right of the row exist.
 */
struct FilterKernels {
  /** \brief Weighted mean of the pixels of the surface; normals are normalised. Depth
   * stays. */
  void (*smooth)(const ShadedRow& source,
                 std::ptrdiff_t stride,
                 int count,
                 const FilterWeights& weights,
                 const ShadedRow& target);

  /** \brief Table 4.2. */
  void (*laplace)(const float* depth, std::ptrdiff_t stride, int count, float* laplace);

  /** \brief Opacity of silhouettes, on their near side: a smooth step from the
   * threshold to twice of it, widened to a thickness in pixels. */
  void (*silhouettes)(const float* laplace,
                      std::ptrdiff_t stride,
                      int count,
                      float threshold,
                      int thickness,
                      float* lines);

  /** \brief Opacity of feature lines, where it is larger than that of lines there.
   * Neighbours of another layer do not count. */
  void (*features)(const ShadedRow& row,
                   std::ptrdiff_t stride,
                   int count,
                   float threshold,
                   float layer_distance,
                   float* lines);

  /** \brief Lay lines over colour and opacity, in place. */
  void (*drawLines)(const ShadedRow& row,
                    const float* lines,
                    int count,
                    const float* color);

  /** \brief Gaussian mean with the background where the absolute Laplace filter reaches
   * the threshold, the pixel itself elsewhere. */
  void (*antiAlias)(const ShadedRow& source,
                    std::ptrdiff_t stride,
                    const float* laplace,
                    int count,
                    float threshold,
                    const ShadedRow& target);

  /** \brief Red, green, blue, opacity in 8 bits.
   * \param image room for count pixels */
  void (*output)(const ShadedRow& row,
                 int count,
                 const RowBackground& background,
                 std::uint32_t* image);
};

namespace baseline {
extern const FilterKernels filter_kernels;
}
namespace avx2 {
extern const FilterKernels filter_kernels;
}
namespace avx512 {
extern const FilterKernels filter_kernels;
}

} // namespace pcl_uvol
