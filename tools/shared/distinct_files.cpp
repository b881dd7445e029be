// SPDX-License-Identifier: BSD-3-Clause
// Files that a tool reads and writes, compared by what they are, not by their names.
#include "shared/options.h"
#include <pcl_uvol/io/dataset.h>

#include <set>
#include <string>
#include <sys/stat.h>

namespace uvol_tools {

namespace {

/** What a file is; its name where it is not there. */
std::string
identify(const std::string& path)
{
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0)
    return std::to_string(status.st_dev) + ':' + std::to_string(status.st_ino);
  return '/' + pcl_uvol::resolveLinks(path);
}

} // namespace

void
checkDistinct(const std::vector<std::string>& inputs,
              const std::vector<std::string>& outputs)
{
  if (outputs.empty())
    return; // lists can be long
  std::set<std::string> read, written;
  for (const std::string& input : inputs) {
    read.insert(identify(input));
    for (const std::string& named : pcl_uvol::listNamedFiles(input))
      read.insert(identify(named));
  }
  for (const std::string& output : outputs) {
    const std::string file = identify(output);
    if (read.count(file) > 0)
      throw UsageError("'" + output +
                       "' would be read and written: give the output another name.");
    if (!written.insert(file).second)
      throw UsageError("'" + output +
                       "' would be written twice: give the outputs different names.");
  }
}

} // namespace uvol_tools
