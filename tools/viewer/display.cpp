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
  const char* const name = std::getenv("DISPLAY");
  if (name == nullptr || *name == '\0')
    throw pcl_uvol::GlError("no_display", {});
  Display* const display = XOpenDisplay(nullptr);
  if (display == nullptr)
    throw pcl_uvol::GlError("display_not_opened", {{"display", std::string(name)}});
  int opcode, event, error;
  const bool has_opengl = XQueryExtension(display, "GLX", &opcode, &event, &error) != 0;
  XCloseDisplay(display);
  if (!has_opengl)
    throw pcl_uvol::GlError("display_without_opengl", {{"display", std::string(name)}});
}

} // namespace uvol_tools
