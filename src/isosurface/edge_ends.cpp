// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/edge_ends.h"

#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <limits>
#include <string>

namespace pcl_uvol {

EdgeEnds
findEdgeEnds(const std::vector<std::vector<GlobalIsopoint>>& isopoints)
{
  EdgeEnds ends;
  auto& points = ends.points;
  for (const auto& part : isopoints)
    for (const GlobalIsopoint& isopoint : part) {
      points.push_back(isopoint.first);
      points.push_back(isopoint.second);
    }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() > std::numeric_limits<std::uint32_t>::max())
    throw InvalidArgument("edge_ends_beyond_numbers", {{"points", points.size()}});
  const auto find_index = [&](std::uint64_t point) {
    return static_cast<std::uint32_t>(
        std::lower_bound(points.begin(), points.end(), point) - points.begin());
  };
  for (const auto& part : isopoints)
    for (const GlobalIsopoint& isopoint : part)
      ends.edges.push_back(
          {find_index(isopoint.first), find_index(isopoint.second), isopoint.t});
  return ends;
}

} // namespace pcl_uvol
