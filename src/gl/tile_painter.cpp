// SPDX-License-Identifier: BSD-3-Clause
#include "gl/tile_painter.h"

namespace pcl_uvol {

TilePainter::TilePainter(const GlFunctions& gl)
    : gl_(gl)
    , array_(makeVertexArray(gl))
    , boxes_(makeBuffer(gl))
{
  gl.BindVertexArray(array_.get());
  gl.BindBuffer(GL_ARRAY_BUFFER, boxes_.get());
  gl.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.EnableVertexAttribArray(0);
  gl.VertexAttribDivisor(0, 1);
}

void
TilePainter::setTiles(const TileSet& tiles)
{
  std::vector<float> sides;
  for (const PixelBox& box : tiles.boxes())
    for (const int side : {box.left, box.top, box.right, box.bottom})
      sides.push_back(static_cast<float>(side));
  count_ = static_cast<GLsizei>(sides.size() / 4);
  gl_.BindBuffer(GL_ARRAY_BUFFER, boxes_.get());
  gl_.BufferData(GL_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(sides.size() * sizeof(float)),
                 sides.data(),
                 GL_STREAM_DRAW);
}

void
TilePainter::draw(const Program& program, const Canvas& canvas) const
{
  constexpr auto tile = static_cast<float>(TileSet::tile);
  program.set("per_tile",
              tile / static_cast<float>(canvas.getWidth()),
              tile / static_cast<float>(canvas.getHeight()));
  gl_.BindVertexArray(array_.get());
  gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
}

} // namespace pcl_uvol
