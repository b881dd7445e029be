// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5_names.h"

#include "io/files.h"

#include <filesystem>
#include <system_error>

namespace pcl_uvol {
namespace io {

bool
isHdf5(const std::string& path)
{
  return InputFile(path).head(8) == "\x89HDF\r\n\x1a\n";
}

Hdf5Name
splitHdf5Name(const std::string& path)
{
  const std::size_t colon = path.find(":/");
  std::error_code ignored; // of names that no file can have
  if (colon == std::string::npos ||
      !std::filesystem::is_regular_file(path.substr(0, colon), ignored))
    return {path, ""};
  return {path.substr(0, colon), path.substr(colon + 1)};
}

} // namespace io
} // namespace pcl_uvol
