// SPDX-License-Identifier: BSD-3-Clause
// Bytes of a mesh besides the samples, at their peak.
#pragma once

namespace pcl_uvol {

/** \brief Of SurfaceMesh, beside the tree. A mesh has twice as many vertices as there
 * are isopoints before it is remeshed, each with two triangles, their neighbours and
 * the cells beside it.
 *
 * \param crossing samples beside the isosurface, see usualCrossing() */
constexpr double
meshBytes(double crossing)
{
  return 700.0 * crossing;
}

} // namespace pcl_uvol
