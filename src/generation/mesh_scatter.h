// SPDX-License-Identifier: BSD-3-Clause
// Points spread over a mesh: test data for everything that takes surfaces.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief A point on a mesh, relative to its origin, and the normal of its triangle. */
struct MeshPoint {
  std::array<float, 3> position, normal;
};

/** \brief Points spread evenly by area: one in every n-th part of it, at a place that
 * depends on seed and index only.
 * \throws InvalidArgument for a mesh without area */
PCL_UVOL_EXPORTS std::vector<MeshPoint>
scatterOverMesh(const Mesh& mesh, std::uint64_t n, std::uint64_t seed);

} // namespace pcl_uvol
