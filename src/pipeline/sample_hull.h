// SPDX-License-Identifier: BSD-3-Clause
// What lies between samples, as opposed to around them.
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The convex hull of samples and the places that are no farther from it than a
 * reach: the sample that is farthest outside of the hull so far becomes a corner of it
 * (Barber, Dobkin and Huhdanpaa, The quickhull algorithm for convex hulls, 1996).
 *
 * It grows from a small octahedron about the mean of the samples, so that samples on a
 * plane or a line have a hull as well. */
class PCL_UVOL_EXPORTS SampleHull {
public:
  /** \param reach above 0, in units of the samples */
  SampleHull(const SampleSet& samples, double reach);

  /** \brief Whether a place is near the hull: no place farther from it than the reach
   * is near, and all places in it are.
   *
   * \param place in units of the samples */
  bool
  contains(const Position& place) const;

private:
  struct Face {
    Triangle corners;       ///< counterclockwise from outside
    Eigen::Vector3d normal; ///< a unit vector; zero without an area
    double height;
  };

  /** The distance from the faces; 0 inside. */
  double
  distanceBeyond(const Eigen::Vector3d& place) const;

  /** Takes places that are farther outside than the tolerance for corners. Of the
   * others those outside of the hull stay in the list: next to a sharp edge a face that
   * is added later may be farther from them.
   * \return whether there was such a place */
  bool
  growTo(std::vector<Eigen::Vector3d>& places);

  void
  addFace(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  void
  addCorner(const Eigen::Vector3d& place);

  double tolerance_; ///< no sample is farther outside of the faces
  std::vector<Eigen::Vector3d> corners_;
  std::vector<Face> faces_;
};

} // namespace pcl_uvol::detail
