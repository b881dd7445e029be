// SPDX-License-Identifier: BSD-3-Clause
// Functions of libraries that may be missing.
#pragma once

#include "common/shared_library.h"
#include "gl/context.h"

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief An object that its constructor fills with the functions of a library.
 * \param libraries the first that can be loaded is taken
 * \param advice what to do if there is none, a part of a sentence
 * \throws GlError */
template <typename Functions>
Functions
loadFunctions(const std::vector<std::string>& libraries, const std::string& advice)
{
  try {
    return Functions(SharedLibrary(libraries, advice));
  }
  catch (const MissingLibrary& error) {
    throw GlError(error.message());
  }
}

} // namespace pcl_uvol
