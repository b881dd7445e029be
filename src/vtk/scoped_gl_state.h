// SPDX-License-Identifier: BSD-3-Clause
// OpenGL that VTK does not know of, in VTK's window.
#pragma once

#include "gl/context.h"

#include <memory>

class vtkOpenGLRenderWindow;

namespace pcl_uvol {

/** \brief The context of a window, which must be current.
 * \throws GlError without one */
std::shared_ptr<GlContext>
wrapContext(vtkOpenGLRenderWindow& window);

/** \brief While it lives somebody else draws; afterwards VTK finds the state that it
 * left. */
class ScopedGlState {
public:
  ScopedGlState(vtkOpenGLRenderWindow& window, const GlContext& context);
  ScopedGlState(const ScopedGlState&) = delete;
  ScopedGlState&
  operator=(const ScopedGlState&) = delete;
  ~ScopedGlState();

  /** \brief Name of the framebuffer that VTK draws into. */
  unsigned
  getFramebuffer() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pcl_uvol
