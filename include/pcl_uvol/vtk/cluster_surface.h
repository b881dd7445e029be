// SPDX-License-Identifier: BSD-3-Clause
// Surfaces around clusters of points, from their distance fields (thesis 2.6, Figures
// 2.22 to 2.24).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/mesh.h>
#include <pcl_uvol/common/report.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief What encloses a cluster. */
enum class ClusterSurfaceKind {
  Distance,    ///< all places at one distance from its points (Figure 2.23 b)
  Hull,        ///< its outer points, connected by triangles (Figure 2.23 c)
  HullDistance ///< all places at one distance from its hull (Figure 2.23 d)
};

/** \brief How it is found. */
struct ClusterSurfaceSettings {
  /** Cells along the longest side of the box of all that lies within the distance. */
  std::uint32_t cells = 128;
  /** In units of the coordinates; 0 (default): the longest edge of the points' minimum
   * spanning tree and one cell, so that the surface is of one piece. */
  double distance = 0.0;
  /** Factors per axis, > 0: distances are measured in the stretched space. */
  std::array<float, 3> scale{{1.0f, 1.0f, 1.0f}};
  unsigned threads = 0;
};

/** \brief A closed mesh around a cluster. */
struct ClusterSurface {
  Mesh mesh;
  /** Index of the point that is a vertex, for a hull; else empty. */
  std::vector<std::uint32_t> points;
  double distance = 0.0; ///< that was used
};

/** \brief Enclose a cluster.
 * \param members indices of its points in the cloud; points that are not finite are
 * left out and counted as "non_finite"
 * \param report gets the counts "members", "vertices" and "triangles", warnings, times
 * \throws InvalidArgument for no finite member, a distance or scale that is not
 * finite or negative, a distance too small for the grid, one point without a distance,
 * too many cells, a hull of points that leave no triangle (fewer than three, or so) */
PCL_UVOL_EXPORTS ClusterSurface
makeClusterSurface(const CloudView& cloud,
                   const std::vector<std::uint32_t>& members,
                   ClusterSurfaceKind kind,
                   const ClusterSurfaceSettings& settings,
                   Report& report);

} // namespace pcl_uvol
