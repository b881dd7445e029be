// SPDX-License-Identifier: BSD-3-Clause
// A convex polyhedron that is cut by planes, for Voronoi cells. Its faces are polygons
// of their own: cutting never has to find its way from face to face, so that no
// rounding can break it, whatever the planes have in common.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The polyhedron. */
class ConvexCell {
public:
  /** Tag of the faces of the cube that a cell starts as. */
  static constexpr int no_tag = -1;

  struct Face {
    int tag;                               ///< of the plane
    std::vector<Eigen::Vector3d> vertices; ///< counterclockwise, seen from outside;
                                           ///< some may coincide
  };

  /** \brief Become a cube about the origin. */
  void
  start(double half_side);

  /** \brief Become a copy. */
  void
  start(const ConvexCell& other);

  /** \brief Keep what lies where normal . x <= offset.
   * \return false if that is all there was, but for rounding */
  bool
  cut(const Eigen::Vector3d& normal, double offset, int tag);

  /** \brief Faces. @{ */
  std::size_t
  size() const
  {
    return count_;
  }

  const Face&
  operator[](std::size_t face) const
  {
    return faces_[face];
  }
  /** @} */

  double
  getVolume() const;

private:
  bool
  cutFace(Face& face, const double* heights, double tolerance);

  void
  closeBy(const Eigen::Vector3d& normal, int tag);

  Face&
  addFace(int tag);

  std::size_t count_ = 0;
  std::vector<Face> faces_;     ///< those behind the last keep their memory
  double extent_ = 0.0;         ///< no vertex is farther from the origin
  std::vector<double> heights_; ///< of vertices over a plane
  std::vector<Eigen::Vector3d> rest_, rim_;
  std::vector<std::pair<double, std::size_t>> angles_;
};

/** \brief Area of a polygon, and its centroid. */
struct PolygonMoments {
  double area;
  Eigen::Vector3d centroid;
};

PolygonMoments
computeMoments(const std::vector<Eigen::Vector3d>& polygon);

} // namespace pcl_uvol::detail
