// SPDX-License-Identifier: BSD-3-Clause
#include "gl/occlusion_pass.h"

#include "gl/point_pass.h"
#include "gl/shaders.h"

#include <utility>
#include <vector>

namespace pcl_uvol {

OcclusionPass::OcclusionPass(const GlFunctions& gl, Programs& programs)
    : gl_(gl)
    , programs_(programs)
    , full_screen_array_(makeVertexArray(gl))
{
}

void
OcclusionPass::drawCells(const GlName& framebuffer, int targets) const
{
  static constexpr GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  gl_.DrawBuffers(targets, attachments);
  gl_.Viewport(0, 0, columns_, rows_);
  gl_.Scissor(0, 0, columns_, rows_);
  gl_.BindVertexArray(full_screen_array_.get());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void
OcclusionPass::run(const Frame& frame,
                   const OcclusionGrid& grid,
                   const GlName& state,
                   const GlName& looks)
{
  if (columns_ != grid.columns || rows_ != grid.rows) {
    columns_ = grid.columns;
    rows_ = grid.rows;
    positions_ = makeTexture(gl_, GL_RGBA32F, columns_, rows_);
    normals_ = makeTexture(gl_, GL_RGBA32F, columns_, rows_);
    cells_ = makeTexture(gl_, GL_RG32F, columns_, rows_);
    placed_ = makeFramebuffer(gl_, {&positions_, &normals_});
    opened_ = makeFramebuffer(gl_, {&cells_});
  }
  half_ = static_cast<float>(grid.cell / 2);
  per_cell_ = grid.per_cell;
  tolerance_ = grid.tolerance;
  strength_ = static_cast<float>(frame.settings.ambient_occlusion);

  const Program& place = programs_.use(shaders::place_cells);
  setView(place, frame.view);
  place.setTexture("state", 0, state);
  place.setTexture("looks", 1, looks, GL_TEXTURE_BUFFER);
  place.set("cell", static_cast<float>(grid.cell));
  place.set("half_cell", half_);
  place.set("is_two_sided", !frame.culls());
  drawCells(placed_, 2);

  std::vector<float> numbers;
  for (const auto& offset : grid.offsets)
    numbers.insert(numbers.end(),
                   {static_cast<float>(offset.column),
                    static_cast<float>(offset.row),
                    0.0f,
                    0.0f});
  const NumberTable offsets(gl_, std::move(numbers));
  const Program& open = programs_.use(shaders::open_cells);
  open.setTexture("positions", 0, positions_);
  open.setTexture("normals", 1, normals_);
  open.setTexture("offsets", 2, offsets.getTexture(), GL_TEXTURE_BUFFER);
  open.set("size", static_cast<float>(columns_), static_cast<float>(rows_));
  open.set("directions", OcclusionGrid::directions);
  open.set("steps", OcclusionGrid::steps);
  open.set("radius", grid.radius);
  open.set("least_sine", OcclusionGrid::least_sine);
  open.set("roughness", grid.roughness);
  drawCells(opened_, 1);
}

void
OcclusionPass::bindTo(const Program& program, int unit) const
{
  program.setTexture("cells", unit, cells_);
  program.set("cell_count", static_cast<float>(columns_), static_cast<float>(rows_));
  program.set("half_cell", half_);
  program.set("per_cell", per_cell_);
  program.set("tolerance", tolerance_);
  program.set("strength", strength_);
}

} // namespace pcl_uvol
