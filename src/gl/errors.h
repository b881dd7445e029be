// SPDX-License-Identifier: BSD-3-Clause
// What OpenGL has to complain about.
#pragma once

#include "gl/functions.h"

#include <string>

namespace pcl_uvol {

/** \brief Forget the errors of others who use the context. */
void
forgetErrors(const GlFunctions& gl);

/** \param less what to use less of, such as "fewer cells"
 * \param instead what does without OpenGL
 * \throws GlError if there is an error */
void
checkErrors(const GlFunctions& gl, const std::string& less, const std::string& instead);

} // namespace pcl_uvol
