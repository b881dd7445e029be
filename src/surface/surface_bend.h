// SPDX-License-Identifier: BSD-3-Clause
// How a surface bends about a point, in four bytes.
#pragma once

#include "surface/bend_scale.h"
#include "surface/packed_normal.h"
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <cstdint>

namespace pcl_uvol {

/** \brief By what the normal changes over a length: xx, xy and yy of a symmetric matrix
 * in the axes that tangentAxes() gives. */
using SurfaceBend = Eigen::Vector3f;

/** \brief A bend times the radius of a disc: three numbers of 10 bits with sign. 0 is
 * flat. */
using PackedBend = std::uint32_t;

/** \brief Two axes of the plane that a normal stands on, which kernels and shaders
 * choose alike. */
PCL_UVOL_EXPORTS Eigen::Matrix<float, 3, 2>
tangentAxes(PackedNormal normal);

/** \brief Pack a bend, reduced where it is more than most_bend. */
PCL_UVOL_EXPORTS PackedBend
packBend(const SurfaceBend& bend, float radius);

/** \brief The bend that the points around one show. */
class PCL_UVOL_EXPORTS BendFit {
public:
  /** \param near nearer neighbours weigh no more than those of that distance */
  explicit BendFit(float near)
      : sq_near_(near * near)
  {
  }

  /** \brief Take a neighbour.
   * \param offset of it in the plane
   * \param turn of the normal there, in the plane
   * \param height of it above the plane */
  void
  add(const Eigen::Vector2f& offset, const Eigen::Vector2f& turn, float height);

  /** \brief Least squares; zero where places and normals tell nothing, or each another
   * thing, as they do about an edge. */
  SurfaceBend
  solve() const;

private:
  void
  addEquation(const Eigen::Vector3f& row, float value, float weight);

  float sq_near_;
  Eigen::Matrix3f squares_ = Eigen::Matrix3f::Zero();
  Eigen::Vector3f products_ = Eigen::Vector3f::Zero();
  float sq_values_ = 0.0f;
};

} // namespace pcl_uvol
