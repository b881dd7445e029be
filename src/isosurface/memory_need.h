// SPDX-License-Identifier: BSD-3-Clause
// Bytes of isosurfaces besides the cloud, at their peak: enough where surfaces are not
// larger than usual (tests/tools/test_memory_forecast.cpp measures them).
#pragma once

#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cmath>
#include <cstddef>

namespace pcl_uvol {

/** \brief About how many isopoints a surface has. Of N samples c N^(2/3) edges cross
 * it: c is 3.4 for a torus, 4.7 for a sphere, 13 for a gyroid of three periods. */
inline double
usualIsopoints(double samples)
{
  return 5.0 * std::pow(samples, 2.0 / 3.0);
}

/** \brief About how many samples are an end of one of these edges. */
inline double
usualCrossing(double samples)
{
  return 1.35 * usualIsopoints(samples);
}

/** \brief Of IsosurfaceExtraction: 68 bytes per sample for the tree and the values in
 * its order; the isopoints of one isovalue are sorted and joined with those before. */
inline double
isosurfaceBytes(double samples, std::size_t isovalues)
{
  constexpr double sorted = 200.0, joined = 116.0; // bytes of an isopoint
  return 68.0 * samples +
         (sorted + joined * static_cast<double>(isovalues)) * usualIsopoints(samples);
}

/** \brief Of a surface that is joined with the fields of its samples: an isopoint and
 * its edge, and three times the isopoint while it gets the fields of its choice and is
 * joined (of a gyroid with 34 fields: 161 MB for 399,000 isopoints, 170 by this).
 * \param point_step bytes of a sample */
inline double
surfaceFieldsBytes(double isopoints, double point_step)
{
  return (4.0 * sizeof(PointIso) + sizeof(IsoEdge) + point_step) * isopoints;
}

} // namespace pcl_uvol
