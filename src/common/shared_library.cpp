// SPDX-License-Identifier: BSD-3-Clause
#include "common/shared_library.h"

#include <dlfcn.h>

namespace pcl_uvol {

SharedLibrary::SharedLibrary(const std::vector<std::string>& names,
                             const std::string& advice)
    : advice_(advice)
{
  for (const std::string& name : names) {
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) {
      name_ = name;
      return;
    }
  }
  throw MissingLibrary("The library " + names.front() + " cannot be loaded: " + advice +
                       ".");
}

void*
SharedLibrary::find(const char* name) const
{
  void* const symbol = dlsym(handle_, name);
  if (symbol == nullptr)
    throw MissingLibrary("The library " + name_ + " has no function " + name + ": " +
                         advice_ + ".");
  return symbol;
}

} // namespace pcl_uvol
