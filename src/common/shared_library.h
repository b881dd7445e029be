// SPDX-License-Identifier: BSD-3-Clause
// Libraries that are loaded when they are needed, and may be missing.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A library, or a function of one, is not there. */
class PCL_UVOL_EXPORTS MissingLibrary : public Exception {
  using Exception::Exception;
};

/** \brief The first of some libraries that can be loaded. Its names stay invisible to
 * others, as another GL may be in the process, and it is never unloaded: drivers leave
 * threads and handlers behind. */
class PCL_UVOL_EXPORTS SharedLibrary {
public:
  /** \param advice what to do if there is none, a part of a sentence
   * \throws MissingLibrary if none can be loaded */
  SharedLibrary(const std::vector<std::string>& names, const std::string& advice);

  /** \brief A function by its name and type.
   * \throws MissingLibrary */
  template <typename Function>
  void
  load(const char* name, Function& function) const
  {
    function = reinterpret_cast<Function>(find(name));
  }

private:
  void*
  find(const char* name) const;

  std::string name_, advice_;
  void* handle_ = nullptr;
};

} // namespace pcl_uvol
