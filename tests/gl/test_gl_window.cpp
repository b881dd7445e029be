// SPDX-License-Identifier: BSD-3-Clause
// Drawing into somebody else's framebuffer, as in a window that shows other things too.
#include "gl/gl_backend.h"
#include "gl/scenes.h"

#include <GL/glcorearb.h>
#include <memory>

namespace test_gl_window {

using namespace uvol_test;
using pcl_uvol::GlBackend;
using pcl_uvol::GlContext;
using pcl_uvol::Image;
using pcl_uvol::Report;
using pcl_uvol::View;

constexpr int width = 120, height = 90; // of the image
constexpr int left = 20, below = 10;    // of the image in the window
constexpr int window_width = 160, window_height = 110;

/** A window's framebuffer, off screen: blue, and a wall in front of its left half. */
class Window {
public:
  explicit Window(const std::shared_ptr<GlContext>& context)
      : context_(context)
  {
    GLuint textures[2];
    get<PFNGLGENTEXTURESPROC>("glGenTextures")(2, textures);
    get<PFNGLGENFRAMEBUFFERSPROC>("glGenFramebuffers")(1, &framebuffer_);
    get<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer_);
    attach(textures[0], GL_RGBA8, GL_RGBA, GL_COLOR_ATTACHMENT0);
    attach(textures[1], GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_DEPTH_ATTACHMENT);
    get<PFNGLCLEARCOLORPROC>("glClearColor")(0.0f, 0.0f, 1.0f, 1.0f);
    clear(0, window_width, 1.0);
    clear(0, window_width / 2, 0.0);
  }

  GLuint
  getFramebuffer() const
  {
    return framebuffer_;
  }

  /** Every state that drawing depends on, set to what it cannot use. */
  void
  messUp() const
  {
    const auto enable = get<PFNGLENABLEPROC>("glEnable");
    for (const GLenum state : {GL_BLEND,
                               GL_CULL_FACE,
                               GL_DEPTH_TEST,
                               GL_SCISSOR_TEST,
                               GL_STENCIL_TEST,
                               GL_COLOR_LOGIC_OP,
                               GL_PROGRAM_POINT_SIZE,
                               GL_RASTERIZER_DISCARD})
      enable(state);
    get<PFNGLCULLFACEPROC>("glCullFace")(GL_FRONT_AND_BACK);
    get<PFNGLDEPTHFUNCPROC>("glDepthFunc")(GL_NEVER);
    get<PFNGLDEPTHMASKPROC>("glDepthMask")(GL_FALSE);
    get<PFNGLCOLORMASKPROC>("glColorMask")(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    get<PFNGLSCISSORPROC>("glScissor")(0, 0, 1, 1);
    get<PFNGLVIEWPORTPROC>("glViewport")(3, 3, 5, 5);
    get<PFNGLDEPTHRANGEPROC>("glDepthRange")(0.25, 0.5);
    get<PFNGLPOINTSIZEPROC>("glPointSize")(9.0f);
    get<PFNGLPOLYGONMODEPROC>("glPolygonMode")(GL_FRONT_AND_BACK, GL_LINE);
    get<PFNGLPIXELSTOREIPROC>("glPixelStorei")(GL_PACK_ROW_LENGTH, 7);
    get<PFNGLACTIVETEXTUREPROC>("glActiveTexture")(GL_TEXTURE5);
  }

  template <typename T>
  std::vector<T>
  read(GLenum format, GLenum type, std::size_t channels) const
  {
    std::vector<T> pixels(channels * window_width * window_height);
    get<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer_);
    get<PFNGLREADPIXELSPROC>("glReadPixels")(
        0, 0, window_width, window_height, format, type, pixels.data());
    return pixels;
  }

private:
  template <typename Function>
  Function
  get(const char* name) const
  {
    return reinterpret_cast<Function>(context_->getFunction(name));
  }

  void
  attach(GLuint texture, GLenum format, GLenum pixels, GLenum attachment) const
  {
    get<PFNGLBINDTEXTUREPROC>("glBindTexture")(GL_TEXTURE_2D, texture);
    get<PFNGLTEXIMAGE2DPROC>("glTexImage2D")(GL_TEXTURE_2D,
                                             0,
                                             static_cast<GLint>(format),
                                             window_width,
                                             window_height,
                                             0,
                                             pixels,
                                             GL_FLOAT,
                                             nullptr);
    get<PFNGLFRAMEBUFFERTEXTURE2DPROC>("glFramebufferTexture2D")(
        GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
  }

  void
  clear(int x, int columns, double depth) const
  {
    get<PFNGLENABLEPROC>("glEnable")(GL_SCISSOR_TEST);
    get<PFNGLSCISSORPROC>("glScissor")(x, 0, columns, window_height);
    get<PFNGLCLEARDEPTHPROC>("glClearDepth")(depth);
    get<PFNGLCLEARPROC>("glClear")(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }

  std::shared_ptr<GlContext> context_;
  GLuint framebuffer_ = 0;
};

/** OpenGL's usual projection of what lies between two depths, for a camera that looks
 * along positive z with y downwards. */
void
setProjection(float near, float far, float* projection)
{
  std::fill_n(projection, 16, 0.0f);
  projection[0] = 1.0f;
  projection[5] = -1.0f;
  projection[10] = (far + near) / (far - near);
  projection[11] = -2.0f * far * near / (far - near);
  projection[14] = 1.0f;
}

/** Depth in the window of a pixel of an image. */
double
windowDepth(const View& view, const float* projection, int row, int column, float depth)
{
  const double x = (column + View::guard + 0.5 - view.center_x) / view.focal;
  const double y = (row + View::guard + 0.5 - view.center_y) / view.focal;
  const double z = depth * view.far / std::sqrt(x * x + y * y + 1.0);
  return 0.5 + 0.5 * (projection[10] * z + projection[11]) / z;
}

class GlWindow : public testing::TestWithParam<std::string> {
protected:
  void
  SetUp() override
  {
    scene_ = makeScene("waves");
    settings_.anti_aliasing = false;
    settings_.background.kind = pcl_uvol::Background::Kind::Transparent;
    context_ = GetParam() == "osmesa"
                   ? pcl_uvol::createOsMesaContext()
                   : pcl_uvol::createEglContext(pcl_uvol::EglDevice::Software);
    backend_ = std::make_unique<GlBackend>(context_);
    view_ =
        std::make_unique<View>(scene_.camera, scene_.cloud->getBounds(), width, height);
    target_.x = left;
    target_.y = below;
    setProjection(0.5f * view_->near, 2.0f * view_->far, target_.projection);
  }

  /** What a window shows from the lower left, after drawing into it. */
  struct Shown {
    std::vector<std::uint8_t> colors;
    std::vector<float> depths;
  };

  Shown
  drawIntoWindow(Report& report)
  {
    Shown shown;
    context_->run([&] {
      const Window window(context_);
      target_.name = window.getFramebuffer();
      backend_->renderToFramebuffer(
          {*scene_.cloud, *view_, settings_, {}, 0}, target_, report);
      shown.colors = window.read<std::uint8_t>(GL_RGBA, GL_UNSIGNED_BYTE, 4);
      shown.depths = window.read<float>(GL_DEPTH_COMPONENT, GL_FLOAT, 1);
    });
    return shown;
  }

  Scene scene_;
  pcl_uvol::ImageSpaceSettings settings_;
  std::shared_ptr<GlContext> context_;
  std::unique_ptr<GlBackend> backend_;
  std::unique_ptr<View> view_;
  pcl_uvol::GlFramebuffer target_;
};

INSTANTIATE_TEST_SUITE_P(GlBackend,
                         GlWindow,
                         testing::Values("osmesa", "egl"),
                         [](const auto& name) { return name.param; });

TEST_P(GlWindow, ShowsTheImageWhereNothingIsInFront)
{
  Report report;
  const Image image = draw(*backend_, scene_, settings_, report, width, height);
  const auto [colors, depths] = drawIntoWindow(report);
  int shown = 0, hidden = 0;
  for (int y = 0; y < window_height; ++y)
    for (int x = 0; x < window_width; ++x) {
      const int row = height - 1 - (y - below), column = x - left;
      const auto pixel = static_cast<std::size_t>(y * window_width + x);
      const auto place = static_cast<std::size_t>(row * width + column);
      const bool is_inside = row >= 0 && row < height && column >= 0 && column < width;
      const bool is_surface = is_inside && image.id[place] != Image::background;
      const bool is_behind = x < window_width / 2;
      shown += is_surface && !is_behind;
      hidden += is_surface && is_behind;
      if (is_surface && !is_behind) {
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_NEAR(image.color[4 * place + k], colors[4 * pixel + k], 1);
        ASSERT_NEAR(
            windowDepth(*view_, target_.projection, row, column, image.depth[place]),
            depths[pixel],
            1e-5);
      }
      else {
        ASSERT_EQ(0, colors[4 * pixel]) << x << ", " << y;
        ASSERT_EQ(255, colors[4 * pixel + 2]);
        ASSERT_EQ(is_behind ? 0.0f : 1.0f, depths[pixel]);
      }
    }
  EXPECT_GT(shown, 500);
  EXPECT_GT(hidden, 500);
}

TEST_P(GlWindow, NoStateOfOthersMatters)
{
  Report report;
  const Image expected = draw(*backend_, scene_, settings_, report);
  context_->run([&] { Window(context_).messUp(); });
  const Image image = draw(*backend_, scene_, settings_, report);
  EXPECT_TRUE(expected.color == image.color);
  EXPECT_TRUE(expected.id == image.id);
  EXPECT_TRUE(expected.normal == image.normal);
}

TEST_P(GlWindow, AntiAliasedBordersBlend)
{
  settings_.anti_aliasing = true;
  Report report;
  const Image image = draw(*backend_, scene_, settings_, report, width, height);
  const auto colors = drawIntoWindow(report).colors;
  int blended = 0;
  for (int row = 0; row < height; ++row)
    for (int column = window_width / 2 - left; column < width; ++column) {
      const auto place = static_cast<std::size_t>(row * width + column);
      const auto pixel = static_cast<std::size_t>(
          (height - 1 - row + below) * window_width + column + left);
      const double opacity = image.color[4 * place + 3] / 255.0;
      blended += opacity > 0.0 && opacity < 1.0;
      const double blue =
          image.color[4 * place + 2] * opacity + 255.0 * (1.0 - opacity);
      ASSERT_NEAR(image.color[4 * place] * opacity, colors[4 * pixel], 2);
      ASSERT_NEAR(blue, colors[4 * pixel + 2], 2);
    }
  EXPECT_GT(blended, 50);
}

} // namespace test_gl_window
