// SPDX-License-Identifier: BSD-3-Clause
#include "gl/shared_library.h"

#include "gl/context.h"

#include <dlfcn.h>

namespace pcl_uvol {

SharedLibrary::SharedLibrary(const std::vector<std::string>& names,
                             const std::string& advice)
{
  for (const std::string& name : names) {
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) {
      name_ = name;
      return;
    }
  }
  throw GlError("gl_library_not_loaded",
                {{"library", names.front()}, {"advice", advice}});
}

void*
SharedLibrary::find(const char* name) const
{
  void* const symbol = dlsym(handle_, name);
  if (symbol == nullptr)
    throw GlError("gl_library_without_function",
                  {{"library", name_}, {"function", name}});
  return symbol;
}

} // namespace pcl_uvol
