// SPDX-License-Identifier: BSD-3-Clause
// Draws tiles of a canvas with whatever shader is in use.
#pragma once

#include "gl/canvas.h"
#include "gl/tile_set.h"

namespace pcl_uvol {

class TilePainter {
public:
  explicit TilePainter(const GlFunctions& gl);

  /** \brief The tiles that are drawn from now on. */
  void
  setTiles(const TileSet& tiles);

  /** \brief Draw them into a target of any size that stands for the whole canvas.
   * \param program in use, with one of the passes that begin with shaders::tiles */
  void
  draw(const Program& program, const Canvas& canvas) const;

private:
  const GlFunctions& gl_;
  GlName array_, boxes_;
  GLsizei count_ = 0;
};

} // namespace pcl_uvol
