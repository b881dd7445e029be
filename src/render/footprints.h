// SPDX-License-Identifier: BSD-3-Clause
// How large the disc of a point must be so that the discs of all points leave no hole.
#pragma once

#include <pcl_uvol/common/report.h>
#include <pcl_uvol/neighbors/sample_set.h>
#include <pcl_uvol/render/surface_cloud.h>

#include <vector>

namespace pcl_uvol {

/** \brief Radii of the discs of every point, in leaf order. */
struct Footprints {
  /** Distance to the farthest corner of the point's Voronoi cell among its neighbours
   * in its tangent plane: discs of that size, and no smaller ones, cover a plane. */
  std::vector<float> radii;
  /** The same for those corners only for which the point is the first of the three
   * points around: each hole has one such disc, which leaves a part of it open. */
  std::vector<float> fillers;
};

/** \brief Corners at infinity or beyond the rim of a surface do not count, and outliers
 * get at most three times what their nearest neighbour has.
 * \param two_sided normals have no meaningful sign; else points that look to the other
 * side are no neighbours */
Footprints
computeFootprints(const SampleSet& samples,
                  const std::vector<PackedNormal>& normals,
                  bool two_sided,
                  unsigned threads,
                  Report& report);

} // namespace pcl_uvol
