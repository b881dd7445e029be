// SPDX-License-Identifier: BSD-3-Clause
#include "files.h"
#include "formats.h"

#include <limits>

namespace pcl_uvol {

std::optional<PromisedCloud>
promisedCloud(const std::string& path)
{
  const std::string ending = io::endingOf(path);
  std::optional<PromisedCloud> cloud;
  if (ending == ".pcd")
    cloud = io::promisePcd(path);
  else if (ending == ".ply")
    cloud = io::promisePly(path);
  // More than PCL can number: reading says so.
  if (cloud && cloud->points > std::numeric_limits<pcl::uindex_t>::max())
    return std::nullopt;
  return cloud;
}

} // namespace pcl_uvol
