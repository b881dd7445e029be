// SPDX-License-Identifier: BSD-3-Clause
// Isopoints that the samples around them contradict: all of the nearest samples are on
// one side of the isovalue.
#pragma once

#include "isosurface/isopoints.h"
#include "neighbors/nearest_finder.h"
#include <pcl_uvol/common/point_types.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Finds isopoints whose nearest samples are all on one side of the isovalue;
 * one object per thread.
 *
 * The surface crosses each edge somewhere. On an edge that reaches across a gap, or
 * past other samples, the linear root may be far from there: between two casts 2 km
 * apart, on an edge from 80 m down to 480 m, it is at 300 m, where both casts are on
 * one side of the isovalue. */
class OneSidedTest {
public:
  /** \param input must outlive the test */
  OneSidedTest(const IsopointInput& input, float isovalue);

  /** \brief Whether samples contradict an isopoint: it is bridged, its error is not
   * below half of its edge, and the samples nearest to the linear root of its edge are
   * all on one side.
   * \param reach is raised to the distance of these samples from the root, in the
   * stretched space */
  bool
  contradicts(const PointIso& point, const IsoEdge& edge, float& reach);

private:
  const IsopointInput& input_;
  float isovalue_;
  NearestFinder nearest_;
};

/** \brief Remove the isopoints of one isovalue that samples contradict.
 * \param tally gets the number of those
 * \param report gets it as "contradicted", unless it is 0 */
void
removeContradicted(const IsopointInput& input,
                   float isovalue,
                   std::vector<PointIso>& points,
                   IsoEdges& edges,
                   SurfaceTally& tally,
                   Report& report);

} // namespace pcl_uvol
