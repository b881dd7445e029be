// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion by rows of cells (occlusion_grid.h). Plain arrays, no library
// headers: the file is compiled once per instruction set.
#pragma once

#include "render/image_space/shading_kernel.h"

namespace pcl_uvol {

/** Where the surface of a row of cells is. */
struct CellRow {
  float* position[3]; ///< in camera space; far beyond everything without a surface
  float* normal[3];   ///< towards the eye, in camera space
  float* depth;       ///< no_depth without a surface
};

/** What occludes the cells of a row. */
struct OcclusionSearch {
  const std::ptrdiff_t* offsets; ///< from cell to cell, in planes
  int directions, steps;
  float radius; ///< in parts of the distance along the line of sight
  float least_sine;
  float roughness; ///< heights up to this one are none
};

/** Openness and depths of cells, as the pixels of a row of the buffers see them. */
struct CellsOfPixels {
  const float *openness, *depth; ///< of the row of cells before the pixels
  std::ptrdiff_t stride;         ///< to the next row
  float part;                    ///< how far the pixels lie towards that
  int half;                      ///< pixels before the middle of the first cell
  float per_cell;
  float tolerance; ///< in parts of a depth: surfaces farther apart do not mix
  float strength;
};

/** \brief One instruction set's versions. Counts are multiples of 16. */
struct OcclusionKernels {
  /** \brief Find the surface in the middle of cells.
   * \param keys of the pixels in the middle
   * \param cell pixels from cell to cell
   * \param column of the first cell's middle in the buffers, as row */
  void (*place)(const Shading& shading,
                const PixelKey* keys,
                int cell,
                int column,
                int row,
                int count,
                const CellRow& cells);

  /** \brief Part of the light that arrives at each cell of a row, in [0, 1]. */
  void (*open)(const CellRow& cells,
               const OcclusionSearch& search,
               int count,
               float* openness);

  /** \brief Darken pixels from a column of the buffers on. */
  void (*darken)(const CellsOfPixels& cells,
                 int column,
                 int count,
                 const ShadedRow& shaded);
};

/** Depth and coordinates of cells without a surface; squares are still numbers. @{ */
constexpr float no_depth = 16.0f;
constexpr float beyond_all = 1e18f;
/** @} */

/** The inverse of the outer part of a squared radius in which walls count less. */
constexpr float falloff = 3.0f;

/** Weight of full light where no cell around a pixel shows its surface. */
constexpr float open_weight = 1e-3f;

namespace baseline {
extern const OcclusionKernels occlusion_kernels;
}
namespace avx2 {
extern const OcclusionKernels occlusion_kernels;
}
namespace avx512 {
extern const OcclusionKernels occlusion_kernels;
}

} // namespace pcl_uvol
