// SPDX-License-Identifier: BSD-3-Clause
#include "io/folder.h"

#include <cerrno>
#include <dirent.h>
#include <memory>
#include <new>

namespace pcl_uvol {
namespace io {

std::vector<std::string>
listFolder(const std::string& path)
{
  struct Closer {
    void
    operator()(DIR* folder) const
    {
      ::closedir(folder);
    }
  };
  const std::unique_ptr<DIR, Closer> folder(::opendir(path.c_str()));
  if (!folder && errno == ENOMEM)
    throw std::bad_alloc();
  std::vector<std::string> names;
  while (const dirent* const entry = folder ? ::readdir(folder.get()) : nullptr)
    if (const std::string name = entry->d_name; name != "." && name != "..")
      names.push_back(name);
  return names;
}

} // namespace io
} // namespace pcl_uvol
