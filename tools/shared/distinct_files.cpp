// SPDX-License-Identifier: BSD-3-Clause
// Files that a tool reads and writes, compared by what they are, not by their names.
#include "shared/options.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <sys/stat.h>

namespace uvol_tools {

namespace {

bool
isSameFile(const std::string& a, const std::string& b)
{
  struct stat status_a {
  }, status_b{};
  const bool a_exists = ::stat(a.c_str(), &status_a) == 0,
             b_exists = ::stat(b.c_str(), &status_b) == 0;
  if (a_exists && b_exists)
    return status_a.st_dev == status_b.st_dev && status_a.st_ino == status_b.st_ino;
  return pcl_uvol::resolveLinks(a) == pcl_uvol::resolveLinks(b);
}

} // namespace

void
checkDistinct(const std::vector<std::string>& inputs,
              const std::vector<std::string>& outputs)
{
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    const auto is_same = [&](const std::string& other) {
      return isSameFile(*output, other);
    };
    if (std::any_of(inputs.begin(), inputs.end(), is_same))
      throw UsageError("'" + *output +
                       "' would be read and written: give the output another name.");
    if (std::any_of(outputs.begin(), output, is_same))
      throw UsageError("'" + *output +
                       "' would be written twice: give the outputs different names.");
  }
}

} // namespace uvol_tools
