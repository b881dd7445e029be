// SPDX-License-Identifier: BSD-3-Clause
// Bytes of a clustering besides the cloud, at its peak.
#pragma once

#include <algorithm>

namespace pcl_uvol {

/** \brief Of DensityClustering. Core distances reach to eight neighbours at least. */
inline double
clusteringBytes(double points, double attributes, double neighbors)
{
  return (60.0 + 12.0 * attributes + 8.0 * std::max(neighbors, 8.0)) * points;
}

} // namespace pcl_uvol
