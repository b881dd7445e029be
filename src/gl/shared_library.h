// SPDX-License-Identifier: BSD-3-Clause
// Libraries that are loaded when they are needed, and may be missing.
#pragma once

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The first of some libraries that can be loaded. Its names stay invisible to
 * others, as another GL may be in the process, and it is never unloaded: drivers leave
 * threads and handlers behind. */
class SharedLibrary {
public:
  /** \param advice what to do if there is none, a part of a sentence
   * \throws GlError if none can be loaded */
  SharedLibrary(const std::vector<std::string>& names, const std::string& advice);

  /** \brief A function by its name and type.
   * \throws GlError if it is missing */
  template <typename Function>
  void
  load(const char* name, Function& function) const
  {
    function = reinterpret_cast<Function>(find(name));
  }

private:
  void*
  find(const char* name) const;

  std::string name_;
  void* handle_ = nullptr;
};

} // namespace pcl_uvol
