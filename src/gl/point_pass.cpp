// SPDX-License-Identifier: BSD-3-Clause
#include "gl/point_pass.h"

#include <algorithm>
#include <limits>
#include <string>

namespace pcl_uvol {

namespace {

/** Attributes as the shaders number them. */
constexpr GLuint look_attribute = 3;
constexpr GLuint footprint_attribute = 4;
constexpr GLuint filler_attribute = 5;
constexpr GLuint bend_attribute = 6;
constexpr GLuint rim_attribute = 7;

/** Discs with a greater radius, in pixels, are rather drawn as two triangles. */
constexpr float most_reach = 16.0f;

template <typename T>
void
fillBuffer(const GlFunctions& gl, GlName& buffer, const std::vector<T>& values)
{
  buffer = makeBuffer(gl);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer.get());
  gl.BufferData(GL_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(values.size() * sizeof(T)),
                values.data(),
                GL_STATIC_DRAW);
}

const void*
offsetOf(std::size_t bytes)
{
  return reinterpret_cast<const void*>(bytes);
}

} // namespace

void
setView(const Program& program, const View& view)
{
  const float *const r = view.rotation, *const t = view.translation;
  program.setMatrix("rotation", r);
  program.set("translation", t[0], t[1], t[2]);
  program.set("eye",
              -(r[0] * t[0] + r[3] * t[1] + r[6] * t[2]),
              -(r[1] * t[0] + r[4] * t[1] + r[7] * t[2]),
              -(r[2] * t[0] + r[5] * t[1] + r[8] * t[2]));
  program.set("center", view.center_x, view.center_y);
  program.set("focal", view.focal);
  program.set("per_focal", 1.0f / view.focal);
  program.set("near", view.near);
  program.set("far", view.far);
  program.set("per_far", 1.0f / view.far);
}

PointPass::PointPass(const GlFunctions& gl, Programs& programs)
    : gl_(gl)
    , programs_(programs)
{
  GLfloat sizes[2] = {1.0f, 1.0f};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, sizes);
  usual_reach_ = std::min(most_reach, 0.5f * sizes[1] - 1.0f);
  GLint viewport[2] = {0, 0};
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  largest_viewport_ = std::min(viewport[0], viewport[1]);
}

void
PointPass::fitTo(const Canvas& canvas)
{
  const int room =
      (largest_viewport_ - std::max(canvas.getWidth(), canvas.getHeight())) / 2;
  largest_reach_ = std::clamp(static_cast<float>(room - 1), 0.0f, usual_reach_);
}

void
PointPass::upload(const SurfaceCloud& cloud)
{
  GLint largest = 0;
  gl_.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
  if (cloud.size() > static_cast<std::size_t>(largest))
    throw GlError("gl_cloud_too_large", {{"points", cloud.size()}, {"most", largest}});
  revision_ = 0;
  for (int axis = 0; axis < 3; ++axis)
    fillBuffer(gl_, coordinates_[axis], cloud.getCoordinates(axis));
  fillBuffer(gl_, looks_, cloud.getLooks());
  looks_texture_ = makeBufferTexture(gl_, GL_RG32UI, looks_);
  has_footprints_ = !cloud.getFootprints().empty();
  fillBuffer(gl_, footprints_, cloud.getFootprints());
  if (has_footprints_)
    footprints_texture_ = makeBufferTexture(gl_, GL_R32F, footprints_);
  fillBuffer(gl_, fillers_, cloud.getFillers());
  fillBuffer(gl_, bends_, cloud.getBends());
  fillBuffer(gl_, rims_, cloud.getRims());
  // New ones, which know nothing of the buffers of another cloud.
  points_array_ = makeVertexArray(gl_);
  discs_array_ = makeVertexArray(gl_);
  gl_.BindVertexArray(points_array_.get());
  bindAttributes(0, 0);
  revision_ = cloud.getRevision();
}

void
PointPass::bindAttributes(std::uint32_t first, GLuint divisor) const
{
  const auto bindFloats = [&](GLuint attribute, const GlName& buffer) {
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.get());
    gl_.VertexAttribPointer(
        attribute, 1, GL_FLOAT, GL_FALSE, 0, offsetOf(first * sizeof(float)));
    gl_.EnableVertexAttribArray(attribute);
    gl_.VertexAttribDivisor(attribute, divisor);
  };
  for (GLuint axis = 0; axis < 3; ++axis)
    bindFloats(axis, coordinates_[axis]);
  const auto bindWords = [&](GLuint attribute, const GlName& buffer, GLint count) {
    const auto stride = static_cast<GLsizei>(count * sizeof(std::uint32_t));
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.get());
    gl_.VertexAttribIPointer(attribute,
                             count,
                             GL_UNSIGNED_INT,
                             stride,
                             offsetOf(first * static_cast<std::size_t>(stride)));
    gl_.EnableVertexAttribArray(attribute);
    gl_.VertexAttribDivisor(attribute, divisor);
  };
  if (has_footprints_) {
    bindFloats(footprint_attribute, footprints_);
    bindFloats(filler_attribute, *radii_);
    bindWords(bend_attribute, bends_, 1);
    bindWords(rim_attribute, rims_, 1);
  }
  bindWords(look_attribute, looks_, 2);
}

void
PointPass::chooseRadii(const GlName& radii)
{
  radii_ = &radii;
  gl_.BindVertexArray(points_array_.get());
  bindAttributes(0, 0);
}

void
PointPass::bind(const Canvas& canvas, const GlName& framebuffer, int targets)
{
  canvas.bind(framebuffer, targets);
  // Points are clipped by their middle.
  viewport_ = PixelBox{0, 0, canvas.getWidth(), canvas.getHeight()}.grownBy(
      largest_reach_ > 0.0f ? static_cast<int>(largest_reach_) + 1 : 0);
  gl_.Viewport(viewport_.left, viewport_.top, viewport_.width(), viewport_.height());
}

const Program&
PointPass::use(const shaders::Pass& pass,
               const std::string& defines,
               const Frame& frame) const
{
  const Program& program = programs_.use(pass, defines);
  setView(program, frame.view);
  program.set("origin",
              static_cast<float>(viewport_.left - shaders::margin),
              static_cast<float>(viewport_.top - shaders::margin));
  program.set("extent",
              static_cast<float>(viewport_.width()),
              static_cast<float>(viewport_.height()));
  program.set("is_two_sided", !frame.culls());
  program.set("outward", frame.outward());
  program.set("has_sides", frame.hasSides());
  program.set("culls", frame.culls());
  program.set("smallest_footprint", frame.smallestDisc());
  program.set("largest_filler", largest_filler);
  program.set("smallest_bend", smallest_bend);
  program.set("smallest_turn", smallest_turn);
  program.set("per_bend", packed_bend_scale);
  program.set("largest_reach", largest_reach_);
  return program;
}

void
PointPass::drawPoints(const std::vector<PointRange>& ranges) const
{
  std::vector<GLint> firsts;
  std::vector<GLsizei> counts;
  for (const PointRange& range : ranges) {
    firsts.push_back(static_cast<GLint>(range.begin));
    counts.push_back(static_cast<GLsizei>(range.end - range.begin));
  }
  gl_.BindVertexArray(points_array_.get());
  gl_.MultiDrawArrays(
      GL_POINTS, firsts.data(), counts.data(), static_cast<GLsizei>(ranges.size()));
}

void
PointPass::drawLargeDiscs(const Program& program,
                          const std::vector<PointRange>& ranges) const
{
  gl_.BindVertexArray(discs_array_.get());
  for (const PointRange& range : ranges) {
    // OpenGL 3.3 counts instances from 0: the attributes move instead.
    program.set("first", static_cast<int>(range.begin));
    bindAttributes(range.begin, 1);
    gl_.DrawArraysInstanced(
        GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(range.end - range.begin));
  }
}

void
PointPass::drawDiscs(const Frame& frame, const VisibleRanges& ranges, double back) const
{
  const auto use_drawing = [&](const shaders::Pass& pass,
                               const std::string& defines) -> const Program& {
    const Program& program = use(pass, defines, frame);
    program.set("back", back);
    program.set("away_depth", frame.hasSides() ? away_depth : 0.0f);
    program.set("rim_depth_bits", rim_depth_bits);
    program.set("rim_directions", rim_directions);
    return program;
  };
  const Program& small = use_drawing(shaders::small_discs, "#define WITH_PIXELS\n");
  small.set("smallest_cover",
            back > 0.0 ? std::numeric_limits<float>::max() : smallest_cover);
  drawPoints(ranges.points);
  drawLargeDiscs(use_drawing(shaders::large_discs, ""), ranges.large_discs);
}

void
PointPass::draw(const Frame& frame, const VisiblePoints& visible, const Canvas& canvas)
{
  bind(canvas, canvas.projected, 1);
  gl_.Enable(GL_DEPTH_TEST);
  if (frame.hasFootprints()) {
    chooseRadii(fillers_);
    drawDiscs(frame, visible.dense, filler_depth);
    chooseRadii(footprints_);
    drawDiscs(frame, visible.sparse, 0.0);
  }
  else {
    use(shaders::points, "", frame);
    drawPoints(visible.dense.points);
  }
  gl_.Disable(GL_DEPTH_TEST);
}

void
PointPass::blend(const Frame& frame,
                 const VisiblePoints& visible,
                 const GlName& states,
                 const Canvas& canvas)
{
  static const std::string define = "#define BLENDED\n";
  constexpr float zero[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  bind(canvas, canvas.blended, 2);
  gl_.ClearBufferfv(GL_COLOR, 0, zero);
  gl_.ClearBufferfv(GL_COLOR, 1, zero);
  gl_.Enable(GL_BLEND);
  gl_.BlendEquation(GL_FUNC_ADD);
  gl_.BlendFunc(GL_ONE, GL_ONE);
  const auto use_blending = [&](const shaders::Pass& pass) -> const Program& {
    const Program& program = use(pass, define, frame);
    program.setTexture("states", 0, states);
    program.setTexture("looks", 1, looks_texture_, GL_TEXTURE_BUFFER);
    program.setTexture("footprints", 2, footprints_texture_, GL_TEXTURE_BUFFER);
    program.set("stretch", blend_reach);
    program.set("away_depth", away_depth);
    program.set("edge_on_cosine", edge_on_cosine);
    program.set("facing_weight", facing_weight);
    program.set("facing_reach", facing_reach);
    return program;
  };
  use_blending(shaders::blend_small);
  drawPoints(visible.sparse.points);
  drawLargeDiscs(use_blending(shaders::blend_large), visible.sparse.large_discs);
  gl_.Disable(GL_BLEND);
}

} // namespace pcl_uvol
