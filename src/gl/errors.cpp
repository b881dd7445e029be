// SPDX-License-Identifier: BSD-3-Clause
#include "gl/errors.h"

namespace pcl_uvol {

void
forgetErrors(const GlFunctions& gl)
{
  constexpr int most_errors = 16; // a lost context has no end of them
  for (int i = 0; i < most_errors && gl.GetError() != GL_NO_ERROR; ++i) {
  }
}

void
checkErrors(const GlFunctions& gl, const std::string& less, const std::string& instead)
{
  const GLenum error = gl.GetError();
  if (error == GL_OUT_OF_MEMORY)
    throw GlError("gl_out_of_memory", {{"less", less}, {"instead", instead}});
  if (error != GL_NO_ERROR)
    throw GlError("gl_failed", {{"error", error}, {"instead", instead}});
}

} // namespace pcl_uvol
