// SPDX-License-Identifier: BSD-3-Clause
// Isopoints on edges, and what fits make of them.
#pragma once

#include "isopoint_setup.h"
#include "src/isosurface/smooth_roots.h"

#include <vector>

namespace uvol_test {

/** \brief Linear isopoints, and what fits make of them. */
struct Roots {
  std::vector<pcl_uvol::PointIso> linear, points;
  pcl_uvol::IsoEdges edges;
  std::vector<pcl_uvol::RootFit> fits;

  Roots(const FieldSamples& field,
        float isovalue,
        pcl_uvol::Outside outside = pcl_uvol::Outside::Lower)
  {
    const pcl_uvol::IsopointInput input =
        field.input(outside, pcl_uvol::Interpolation::Fit);
    pcl_uvol::Report report;
    pcl_uvol::SurfaceTally tally;
    const auto crossing = input.candidates.findCrossing(input.ranges, isovalue, 1);
    for (const pcl_uvol::EdgeKey key :
         findEdges(input, crossing, isovalue, tally, report)) {
      linear.emplace_back();
      edges.emplace_back();
      placeIsopoint(input, key, isovalue, linear.back(), edges.back());
    }
    points = linear;
    pcl_uvol::StepTimer step(report, "roots");
    fits = fitRoots(input, isovalue, edges, points, step);
  }
};

inline Eigen::Vector3d
positionOf(const pcl_uvol::PointIso& point)
{
  return point.getVector3fMap().cast<double>();
}

} // namespace uvol_test
