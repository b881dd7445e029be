// SPDX-License-Identifier: BSD-3-Clause
// Rims of a mesh in opposite faces of a box that repeats, made images of one another.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A vertex of a mesh whose rims are matched. */
struct RimVertex {
  Eigen::Vector3d place;
  double reach;    ///< how far apart images of one another may be found
  double isovalue; ///< that of its image
  /** Bits of other faces that it lies in as well: that of its image. */
  unsigned corner;
};

/** \brief Two faces across an axis. */
struct OppositeFaces {
  std::size_t axis;
  double low, high; ///< coordinates that vertices in them have exactly
};

/** \brief A mesh whose rims in opposite faces have been matched. */
struct MatchedRims {
  /** Where its vertices lie between vertices of the mesh before, as PlaneCut has them.
   */
  IsoEdges vertices;
  std::vector<Triangle> triangles;
  /** Vertices in the low face, and those in the high one that must be moved onto their
   * images: they have the same source. */
  std::vector<std::pair<std::uint32_t, std::uint32_t>> images;
};

/** \brief Split the edges of rims in opposite faces where the rim across has a vertex,
 * so that both have the same vertices; the rim in the low face keeps its shape. A
 * vertex near one of the other rim becomes its image instead.
 *
 * What has no counterpart is left as it is: a rim whose image is missing, or which runs
 * elsewhere by more than the reach of its vertices.
 *
 * \param triangles of an oriented manifold */
PCL_UVOL_EXPORTS MatchedRims
matchRims(const std::vector<RimVertex>& vertices,
          const OppositeFaces& faces,
          std::vector<Triangle> triangles);

} // namespace pcl_uvol::detail
