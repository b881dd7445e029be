// SPDX-License-Identifier: BSD-3-Clause
// Bytes of normals and splats besides the cloud, at their peak.
#pragma once

#include <algorithm>

namespace pcl_uvol {

/** \brief Of SurfaceNormalEstimation with k neighbours. */
inline double
surfaceNormalsBytes(double points, double k)
{
  return (96.0 + 4.0 * k) * points;
}

/** \brief Of SplatGeneration, if every point gets a splat; normals that are missing are
 * estimated before. */
inline double
splatsBytes(double points)
{
  return std::max(304.0 * points, surfaceNormalsBytes(points, 30.0));
}

/** \brief Of the discs that pictures draw at points. */
inline double
footprintsBytes(double points)
{
  return 174.0 * points;
}

} // namespace pcl_uvol
