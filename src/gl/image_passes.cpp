// SPDX-License-Identifier: BSD-3-Clause
#include "gl/image_passes.h"

#include <cstring>
#include <utility>

namespace pcl_uvol {

namespace {

/** Texels around the image in textures. */
constexpr int image_border = View::guard + shaders::margin;

/** Times a pass, waiting for its end. */
class PassTimer {
public:
  PassTimer(const GlFunctions& gl, Report& report, const char* pass)
      : gl_(gl)
      , timer_(report, pass)
  {
  }
  ~PassTimer()
  {
    gl_.Finish();
  }
  PassTimer(const PassTimer&) = delete;
  PassTimer&
  operator=(const PassTimer&) = delete;

private:
  const GlFunctions& gl_;
  StepTimer timer_;
};

bool
hasLines(const ImageSpaceSettings& settings)
{
  return settings.silhouettes || settings.feature_lines;
}

bool
smooths(const ImageSpaceSettings& settings)
{
  return settings.smoothing != SmoothingFilter::None &&
         settings.smoothing_iterations > 0;
}

void
setColor(const Program& program, const char* uniform, const Color& color)
{
  program.set(uniform, color.r, color.g, color.b);
}

/** Depth and id of every pixel. */
void
splitStates(const Frame& frame, const std::vector<GLuint>& states, Image& image)
{
  const std::vector<std::uint32_t>& inputs = frame.cloud.getInputIndices();
  if (frame.planes.depth) {
    image.depth.resize(image.pixels());
    for (std::size_t i = 0; i < image.pixels(); ++i)
      std::memcpy(&image.depth[i], &states[2 * i], sizeof(float));
  }
  if (frame.planes.id) {
    image.id.resize(image.pixels());
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const GLuint point = states[2 * i + 1];
      image.id[i] = point < inputs.size() ? inputs[point] : Image::background;
    }
  }
}

/** The pixels of a row that are not transparent. */
PixelBox
findCoveredInRow(const Image& image, int row)
{
  const int width = static_cast<int>(image.width);
  const std::uint8_t* const opacity =
      image.color.data() + 4 * static_cast<std::size_t>(row) * image.width + 3;
  int left = 0, right = width;
  while (left < width && opacity[4 * left] == 0)
    ++left;
  while (right > left && opacity[4 * (right - 1)] == 0)
    --right;
  return {left, row, right, row + 1};
}

/** The box of the pixels that are not transparent. */
PixelBox
findCovered(const Image& image)
{
  PixelBox box{0, 0, 0, 0};
  for (int row = 0; row < static_cast<int>(image.height); ++row)
    if (const PixelBox covered = findCoveredInRow(image, row); !covered.isEmpty())
      box = covered.unitedWith(box);
  return box;
}

/** That box in an image whose pixels are that many times as small. */
PixelBox
enlarge(const PixelBox& box, int factor)
{
  return {box.left * factor, box.top * factor, box.right * factor, box.bottom * factor};
}

} // namespace

ImagePasses::ImagePasses(const GlFunctions& gl)
    : gl_(gl)
    , programs_(gl)
    , points_(gl, programs_)
    , fills_(gl, programs_)
    , occlusion_(gl, programs_)
    , painter_(gl)
    , full_screen_array_(makeVertexArray(gl))
{
}

void
ImagePasses::draw(const Frame& frame, Report& report)
{
  const ImageSpaceSettings& settings = frame.settings;
  prepareState();
  if (!points_.holds(frame.cloud)) {
    const PassTimer timer(gl_, report, "upload");
    points_.upload(frame.cloud);
  }
  with_normals_ = settings.feature_lines || frame.planes.normal;
  prepareCanvas(frame);
  const VisiblePoints visible = project(frame, report);
  fill(frame, report);
  with_discs_ = !visible.sparse.points.empty();
  if (with_discs_) {
    const PassTimer timer(gl_, report, "blend");
    points_.blend(frame, visible, canvas_->states[state_], *canvas_);
  }
  const bool is_occluded = occlude(frame, report);
  {
    const PassTimer timer(gl_, report, "shade");
    shade(frame, is_occluded);
  }
  if (smooths(settings)) {
    const PassTimer timer(gl_, report, "smooth");
    smooth(settings);
  }
  if (hasLines(settings)) {
    const PassTimer timer(gl_, report, "lines");
    drawLines(settings);
  }
  if (settings.anti_aliasing) {
    const PassTimer timer(gl_, report, "anti_alias");
    antiAlias(settings);
  }
}

void
ImagePasses::prepareState() const
{
  for (const GLenum capability : {GL_BLEND,
                                  GL_COLOR_LOGIC_OP,
                                  GL_CULL_FACE,
                                  GL_DEPTH_CLAMP,
                                  GL_DEPTH_TEST,
                                  GL_DITHER,
                                  GL_FRAMEBUFFER_SRGB,
                                  GL_POLYGON_OFFSET_FILL,
                                  GL_PRIMITIVE_RESTART,
                                  GL_RASTERIZER_DISCARD,
                                  GL_SAMPLE_ALPHA_TO_COVERAGE,
                                  GL_SAMPLE_COVERAGE,
                                  GL_SAMPLE_MASK,
                                  GL_STENCIL_TEST})
    gl_.Disable(capability);
  constexpr GLenum clip_distances = 8; // that every OpenGL has
  for (GLenum i = 0; i < clip_distances; ++i)
    gl_.Disable(GL_CLIP_DISTANCE0 + i);
  gl_.Enable(GL_PROGRAM_POINT_SIZE);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LESS);
  gl_.DepthRange(0.0, 1.0);
  gl_.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  constexpr GLuint most_units = 6; // of all passes
  for (GLuint unit = 0; unit < most_units; ++unit)
    gl_.BindSampler(unit, 0);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  for (const GLenum parameter :
       {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES})
    gl_.PixelStorei(parameter, 0);
}

void
ImagePasses::prepareCanvas(const Frame& frame)
{
  const Canvas::Options options{with_normals_, frame.hasFootprints()};
  if (canvas_ && canvas_->fits(frame.view, options))
    return;
  canvas_.reset(); // first, as there may be no room for two
  canvas_ = std::make_unique<Canvas>(gl_, frame.view, options);
}

VisiblePoints
ImagePasses::project(const Frame& frame, Report& report)
{
  const PassTimer timer(gl_, report, "project");
  points_.fitTo(*canvas_);
  VisiblePoints visible = points_.findVisible(frame);
  canvas_->clear();
  points_.draw(frame, visible, *canvas_);
  constexpr int margin = shaders::margin;
  const PixelBox texels{visible.box.left + margin,
                        visible.box.top + margin,
                        visible.box.right + margin,
                        visible.box.bottom + margin};
  // Lines and anti-aliasing reach beyond the surface.
  surface_ = fills_.findSurface(
      *canvas_, texels.grownBy(TileSet::tile).clippedTo(canvas_->getBuffers()));
  return visible;
}

void
ImagePasses::fill(const Frame& frame, Report& report)
{
  const auto run = [&](FillPass::Kind kind, int most, const char* count) {
    report.count(
        count,
        fills_.run(kind, *canvas_, frame.layerDistance(), most, surface_, state_));
  };
  const ImageSpaceSettings& settings = frame.settings;
  state_ = 0;
  {
    const PassTimer timer(gl_, report, "fill_background");
    run(FillPass::Kind::Background, settings.background_fill, "background_iterations");
  }
  const PassTimer timer(gl_, report, "fill_occluded");
  run(FillPass::Kind::Occluded, settings.occluded_fill, "occluded_iterations");
  painter_.setTiles(surface_);
}

void
ImagePasses::paint(const Program& program, const GlName& framebuffer, int targets) const
{
  canvas_->bind(framebuffer, targets);
  painter_.draw(program, *canvas_);
}

void
ImagePasses::uploadLights(const Frame& frame)
{
  std::vector<float> numbers;
  for (const Light& light : frame.settings.lights) {
    const Eigen::Vector3d v = frame.lightVector(light);
    for (int axis = 0; axis < 3; ++axis)
      numbers.push_back(static_cast<float>(v[axis]));
    numbers.push_back(light.kind == Light::Kind::Point ? 1.0f : 0.0f);
    numbers.insert(numbers.end(), {light.color.r, light.color.g, light.color.b, 0.0f});
  }
  lights_ = NumberTable(gl_, std::move(numbers));
}

bool
ImagePasses::occlude(const Frame& frame, Report& report)
{
  const OcclusionGrid grid(frame);
  if (grid.isEmpty())
    return false;
  const PassTimer timer(gl_, report, "occlusion");
  occlusion_.run(frame, grid, canvas_->states[state_], points_.getLooks());
  return true;
}

void
ImagePasses::shade(const Frame& frame, bool is_occluded)
{
  const ImageSpaceSettings& settings = frame.settings;
  uploadLights(frame);
  const Program& program = programs_.use(shaders::shade,
                                         defineIf(settings.shading, "LIT") +
                                             defineIf(with_normals_, "WITH_NORMALS") +
                                             defineIf(with_discs_, "WITH_DISCS") +
                                             defineIf(is_occluded, "WITH_OCCLUSION"));
  setView(program, frame.view);
  program.setTexture("state", 0, canvas_->states[state_]);
  program.setTexture("looks", 1, points_.getLooks(), GL_TEXTURE_BUFFER);
  program.setTexture("lights", 2, lights_.getTexture(), GL_TEXTURE_BUFFER);
  if (with_discs_) {
    program.setTexture("blended_normals", 3, canvas_->blended_normals);
    program.setTexture("blended_colors", 4, canvas_->blended_colors);
  }
  if (is_occluded)
    occlusion_.bindTo(program, 5);
  program.set("light_count", static_cast<int>(settings.lights.size()));
  program.set("is_two_sided", !frame.culls());
  program.set("ambient", settings.material.ambient);
  program.set("diffuse", settings.material.diffuse);
  program.set("specular", settings.material.specular);
  program.set("shininess", settings.material.shininess);
  color_ = 0;
  normal_ = 0;
  paint(program, canvas_->shaded[color_], with_normals_ ? 2 : 1);
}

void
ImagePasses::smooth(const ImageSpaceSettings& settings)
{
  const Program& program =
      programs_.use(shaders::smooth, defineIf(with_normals_, "WITH_NORMALS"));
  switch (settings.smoothing) {
  case SmoothingFilter::Box:
    program.set("weights", 1.0f, 1.0f, 1.0f);
    break;
  case SmoothingFilter::Gaussian:
    program.set("weights", 4.0f, 2.0f, 1.0f);
    break;
  default:
    program.set("weights", 16.0f, 2.0f, 1.0f);
  }
  for (int i = 0; i < settings.smoothing_iterations; ++i) {
    program.setTexture("colors", 0, canvas_->colors[color_]);
    if (with_normals_)
      program.setTexture("normals", 1, canvas_->normals[normal_]);
    color_ = normal_ = 1 - color_;
    paint(program, canvas_->shaded[color_], with_normals_ ? 2 : 1);
  }
}

void
ImagePasses::drawLines(const ImageSpaceSettings& settings)
{
  if (settings.silhouettes) {
    const Program& program = programs_.use(shaders::silhouettes);
    program.setTexture("state", 0, canvas_->states[state_]);
    program.set("silhouette_threshold", settings.silhouette_threshold);
    paint(program, canvas_->outlined);
  }
  const Program& program =
      programs_.use(shaders::lines,
                    defineIf(settings.silhouettes, "WITH_SILHOUETTES") +
                        defineIf(settings.feature_lines, "WITH_FEATURES"));
  program.setTexture("colors", 0, canvas_->colors[color_]);
  program.setTexture("silhouettes", 1, canvas_->silhouettes);
  if (settings.feature_lines)
    program.setTexture("normals", 2, canvas_->normals[normal_]);
  program.set("reach", settings.silhouette_thickness - 1);
  program.set("silhouette_threshold", settings.silhouette_threshold);
  program.set("feature_threshold", settings.feature_threshold);
  setColor(program, "line_color", settings.line_color);
  color_ = 1 - color_;
  paint(program, canvas_->shaded[color_]);
}

void
ImagePasses::antiAlias(const ImageSpaceSettings& settings)
{
  const Program& program = programs_.use(shaders::anti_alias);
  program.setTexture("state", 0, canvas_->states[state_]);
  program.setTexture("colors", 1, canvas_->colors[color_]);
  program.set("threshold", settings.anti_aliasing_threshold);
  color_ = 1 - color_;
  paint(program, canvas_->shaded[color_]);
}

void
ImagePasses::finish(const Frame& frame, Image& image, Report& report)
{
  {
    const PassTimer timer(gl_, report, "output");
    drawOutput(frame);
  }
  const PassTimer timer(gl_, report, "read_back");
  readBack(frame, image);
}

void
ImagePasses::drawOutput(const Frame& frame)
{
  const View& view = frame.view;
  const Background& background = frame.settings.background;
  const bool is_transparent = background.kind == Background::Kind::Transparent;
  const bool is_gradient = background.kind == Background::Kind::Gradient;
  const Program& program =
      programs_.use(shaders::output, defineIf(is_transparent, "IS_TRANSPARENT"));
  program.setTexture("colors", 0, canvas_->colors[color_]);
  program.set("border", static_cast<float>(image_border));
  program.set("height", static_cast<float>(view.height));
  setColor(program, "top", is_gradient ? background.top : background.color);
  setColor(program, "bottom", background.color);
  canvas_->bind(canvas_->finished);
  gl_.Viewport(0, 0, view.width, view.height);
  gl_.Scissor(0, 0, view.width, view.height);
  gl_.BindVertexArray(full_screen_array_.get());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void
ImagePasses::compose(const Frame& frame, const GlFramebuffer& target, Report& report)
{
  const PassTimer timer(gl_, report, "output");
  const Program& program = programs_.use(shaders::composite);
  program.setTexture("colors", 0, canvas_->colors[color_]);
  program.setTexture("state", 1, canvas_->states[state_]);
  drawOver(program, frame.view, {0, 0, frame.view.width, frame.view.height}, target);
}

void
ImagePasses::paste(const View& view,
                   int factor,
                   const Image& image,
                   const GlFramebuffer& target,
                   Report& report)
{
  const PassTimer timer(gl_, report, "output");
  const PixelBox box = findCovered(image);
  if (box.isEmpty())
    return;
  prepareState();
  const int width = static_cast<int>(image.width),
            height = static_cast<int>(image.height);
  const GlName colors = makeTexture(gl_, GL_RGBA8, width, height, image.color.data());
  const GlName depths = makeTexture(gl_, GL_R32F, width, height, image.depth.data());
  const Program& program = programs_.use(shaders::composite, "#define OF_IMAGE\n");
  program.setTexture("colors", 0, colors);
  program.setTexture("depths", 1, depths);
  program.set("scale", 1.0 / factor);
  drawOver(program, view, enlarge(box, factor), target);
}

void
ImagePasses::drawOver(const Program& program,
                      const View& view,
                      const PixelBox& box,
                      const GlFramebuffer& target) const
{
  const PixelBox drawn = box.clippedTo({0, 0, view.width, view.height});
  const float* const p = target.projection;
  setView(program, view);
  program.set("origin", static_cast<float>(target.x), static_cast<float>(target.y));
  program.set("height", static_cast<float>(view.height));
  program.set("border", static_cast<float>(image_border));
  program.set("clip_z", p[8], p[9], p[10], p[11]);
  program.set("clip_w", p[12], p[13], p[14], p[15]);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.name);
  gl_.Viewport(target.x, target.y, view.width, view.height);
  gl_.Scissor(target.x + drawn.left,
              target.y + view.height - drawn.bottom, // rows count from below
              drawn.width(),
              drawn.height());
  gl_.Enable(GL_BLEND);
  gl_.BlendEquation(GL_FUNC_ADD);
  gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // colours are premultiplied
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.BindVertexArray(full_screen_array_.get());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void
ImagePasses::readBack(const Frame& frame, Image& image) const
{
  const View& view = frame.view;
  image = Image();
  image.width = static_cast<std::uint32_t>(view.width);
  image.height = static_cast<std::uint32_t>(view.height);
  image.color.resize(4 * image.pixels());
  const auto read = [&](const GlName& framebuffer,
                        GLenum attachment,
                        int border,
                        GLenum format,
                        GLenum type,
                        void* pixels) {
    canvas_->bind(framebuffer);
    gl_.ReadBuffer(attachment);
    gl_.ReadPixels(border, border, view.width, view.height, format, type, pixels);
  };
  read(canvas_->finished,
       GL_COLOR_ATTACHMENT0,
       0,
       GL_RGBA,
       GL_UNSIGNED_BYTE,
       image.color.data());
  if (frame.planes.normal) {
    image.normal.resize(3 * image.pixels());
    read(canvas_->shaded[normal_],
         GL_COLOR_ATTACHMENT1,
         image_border,
         GL_RGB,
         GL_FLOAT,
         image.normal.data());
  }
  if (frame.planes.depth || frame.planes.id) {
    std::vector<GLuint> states(2 * image.pixels());
    read(canvas_->filled[state_],
         GL_COLOR_ATTACHMENT0,
         image_border,
         GL_RG_INTEGER,
         GL_UNSIGNED_INT,
         states.data());
    splitStates(frame, states, image);
  }
}

} // namespace pcl_uvol
