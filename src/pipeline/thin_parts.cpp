// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/thin_parts.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pcl_uvol {

namespace {

/** The mean normal around a sample, where the normals cancel. */
constexpr float short_mean = 0.5f;

} // namespace

std::vector<std::uint8_t>
findThinParts(const pcl::PointCloud<PointIso>& isopoints, const IsoEdges& edges)
{
  std::vector<std::uint8_t> is_thin(isopoints.size(), 0);
  std::vector<std::pair<std::uint32_t, std::size_t>> ends; // samples, isopoints
  for (std::size_t first = 0, last = 0; first < isopoints.size(); first = last) {
    ends.clear();
    for (; last < isopoints.size() &&
           isopoints[last].isovalue == isopoints[first].isovalue;
         ++last) {
      ends.emplace_back(edges[last].first, last);
      ends.emplace_back(edges[last].second, last);
    }
    std::sort(ends.begin(), ends.end());
    for (auto begin = ends.begin(), end = begin; begin != ends.end(); begin = end) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (; end != ends.end() && end->first == begin->first; ++end)
        sum += isopoints[end->second].getNormalVector3fMap();
      if (sum.norm() < short_mean * static_cast<float>(end - begin))
        for (auto it = begin; it != end; ++it)
          is_thin[it->second] = 1;
    }
  }
  return is_thin;
}

} // namespace pcl_uvol
