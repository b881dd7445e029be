// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion of cells, before pixels are shaded
// (render/image_space/occlusion_grid.h).
#pragma once

#include "gl/programs.h"
#include "render/image_space/occlusion_grid.h"

namespace pcl_uvol {

class OcclusionPass {
public:
  OcclusionPass(const GlFunctions& gl, Programs& programs);

  /** \brief Find how much light arrives at the cells of a frame.
   * \param grid not empty
   * \param state of the filled pixels
   * \param looks of all points */
  void
  run(const Frame& frame,
      const OcclusionGrid& grid,
      const GlName& state,
      const GlName& looks);

  /** \brief Give the shader of pixels what run() found.
   * \param unit of the texture */
  void
  bindTo(const Program& program, int unit) const;

private:
  void
  drawCells(const GlName& framebuffer, int targets) const;

  const GlFunctions& gl_;
  Programs& programs_;
  GlName full_screen_array_; // without attributes
  int columns_ = 0, rows_ = 0;
  float half_ = 0.0f, per_cell_ = 0.0f, tolerance_ = 0.0f, strength_ = 0.0f;
  GlName positions_; // and depths
  GlName normals_;
  GlName cells_; // openness, depth
  GlName placed_, opened_;
};

} // namespace pcl_uvol
