// SPDX-License-Identifier: BSD-3-Clause
// What a mesh is made of: connected pieces, their handles and rims.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/mesh/surface_mesh.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The connected pieces of triangles. */
struct PieceList {
  std::vector<std::int32_t> of_vertex; ///< among pieces; -1 without a triangle
  std::vector<SurfacePiece> pieces;    ///< in the order of sortPieces(); isovalue 0
  std::size_t rim_edges = 0;           ///< of all pieces
};

/** \brief Put pieces in the order of falling numbers of triangles, or where there are
 * none of vertices, and equal ones in that of their first vertices. */
void
sortPieces(PieceList& list);

/** \brief Find the connected pieces of triangles.
 * \throws std::logic_error unless the triangles are an oriented manifold */
PCL_UVOL_EXPORTS PieceList
findPieces(std::vector<Triangle>& triangles, std::size_t vertices);

/** \brief Give every vertex whose triangles are several rounds or fans a copy for each
 * further one, as rims that touch in a point have.
 * \param source_of gets, behind the other vertices, the one that each copy is of
 * \return how many copies */
PCL_UVOL_EXPORTS std::size_t
splitPinchedVertices(std::vector<Triangle>& triangles,
                     std::size_t vertices,
                     std::vector<std::uint32_t>& source_of);

} // namespace pcl_uvol::detail
