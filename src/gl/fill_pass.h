// SPDX-License-Identifier: BSD-3-Clause
// Filling of pixels (thesis 4.3.2).
#pragma once

#include "gl/programs.h"
#include "gl/tile_painter.h"

namespace pcl_uvol {

/** \brief Iterates over the states of a canvas until nothing changes. */
class FillPass {
public:
  FillPass(const GlFunctions& gl, Programs& programs);

  /** Which pixels are filled. */
  enum class Kind { Background, Occluded };

  /** \brief The tiles of a cleared canvas that points have been projected into, and
   * those beside them. */
  TileSet
  findSurface(const Canvas& canvas, const PixelBox& box);

  /** \brief Fill the pixels of a surface.
   * \param surface tiles with a surface and those beside them, before and after
   * \param current index in canvas.states of what is to be filled, then of the result
   * \param most iterations at most
   * \return iterations that changed something */
  unsigned
  run(Kind kind,
      const Canvas& canvas,
      float layer_distance,
      int most,
      TileSet& surface,
      int& current);

private:
  /** Those tiles in which the two states differ.
   * \param tiles of the painter */
  TileSet
  findChanges(const Canvas& canvas, TileSet tiles);

  const GlFunctions& gl_;
  Programs& programs_;
  TilePainter painter_;
};

} // namespace pcl_uvol
