// SPDX-License-Identifier: BSD-3-Clause
// The tetrahedra of the Delaunay triangulation of samples that a new place among them
// would replace, and the volumes that its Voronoi cell takes from theirs.
#pragma once

#include "neighbors/simple_cell.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The hole that a place tears into the Delaunay triangulation: the tetrahedra
 * whose spheres it lies in. Their corners are the place's natural neighbours, and the
 * hole is bounded by the triangles that are dual to the vertices of its cell (Bowyer
 * and Watson 1981), so that it is filled from these triangles on without any
 * triangulation of all samples. One object per thread. */
class DelaunayCavity {
public:
  /** \brief Compute how much of the cells that samples have without the place belongs
   * to its cell.
   * \param cell of the place
   * \param ratios of each face: its area by the distance of its sample
   * \param volumes of each face
   * \return false if samples are not in general position, so that rounding decides what
   * the tetrahedra are */
  bool
  measure(const SimpleCell& cell, const double* ratios, double* volumes);

private:
  /** A triangle of samples with a tetrahedron on its back; the one in front, on the
   * side from which they go round counterclockwise, is not known yet. */
  struct Front {
    SimpleCell::Corner corners;
    Eigen::Vector3d center; ///< of the sphere of the tetrahedron on the back
  };

  void
  start(const SimpleCell& cell);

  void
  push(const Front& front, std::uint64_t key);

  /** Take a front away. */
  Front
  remove(std::size_t front);

  /** Find the tetrahedron in front of a triangle.
   * \return false if there is none */
  bool
  findTip(const Front& front, std::uint16_t& tip, Eigen::Vector3d& center);

  /** Close the triangle between two tetrahedra, or note that it has one. */
  bool
  addTriangle(std::uint16_t a,
              std::uint16_t b,
              std::uint16_t c,
              const Eigen::Vector3d& center,
              double* volumes);

  /** Add the parts that an edge of the Voronoi diagram, between the centres on both
   * sides of a triangle, has in the boundaries between the cells of its corners. */
  void
  addVoronoiEdge(const Front& front, const Eigen::Vector3d& center, double* volumes);

  const CellKernels* kernels_ = nullptr; ///< those of the cell
  std::size_t count_ = 0;
  std::vector<double> x_, y_, z_, limits_, distances_; ///< with cell_padding
  std::vector<Front> fronts_;
  std::vector<std::uint64_t> keys_; ///< of each: its corners in ascending order
};

} // namespace pcl_uvol::detail
