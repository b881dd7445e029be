// SPDX-License-Identifier: BSD-3-Clause
#include "vtk/scoped_gl_state.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>

#include <GL/glcorearb.h>
#include <array>
#include <cstddef>

namespace pcl_uvol {

namespace {

/** What drawing switches and vtkOpenGLState does not keep. */
constexpr std::array<GLenum, 11> untracked_switches = {GL_COLOR_LOGIC_OP,
                                                       GL_DEPTH_CLAMP,
                                                       GL_DITHER,
                                                       GL_FRAMEBUFFER_SRGB,
                                                       GL_POLYGON_OFFSET_FILL,
                                                       GL_PRIMITIVE_RESTART,
                                                       GL_PROGRAM_POINT_SIZE,
                                                       GL_RASTERIZER_DISCARD,
                                                       GL_SAMPLE_ALPHA_TO_COVERAGE,
                                                       GL_SAMPLE_COVERAGE,
                                                       GL_SAMPLE_MASK};

} // namespace

std::shared_ptr<GlContext>
wrapContext(vtkOpenGLRenderWindow& window)
{
  // VTK tells nobody where its functions are, nor which window system they are of.
  return wrapCurrentContext(window.GetClassName());
}

struct ScopedGlState::State {
  State(vtkOpenGLRenderWindow& drawn, const GlContext& gl)
      : window(drawn)
      , context(gl)
  {
    const auto get_integer = get<PFNGLGETINTEGERVPROC>("glGetIntegerv");
    get_integer(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer);
    get_integer(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer);
    get_integer(GL_VERTEX_ARRAY_BINDING, &vertex_array);
    const auto is_enabled = get<PFNGLISENABLEDPROC>("glIsEnabled");
    for (std::size_t i = 0; i < switches.size(); ++i)
      switches[i] = is_enabled(untracked_switches[i]) == GL_TRUE;
  }

  void
  restore() const
  {
    const auto bind = get<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer");
    bind(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer));
    bind(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer));
    get<PFNGLBINDVERTEXARRAYPROC>("glBindVertexArray")(
        static_cast<GLuint>(vertex_array));
    const auto enable = get<PFNGLENABLEPROC>("glEnable");
    const auto disable = get<PFNGLDISABLEPROC>("glDisable");
    for (std::size_t i = 0; i < switches.size(); ++i)
      (switches[i] ? enable : disable)(untracked_switches[i]);
  }

  template <typename Function>
  Function
  get(const char* name) const
  {
    return reinterpret_cast<Function>(context.getFunction(name));
  }

  vtkOpenGLRenderWindow& window;
  const GlContext& context;
  GLint draw_framebuffer = 0, read_framebuffer = 0, vertex_array = 0;
  std::array<bool, untracked_switches.size()> switches{};
};

ScopedGlState::ScopedGlState(vtkOpenGLRenderWindow& window, const GlContext& context)
    : state_(std::make_unique<State>(window, context))
{
  window.GetState()->Push();
}

ScopedGlState::~ScopedGlState()
{
  state_->restore();
  vtkOpenGLState* const tracked = state_->window.GetState();
  tracked->Reset();
  tracked->Pop();
  state_->window.GetShaderCache()->ReleaseCurrentShader();
}

unsigned
ScopedGlState::getFramebuffer() const
{
  return static_cast<unsigned>(state_->draw_framebuffer);
}

} // namespace pcl_uvol
