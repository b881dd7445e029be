// SPDX-License-Identifier: BSD-3-Clause
#include "gl/fill_pass.h"

#include <string>
#include <utility>

namespace pcl_uvol {

FillPass::FillPass(const GlFunctions& gl, Programs& programs)
    : gl_(gl)
    , programs_(programs)
    , painter_(gl)
{
}

TileSet
FillPass::findChanges(const Canvas& canvas, TileSet tiles)
{
  constexpr int tile = TileSet::tile;
  static const std::string define = "#define TILE " + std::to_string(tile) + "\n";
  const PixelBox& bounds = tiles.getBounds();
  const int columns = canvas.getWidth() / tile, rows = canvas.getHeight() / tile;

  canvas.bind(canvas.compared);
  gl_.Viewport(0, 0, columns, canvas.getHeight());
  gl_.Scissor(0, 0, columns, canvas.getHeight());
  const Program& by_row = programs_.use(shaders::row_changes, define);
  by_row.setTexture("before", 0, canvas.states[0]);
  by_row.setTexture("after", 1, canvas.states[1]);
  painter_.draw(by_row, canvas);

  constexpr GLuint unchanged[4] = {0, 0, 0, 0};
  canvas.bind(canvas.collected);
  gl_.Viewport(0, 0, columns, rows);
  gl_.Scissor(0, 0, columns, rows);
  gl_.ClearBufferuiv(GL_COLOR, 0, unchanged);
  const Program& by_tile = programs_.use(shaders::tile_changes, define);
  by_tile.setTexture("rows", 0, canvas.row_changes);
  painter_.draw(by_tile, canvas);

  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(bounds.left,
                 bounds.top,
                 bounds.width(),
                 bounds.height(),
                 GL_RED_INTEGER,
                 GL_UNSIGNED_BYTE,
                 tiles.flags().data());
  return tiles;
}

TileSet
FillPass::findSurface(const Canvas& canvas, const PixelBox& box)
{
  // One state has the points, the other one is empty.
  TileSet tiles(box);
  painter_.setTiles(tiles);
  return findChanges(canvas, std::move(tiles)).grown();
}

unsigned
FillPass::run(Kind kind,
              const Canvas& canvas,
              float layer_distance,
              int most,
              TileSet& surface,
              int& current)
{
  TileSet active = surface;
  for (int iteration = 0; iteration < most; ++iteration) {
    painter_.setTiles(active);
    canvas.bind(canvas.filled[1 - current]);
    const Program& program =
        programs_.use(shaders::fill, defineIf(kind == Kind::Occluded, "OCCLUDED"));
    program.setTexture("state", 0, canvas.states[current]);
    program.set("layer_distance", layer_distance);
    painter_.draw(program, canvas);
    active = findChanges(canvas, std::move(active));
    current = 1 - current;
    if (active.isEmpty())
      return static_cast<unsigned>(iteration);
    active = active.grown();
    surface.add(active);
  }
  return static_cast<unsigned>(std::max(most, 0));
}

} // namespace pcl_uvol
