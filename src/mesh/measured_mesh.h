// SPDX-License-Identifier: BSD-3-Clause
// Pieces of triangle meshes, and the integrals over them.
#pragma once

#include "common/scalar_names.h"
#include "mesh/box_closure.h"
#include "mesh/curved_triangle.h"
#include "mesh/surface_pieces.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Check that triangles name vertices that are there, and finite.
 * \throws InvalidArgument for a vertex that is not finite or not there */
PCL_UVOL_EXPORTS void
checkTriangles(const CloudView& vertices, const std::vector<Triangle>& triangles);

/** \brief A field of one number per vertex, if there is one of that name. */
std::optional<ScalarField>
findScalar(const CloudView& vertices, const char* name);

/** \brief The scalars of a surface, see listNamedScalars(), but for those that number
 * or qualify vertices instead of measuring something there. */
std::vector<NamedScalar>
listMeasuredFields(const std::vector<pcl::PCLPointField>& fields);

/** \brief A surface in pieces, and integrals over each. */
struct MeasuredSurface {
  PieceList list;
  std::vector<std::uint32_t> sources; ///< by vertex the one of the input that it is
  std::vector<SurfaceCorner> corners; ///< by vertex
  std::vector<Triangle> triangles;    ///< none of a surface that is given as points
  /** Sums for each piece; integrals are relative to the centre of its bounds. @{ */
  std::vector<Eigen::AlignedBox3d> bounds;
  std::vector<SurfaceIntegrals> integrals;
  /** @} */
  std::vector<double> shares; ///< by vertex, in the area
  /** Half the length of the edges at each vertex along which the surface ends, or meets
   * a cap, for each triangle beside them; empty of a surface that is given as points.
   */
  std::vector<double> rim_lengths;
  std::vector<double> cap_areas; ///< by piece; as above
  /** Closes the pieces that were cut at the faces of a periodic box; such a piece has
   * no rims in the faces, and no moments. */
  std::optional<BoxClosure> closure;
};

/** \brief The place of a point with its unit normal: 0 where that is not finite;
 * nothing for a cloud without normals. */
std::optional<std::vector<SurfaceCorner>>
readCorners(const CloudView& vertices);

/** \brief The boxes around the vertices of pieces. */
void
findBounds(MeasuredSurface& surface);

/** \brief Measure a mesh of manifold pieces. Vertices at which several fans of
 * triangles meet have a copy for each: see sources.
 *
 * \param vertices with normals, `cap` and `image_of`, if they have these fields
 *
 * \param box periodic box that the mesh was cut at; sides of 0: none
 *
 * \param curved bend triangles as the normals tell, if there are any
 *
 * \throws InvalidArgument for a vertex that is not finite or not there, without
 * triangles, and for triangles that are no oriented manifold */
MeasuredSurface
measureMesh(const CloudView& vertices,
            const std::vector<Triangle>& triangles,
            const PeriodicBox& box,
            bool curved);

} // namespace pcl_uvol::detail
