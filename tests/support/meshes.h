// SPDX-License-Identifier: BSD-3-Clause
// What is true of a closed mesh, and how far places are from one.
#pragma once

#include <pcl_uvol/common/dataset.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace uvol_test {

/** \brief With the origin of the mesh. */
Eigen::Vector3d
vertexOf(const pcl_uvol::Mesh& mesh, std::uint32_t vertex);

/** \brief Every edge is walked as often in one direction as in the other one, and none
 * begins where it ends. */
bool
isClosed(const std::vector<pcl_uvol::Triangle>& triangles);

/** \brief Positive for a closed mesh whose triangles look outwards. */
double
signedVolume(const pcl_uvol::Mesh& mesh);

/** \brief To the nearest triangle, by trying all. */
double
distanceToTriangles(const pcl_uvol::Mesh& mesh, const Eigen::Vector3d& place);

} // namespace uvol_test
