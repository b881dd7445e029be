// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion of a frame: found for cells after the fills, laid over the pixels
// when they are shaded.
#pragma once

#include "render/image_space/occlusion_grid.h"
#include "render/image_space/occlusion_kernel.h"
#include "render/image_space/pixel_buffer.h"

namespace pcl_uvol {

/** \brief Openness of all cells. Memory: at most 2 bytes per pixel. */
class OcclusionMap {
public:
  /** \brief Find the openness around the filled pixels of a frame, whose settings may
   * want none.
   * \param report gets the time of "occlusion" */
  OcclusionMap(const Frame& frame,
               const PixelBuffer& buffer,
               const Shading& shading,
               Report& report);

  /** \brief Darken pixels of a row.
   * \param column of the buffers, as row
   * \param count a multiple of 16 */
  void
  darken(int column, int row, int count, const ShadedRow& shaded) const;

private:
  /** Cells around those of the grid, in a plane. */
  CellRow
  rowOf(int row);

  std::ptrdiff_t
  place(int row) const
  {
    return (row + border_) * stride_ + border_;
  }

  OcclusionGrid grid_;
  float strength_ = 0.0f;
  int border_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<float> position_[3], normal_[3], depth_, openness_;
};

} // namespace pcl_uvol
