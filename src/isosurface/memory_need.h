// SPDX-License-Identifier: BSD-3-Clause
// Bytes of isosurfaces besides the cloud, at their peak: enough where surfaces are not
// larger than usual (tests/tools/test_memory_forecast.cpp measures them).
#pragma once

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

} // namespace pcl_uvol
