// SPDX-License-Identifier: BSD-3-Clause
// Errors of isopoints on edges: how far these deviate from a smooth surface.
#pragma once

#include "pipeline/isopoint_search.h"
#include "pipeline/stretched_edges.h"
#include <pcl_uvol/common/point_types.h>

#include <Eigen/Core>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Tells how far isopoints of one isovalue that rest on their edges alone lie
 * from the surface, one after another; one object per thread.
 *
 * Such an isopoint is somewhere on its edge, which is all that its edge tells. Where
 * the field is smooth it is far better than that: linear roots deviate by as much as
 * the field bends along their edges, and by another amount on each edge. How much shows
 * in the residuals of the isopoints around from a paraboloid through them. It does not
 * show where values jump, as those of rock types do: all roots may be equally wrong
 * there. */
class EdgeErrorFinder {
public:
  /** \param places isopoints to search among, in the stretched space
   * \param isopoints where they lie, and all others
   * \param edges of all isopoints
   *
   * All three must outlive the finder. */
  EdgeErrorFinder(const SampleSet& places,
                  const pcl::PointCloud<PointIso>& isopoints,
                  const StretchedEdges& edges);

  /** \return the error in the unit of the input, above nine in ten deviations; infinite
   * where the isopoints around do not tell */
  float
  find(std::size_t isopoint);

private:
  Eigen::Vector3d
  stretch(const PointIso& point) const;

  bool
  valuesJump(const std::vector<std::uint32_t>& around) const;

  const SampleSet& places_;
  const pcl::PointCloud<PointIso>& isopoints_;
  const StretchedEdges& edges_;
  IsopointSearch search_;
};

} // namespace pcl_uvol
