// SPDX-License-Identifier: BSD-3-Clause
// Surfaces given as random points with normals: what pictures are drawn of.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>

namespace uvol_test {

using SurfaceCloudPtr = pcl::PointCloud<pcl::PointNormal>::Ptr;

/** \brief Uniformly random points on the unit sphere. */
SurfaceCloudPtr
makeSphere(std::size_t n, std::uint64_t seed);

/** \brief Random points on a bumpy tube along a (2, 3) torus knot, which fits into a
 * ball of radius 3. */
SurfaceCloudPtr
makeTorusKnot(std::size_t n, std::uint64_t seed);

/** \brief Points of the same surface at equal steps of its parameters, those around the
 * tube one after the other: vertices of a mesh. */
SurfaceCloudPtr
makeKnotLattice(std::size_t along, std::size_t around);

/** \brief Random points on a wavy square of side 2, open at its rims. */
SurfaceCloudPtr
makeWaves(std::size_t n, std::uint64_t seed);

/** \brief All points of the first cloud, then all of the second one. */
SurfaceCloudPtr
joined(const pcl::PointCloud<pcl::PointNormal>& first,
       const pcl::PointCloud<pcl::PointNormal>& second);

} // namespace uvol_test
