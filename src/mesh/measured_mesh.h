// SPDX-License-Identifier: BSD-3-Clause
// A triangle mesh with what it takes to measure it: normals, pieces, bounds.
#pragma once

#include "common/scalar_field.h"
#include "mesh/curved_triangle.h"
#include "mesh/surface_pieces.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/mesh.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief \throws InvalidArgument for a vertex that is not finite or not there */
void
checkTriangles(const CloudView& vertices, const std::vector<Triangle>& triangles);

/** \brief A field of one number per vertex, if there is one of that name. */
std::optional<ScalarField>
findScalar(const CloudView& vertices, const char* name);

/** \brief The scalars of a surface, see listScalars(), but for those that number or
 * qualify vertices instead of measuring something there. */
std::vector<std::string>
listMeasuredFields(const std::vector<pcl::PCLPointField>& fields);

/** \brief A mesh of manifold pieces. Vertices at which several fans of triangles meet
 * have a copy for each: see getSources(). */
class MeasuredMesh {
public:
  /** \param vertices with normals and `cap`, if they have these fields
   * \throws InvalidArgument for a vertex that is not finite or not there, without
   * triangles, and for triangles that are no oriented manifold */
  MeasuredMesh(const CloudView& vertices, const std::vector<Triangle>& triangles);

  const PieceList&
  getPieces() const
  {
    return list_;
  }

  const std::vector<Triangle>&
  getTriangles() const
  {
    return triangles_;
  }

  /** \brief By vertex the one of the input that it is. */
  const std::vector<std::uint32_t>&
  getSources() const
  {
    return sources_;
  }

  const std::vector<SurfaceCorner>&
  getCorners() const
  {
    return corners_;
  }

  /** \brief Whether the input has normals; those of triangles stand in for them. */
  bool
  hasNormals() const
  {
    return has_normals_;
  }

  const Eigen::AlignedBox3d&
  getBounds(std::size_t piece) const
  {
    return bounds_[piece];
  }

  /** \brief Integrals over every piece, relative to the centre of its bounds.
   * \param curved bend triangles as their normals tell
   * \param[out] shares of the vertices in the area */
  std::vector<SurfaceIntegrals>
  integrate(bool curved, std::vector<double>& shares) const;

private:
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> sources_;
  PieceList list_;
  std::vector<SurfaceCorner> corners_;
  std::vector<Eigen::AlignedBox3d> bounds_;
  bool has_normals_ = false;
};

} // namespace pcl_uvol::detail
