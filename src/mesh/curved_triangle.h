// SPDX-License-Identifier: BSD-3-Clause
// Integrals over a triangle that is bent as the normals of its corners tell, and over
// the space between it and a centre.
#pragma once

#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <array>

namespace pcl_uvol::detail {

/** \brief A point of a triangle that stands for a part of it. */
struct QuadraturePoint {
  std::array<double, 3> lambda; ///< weights of the corners
  double weight;                ///< all together 1
};

/** \brief A rule that integrates polynomials of degree 4 exactly (Dunavant 1985), and
 * with it the volume below quadratic triangles. */
PCL_UVOL_EXPORTS const std::array<QuadraturePoint, 6>&
triangleQuadrature();

/** \brief A corner of a triangle. */
struct SurfaceCorner {
  Eigen::Vector3d place;
  Eigen::Vector3d normal; ///< of unit length; 0: none
  bool is_on_cap = false; ///< a triangle with such a corner closes the samples' box
};

/** \brief Whether a triangle closes the samples' box. */
PCL_UVOL_EXPORTS bool
isOnCap(const std::array<SurfaceCorner, 3>& corners);

/** \brief Integrals over a surface, and over what it encloses: of 1, of the place and
 * of the products of coordinates. Places are those relative to a centre. */
struct PCL_UVOL_EXPORTS SurfaceIntegrals {
  double area = 0.0;
  Eigen::Vector3d area_moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d area_products = Eigen::Matrix3d::Zero();
  /** Over the cone between the surface and the centre, negative where the surface looks
   * to the centre: over the enclosed space once the surface is closed. @{ */
  double volume = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  /** @} */
  /** The integrals of z times the z of the normal, and of this z alone: with them a
   * surface that a box cuts can be closed, see BoxClosure. shifted() leaves them. @{ */
  double below = 0.0, flux = 0.0;
  /** @} */
  /** Whether moment and products are those of the enclosed space. */
  bool is_solid = true;
  /** What bending leaves out, about. @{ */
  double area_error = 0.0, volume_error = 0.0;
  /** @} */
  /** Of pieces whose samples do not determine area and volume: errors besides, which
   * are no reason to take a cavity for flat. @{ */
  double undetermined_area = 0.0, undetermined_volume = 0.0;
  /** @} */

  /** \brief Add another surface, whose places are relative to the same centre.
   * \param part of it that counts */
  void
  add(const SurfaceIntegrals& other, double part = 1.0);

  /** \brief The same relative to another centre.
   * \param offset from that one to this one */
  SurfaceIntegrals
  shifted(const Eigen::Vector3d& offset) const;
};

/** \brief Normals of the planes that the edges of a triangle stay in. */
using EdgePlanes = std::array<Eigen::Vector3d, 3>;

inline EdgePlanes
freeEdges()
{
  return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
}

/** \brief A triangle with quadratic edges.
 *
 * An edge e between corners with normals n, m goes through the middle of an arc: above
 * the middle of the edge, along n + m, by |e| / 2 tan(t / 4) where the sine of t / 2 is
 * e (m - n) / (2 |e|). To first order that is the middle of the edge of a PN triangle
 * (Vlachos et al. 2001); on circles it is exact. It depends on the two corners alone,
 * so that triangles fit together without gaps. Edges stay straight where the normals
 * are no help: without one, farther apart than 60 degrees, and more than 45 degrees off
 * the right angle to the edge. A triangle of a cap is flat, and the edge between it and
 * the surface bends within its plane, by the parts of the normals there. */
class PCL_UVOL_EXPORTS CurvedTriangle {
public:
  /** \param corners counter-clockwise as seen from outside
   * \param center that places are to be relative to
   * \param planes unit normals of those that the edges opposite of the corners stay in;
   * 0: none */
  CurvedTriangle(const std::array<SurfaceCorner, 3>& corners,
                 const Eigen::Vector3d& center,
                 const EdgePlanes& planes = freeEdges());

  /** \brief Integrals over the bent triangle.
   * \param[out] shares of the area that the corners have: linear functions with their
   * values there integrate to the sum of these times shares */
  SurfaceIntegrals
  integrate(std::array<double, 3>& shares) const;

  /** \brief Integrals over the flat triangle; its errors are the difference to the bent
   * one.
   * \param[out] shares as above */
  SurfaceIntegrals
  integrateFlat(std::array<double, 3>& shares) const;

  /** \brief From the middle of the edge opposite of a corner to the bent edge. */
  Eigen::Vector3d
  getBulge(std::size_t corner) const
  {
    return bent_[3 + corner] - flat_[3 + corner];
  }

private:
  using Nodes = std::array<Eigen::Vector3d, 6>; // corners, then the middle of the edge
                                                // opposite to each of them

  static SurfaceIntegrals
  integrate(const Nodes& nodes, std::array<double, 3>& shares);

  Nodes flat_, bent_;
  double sq_turn_ = 0.0; // of normals along an edge that is bent, squared, at most
};

} // namespace pcl_uvol::detail
