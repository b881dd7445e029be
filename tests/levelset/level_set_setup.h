// SPDX-License-Identifier: BSD-3-Clause
// What the tests of level sets share: a ball of random samples, a run on it.
#pragma once

#include "support/environment.h"
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <pcl/point_types.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace uvol_test {

using LevelSetCloud = pcl::PointCloud<pcl::PointXYZI>;
using Evolution = pcl_uvol::LevelSetEvolution<pcl::PointXYZI>;

/** Random samples of spacing 1 in a cube about the origin; intensity: radius minus the
 * distance to it. */
inline LevelSetCloud::Ptr
makeBall(double radius, double extent, std::uint64_t seed = 1)
{
  Random random(seed);
  LevelSetCloud::Ptr cloud(new LevelSetCloud);
  const auto n = static_cast<std::size_t>(std::pow(2.0 * extent, 3));
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(extent * (2.0 * random.uniform() - 1.0));
    point.intensity = static_cast<float>(radius) - point.getVector3fMap().norm();
    cloud->push_back(point);
  }
  return cloud;
}

inline LevelSetCloud::Ptr
withValues(const LevelSetCloud& cloud, const std::vector<float>& values)
{
  LevelSetCloud::Ptr other(new LevelSetCloud(cloud));
  for (std::size_t i = 0; i < values.size(); ++i)
    (*other)[i].intensity = values[i];
  return other;
}

inline std::vector<float>
evolve(Evolution& evolution, const LevelSetCloud::Ptr& cloud, double isovalue = 0.0)
{
  evolution.setInputCloud(cloud);
  evolution.setIsoValue(isovalue);
  std::vector<float> phi;
  evolution.evolve(phi);
  return phi;
}

} // namespace uvol_test
