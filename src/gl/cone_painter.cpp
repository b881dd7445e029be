// SPDX-License-Identifier: BSD-3-Clause
#include "gl/cone_painter.h"

#include "gl/cone_shaders.h"

#include <algorithm>
#include <string>

namespace pcl_uvol {

namespace {

using PlaneCell = std::array<std::uint16_t, 2>;

constexpr GLuint corner_attribute = 0, cell_attribute = 1; // as the shader has them

template <typename T>
void
fillBuffer(const GlFunctions& gl,
           GLenum target,
           const GlName& buffer,
           const std::vector<T>& values)
{
  gl.BindBuffer(target, buffer.get());
  gl.BufferData(target,
                static_cast<GLsizeiptr>(values.size() * sizeof(T)),
                values.data(),
                GL_STATIC_DRAW);
}

void
checkSize(const GlFunctions& gl, const GridShape& shape)
{
  GLint largest[3] = {0, 0, 0};
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, largest);
  gl.GetIntegerv(GL_MAX_RECTANGLE_TEXTURE_SIZE, largest + 2);
  const GLint side = *std::min_element(largest, largest + 3);
  if (std::max(shape.cells[0], shape.cells[1]) > static_cast<std::uint32_t>(side))
    throw GlError(
        "gl_layers_too_large",
        {{"width", shape.cells[0]}, {"height", shape.cells[1]}, {"most", side}});
}

/** Undo what others who use the context may have set. */
void
resetState(const GlFunctions& gl)
{
  for (const GLenum capability : {GL_BLEND,
                                  GL_COLOR_LOGIC_OP,
                                  GL_CULL_FACE,
                                  GL_DEPTH_CLAMP,
                                  GL_POLYGON_OFFSET_FILL,
                                  GL_RASTERIZER_DISCARD,
                                  GL_SCISSOR_TEST,
                                  GL_STENCIL_TEST})
    gl.Disable(capability);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LESS);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.DepthMask(GL_TRUE);
  gl.DepthRange(0.0, 1.0);
  gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  for (const GLenum parameter :
       {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES})
    gl.PixelStorei(parameter, 0);
}

std::vector<std::uint32_t>
findPlanes(const std::vector<GridCell>& sites, std::uint32_t planes)
{
  std::vector<std::uint32_t> begins(planes + 1, 0);
  for (const GridCell& site : sites)
    ++begins[site[2] + 1];
  for (std::uint32_t plane = 0; plane < planes; ++plane)
    begins[plane + 1] += begins[plane];
  return begins;
}

} // namespace

ConePainter::ConePainter(const GlFunctions& gl,
                         const GridShape& shape,
                         const std::vector<GridCell>& sites)
    : gl_(gl)
    , width_(static_cast<GLsizei>(shape.cells[0]))
    , height_(static_cast<GLsizei>(shape.cells[1]))
    , plane_begins_(findPlanes(sites, shape.cells[2]))
    , program_(gl, shaders::cone_vertex, shaders::cone_fragment)
    , vertices_(makeBuffer(gl))
    , indices_(makeBuffer(gl))
    , cells_(makeBuffer(gl))
    , array_(makeVertexArray(gl))
{
  checkSize(gl, shape);
  resetState(gl);
  nearest_ = makeTexture(gl, GL_RG32UI, width_, height_);
  depth_ = makeTexture(gl, GL_DEPTH_COMPONENT32F, width_, height_);
  framebuffer_ = makeFramebuffer(gl, {&nearest_}, &depth_);
  std::vector<PlaneCell> cells;
  cells.reserve(sites.size());
  for (const GridCell& site : sites)
    cells.push_back({site[0], site[1]});
  gl.BindVertexArray(array_.get());
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  gl.VertexAttribPointer(corner_attribute, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.EnableVertexAttribArray(corner_attribute);
  gl.EnableVertexAttribArray(cell_attribute);
  gl.VertexAttribDivisor(cell_attribute, 1);
  fillBuffer(gl, GL_ARRAY_BUFFER, cells_, cells);
}

void
ConePainter::setMesh(const ConeMesh& mesh)
{
  gl_.BindVertexArray(array_.get());
  fillBuffer(gl_, GL_ARRAY_BUFFER, vertices_, mesh.getVertices());
  fillBuffer(gl_, GL_ELEMENT_ARRAY_BUFFER, indices_, mesh.getIndices());
  sections_ = mesh.getSections();
  radius_depth_ = mesh.getRadiusDepth();
}

void
ConePainter::clear() const
{
  constexpr GLuint open[4] = {no_site, 0, 0, 0};
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  constexpr GLenum target = GL_COLOR_ATTACHMENT0;
  gl_.DrawBuffers(1, &target);
  gl_.Viewport(0, 0, width_, height_);
  gl_.ClearBufferuiv(GL_COLOR, 0, open);
  // Beyond the radius there may be nearer sites without a cone here: nothing is drawn.
  gl_.ClearBufferfv(GL_DEPTH, 0, &radius_depth_);
}

void
ConePainter::draw(std::uint32_t layer, std::uint32_t* nearest) const
{
  clear();
  program_.use();
  program_.set("size", static_cast<float>(width_), static_cast<float>(height_));
  gl_.BindVertexArray(array_.get());
  gl_.BindBuffer(GL_ARRAY_BUFFER, cells_.get());
  const auto planes = static_cast<std::uint32_t>(plane_begins_.size() - 1);
  const auto reach = static_cast<std::uint32_t>(sections_.size() - 1);
  // In the order of the sites: of equal depths the first stays.
  const std::uint32_t last = std::min(layer + reach, planes - 1);
  for (std::uint32_t plane = layer - std::min(layer, reach); plane <= last; ++plane)
    drawPlane(plane, sections_[plane < layer ? layer - plane : plane - layer]);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, nearest);
}

void
ConePainter::drawPlane(std::uint32_t plane, const ConeMesh::Section& section) const
{
  const std::uint32_t begin = plane_begins_[plane], end = plane_begins_[plane + 1];
  if (begin == end)
    return;
  // OpenGL 3.3 counts instances from 0: the attributes move instead.
  gl_.VertexAttribIPointer(cell_attribute,
                           2,
                           GL_UNSIGNED_SHORT,
                           sizeof(PlaneCell),
                           reinterpret_cast<const void*>(begin * sizeof(PlaneCell)));
  program_.set("first", static_cast<int>(begin));
  gl_.DrawElementsInstancedBaseVertex(GL_TRIANGLES,
                                      section.indices,
                                      GL_UNSIGNED_INT,
                                      nullptr,
                                      static_cast<GLsizei>(end - begin),
                                      section.first_vertex);
}

} // namespace pcl_uvol
