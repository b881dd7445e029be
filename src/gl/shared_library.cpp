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
  throw GlError("The library " + names.front() + " cannot be loaded: " + advice + ".");
}

void*
SharedLibrary::find(const char* name) const
{
  void* const symbol = dlsym(handle_, name);
  if (symbol == nullptr)
    throw GlError("The library " + name_ + " has no function " + name +
                  ": install a complete one, or use the cpu backend.");
  return symbol;
}

} // namespace pcl_uvol
