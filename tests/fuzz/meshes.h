// SPDX-License-Identifier: BSD-3-Clause
// Closed meshes made of bytes, and what is promised of those that come out.
#pragma once

#include "promises.h"
#include "random_cloud.h"
#include <pcl_uvol/common/dataset.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace uvol_fuzz {

/** \brief A mesh without a rim. */
struct ClosedMesh {
  std::vector<pcl_uvol::Triangle> triangles;
  std::uint32_t vertices; ///< all of them are used
  std::uint32_t genus;
};

/** \brief A tetrahedron or a torus, of whose triangles some are divided in three. */
ClosedMesh
takeMesh(Bytes& bytes);

/** \brief Sides of triangles, each of which is as often one of others the other way
 * round.
 * \throws BrokenPromise */
void
requireNoRim(const std::vector<pcl_uvol::Triangle>& triangles, std::size_t vertices);

/** \brief The same where no side belongs to more than two triangles.
 * \throws BrokenPromise */
void
requireClosed(const std::vector<pcl_uvol::Triangle>& triangles, std::size_t vertices);

template <typename Points>
void
requireFinite(const Points& points)
{
  for (const auto& point : points)
    require(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z),
            "positions are finite");
}

} // namespace uvol_fuzz
