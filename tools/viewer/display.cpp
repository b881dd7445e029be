// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/display.h"

#include "gl/context.h"

#include <X11/Xlib.h>
#include <cstdlib>
#include <string>

namespace uvol_tools {

void
checkDisplay()
{
  const std::string advice = ": uvol_render draws pictures without one.";
  const char* const name = std::getenv("DISPLAY");
  if (name == nullptr || *name == '\0')
    throw pcl_uvol::GlError("There is no display (DISPLAY is not set)" + advice);
  Display* const display = XOpenDisplay(nullptr);
  if (display == nullptr)
    throw pcl_uvol::GlError("The display " + std::string(name) + " cannot be opened" +
                            advice);
  int opcode, event, error;
  const bool has_opengl = XQueryExtension(display, "GLX", &opcode, &event, &error) != 0;
  XCloseDisplay(display);
  if (!has_opengl)
    throw pcl_uvol::GlError("The display " + std::string(name) + " has no OpenGL" +
                            advice);
}

} // namespace uvol_tools
