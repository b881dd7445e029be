// SPDX-License-Identifier: BSD-3-Clause
// Is there a display? In a file of its own, as X11's headers define many words.
#pragma once

namespace uvol_tools {

/** \brief VTK ends the program where it cannot open a window, so ask before.
 * \throws pcl_uvol::GlError unless there is a display with OpenGL, in one sentence that
 * names uvol_render */
void
checkDisplay();

} // namespace uvol_tools
