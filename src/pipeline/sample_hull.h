// SPDX-License-Identifier: BSD-3-Clause
// What lies between samples, as opposed to around them.
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The convex hull of samples to within a tolerance: the sample that is farthest
 * outside of the hull so far becomes a corner of it (Barber, Dobkin and Huhdanpaa, The
 * quickhull algorithm for convex hulls, 1996).
 *
 * It grows from an octahedron of the size of the tolerance, so that samples on a plane
 * or a line have a hull as well. */
class PCL_UVOL_EXPORTS SampleHull {
public:
  /** \param tolerance above 0, in units of the samples: none of them lies farther
   * beyond a face */
  SampleHull(const SampleSet& samples, double tolerance);

  /** \brief Whether a place lies no farther than the tolerance beyond any face.
   * \param place in units of the samples, all of which do */
  bool
  contains(const Position& place) const;

private:
  struct Face {
    std::array<std::size_t, 3> corners; ///< counterclockwise from outside
    Eigen::Vector3d normal;             ///< a unit vector; zero without an area
    double height;
  };

  /** 0 inside. */
  double
  distanceBeyond(const Eigen::Vector3d& place) const;

  /** Takes places that lie farther beyond a face than the tolerance for corners. Of the
   * others those outside of the hull stay in the list: beside a sharp edge a face that
   * is added later may be farther from them.
   * \return whether there was such a place */
  bool
  growTo(std::vector<Eigen::Vector3d>& places);

  void
  addFace(std::size_t a, std::size_t b, std::size_t c);

  void
  addCorner(const Eigen::Vector3d& place);

  double tolerance_;
  std::vector<Eigen::Vector3d> corners_;
  std::vector<Face> faces_;
};

} // namespace pcl_uvol::detail
