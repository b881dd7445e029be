// SPDX-License-Identifier: BSD-3-Clause
// The hull of a cluster: its points, connected where their Voronoi regions meet on a
// surface around them (thesis 2.6, Figure 2.22).
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief A closed surface over the points of a cluster. */
struct ClusterHull {
  /** Region of every vertex: those that look to both sides of a thin sheet occur twice,
   * once for each connected piece of their region. */
  std::vector<std::uint32_t> regions;
  std::vector<Triangle> triangles;
  /** Pieces that were cut because they reach around a hole: what is left of a region
   * must be a disc. */
  std::uint32_t split_pieces = 0;
};

/** \brief Shrink every connected piece of a region on a surface to a vertex: a triangle
 * stands where three of them meet.
 *
 * A closed, oriented surface gives a closed, oriented one of the same genus; where two
 * pieces meet along several borders, so many edges connect them. Components of the
 * surface that hold fewer than three pieces leave nothing.
 * \param surface triangles of a closed surface, each edge in two of them
 * \param regions label of every vertex of the surface
 * \throws InvalidArgument for a triangle that names a vertex without a region */
PCL_UVOL_EXPORTS ClusterHull
makeClusterHull(const std::vector<Triangle>& surface,
                const std::vector<std::uint32_t>& regions);

} // namespace pcl_uvol
