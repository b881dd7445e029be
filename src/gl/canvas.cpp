// SPDX-License-Identifier: BSD-3-Clause
#include "gl/canvas.h"

#include "gl/shaders.h"
#include "gl/tile_set.h"

#include <algorithm>
#include <string>

namespace pcl_uvol {

namespace {

/** Whole tiles, so that tiles hold no texels that do not exist. */
int
canvasSize(int buffer_size)
{
  constexpr int tile = TileSet::tile;
  return (buffer_size + 2 * shaders::margin + tile - 1) / tile * tile;
}

void
checkSize(const GlFunctions& gl, const View& view)
{
  const int largest = findLargestImage(gl);
  if (std::max(view.width, view.height) > largest)
    throw GlError("gl_image_too_large",
                  {{"width", view.width}, {"height", view.height}, {"most", largest}});
}

} // namespace

int
findLargestImage(const GlFunctions& gl)
{
  GLint texture = 0;
  gl.GetIntegerv(GL_MAX_RECTANGLE_TEXTURE_SIZE, &texture);
  GLint viewport[2] = {0, 0};
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  const int canvas =
      std::min({texture, viewport[0], viewport[1]}) / TileSet::tile * TileSet::tile;
  return canvas - 2 * (View::guard + shaders::margin);
}

Canvas::Canvas(const GlFunctions& gl, const View& view, const Options& options)
    : gl_(gl)
    , image_width_(view.width)
    , image_height_(view.height)
    , width_(canvasSize(view.bufferWidth()))
    , height_(canvasSize(view.bufferHeight()))
    , options_(options)
{
  checkSize(gl, view);
  const auto make = [&](GLenum format) {
    return makeTexture(gl, format, width_, height_);
  };
  constexpr int tile = TileSet::tile;
  depth = make(GL_DEPTH_COMPONENT32F);
  row_changes = makeTexture(gl, GL_R8UI, width_ / tile, height_);
  changes = makeTexture(gl, GL_R8UI, width_ / tile, height_ / tile);
  silhouettes = make(GL_R16F);
  image = makeTexture(gl, GL_RGBA8, view.width, view.height);
  for (int i = 0; i < 2; ++i) {
    states[i] = make(GL_RG32UI);
    colors[i] = make(GL_RGBA16F);
    filled[i] = makeFramebuffer(gl, {&states[i]});
    if (options.normals) {
      normals[i] = make(GL_RGBA32F); // lines come from small differences of them
      shaded[i] = makeFramebuffer(gl, {&colors[i], &normals[i]});
    }
    else
      shaded[i] = makeFramebuffer(gl, {&colors[i]});
  }
  if (options.discs) {
    blended_normals = make(GL_RGBA32F);
    blended_colors = make(GL_RGBA32F);
    blended = makeFramebuffer(gl, {&blended_normals, &blended_colors});
  }
  projected = makeFramebuffer(gl, {&states[0]}, &depth);
  compared = makeFramebuffer(gl, {&row_changes});
  collected = makeFramebuffer(gl, {&changes});
  outlined = makeFramebuffer(gl, {&silhouettes});
  finished = makeFramebuffer(gl, {&image});
}

PixelBox
Canvas::getBuffers() const
{
  constexpr int border = View::guard + shaders::margin;
  constexpr int first = shaders::margin;
  return {first,
          first,
          image_width_ + 2 * border - first,
          image_height_ + 2 * border - first};
}

void
Canvas::bind(const GlName& framebuffer, int targets) const
{
  static constexpr GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  const PixelBox buffers = getBuffers();
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  gl_.DrawBuffers(targets, attachments);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Scissor(buffers.left, buffers.top, buffers.width(), buffers.height());
}

void
Canvas::clear() const
{
  constexpr GLuint no_point[4] = {0x3f800000, 0xffffffff, 0, 0}; // depth 1
  constexpr float zero[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  constexpr float no_normal[4] = {0.0f, 0.0f, 0.0f, 1.0f};
  constexpr float farthest = 1.0f;
  gl_.Disable(GL_SCISSOR_TEST);
  for (int i = 0; i < 2; ++i) {
    bind(filled[i]);
    gl_.ClearBufferuiv(GL_COLOR, 0, no_point);
    bind(shaded[i], options_.normals ? 2 : 1);
    gl_.ClearBufferfv(GL_COLOR, 0, zero);
    if (options_.normals)
      gl_.ClearBufferfv(GL_COLOR, 1, no_normal);
  }
  bind(outlined);
  gl_.ClearBufferfv(GL_COLOR, 0, zero);
  bind(projected);
  gl_.ClearBufferfv(GL_DEPTH, 0, &farthest);
  gl_.Enable(GL_SCISSOR_TEST);
}

} // namespace pcl_uvol
