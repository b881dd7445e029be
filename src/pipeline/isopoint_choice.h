// SPDX-License-Identifier: BSD-3-Clause
// Where isopoints lie and how they are oriented, one by one, by what the samples around
// them carry.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <pcl/point_cloud.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_uvol {

/** \brief Whether an isopoint lies on a fit, which has told its curvature. */
inline bool
hasFit(const PointIso& point)
{
  return !std::isnan(point.mean_curvature);
}

/** \brief How each isopoint came about. */
struct IsopointChoice {
  std::vector<IsoMethod> method;
  std::vector<IsoOrientation> orientation;
  std::vector<float> confidence; ///< empty where no gaps were to be filled

  /** \brief Leave only what filterIsopoints will leave. */
  template <typename Keep>
  void
  filter(const pcl::PointCloud<PointIso>& isopoints, const Keep& keep)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < isopoints.size(); ++i)
      if (keep(isopoints[i])) {
        if (!confidence.empty())
          confidence[kept] = confidence[i];
        method[kept] = method[i];
        orientation[kept++] = orientation[i];
      }
    method.resize(kept);
    orientation.resize(kept);
    if (!confidence.empty())
      confidence.resize(kept);
  }

  /** \brief Add the fields `method` and `orientation`, if isopoints were chosen one by
   * one, and `confidence`, if there is any. */
  void
  addFields(bool is_chosen, Dataset& surface) const;
};

/** \brief Whether isopoints are put back to their edges one by one: with
 * Interpolation::Auto, but level sets fill gaps, and the vertices of a mesh belong
 * together. */
bool
returnsToEdges(const IsosurfacePipelineParameters& parameters);

/** \brief What an extraction has to do so that isopoints can be chosen: bounds of the
 * error, and gaps that are left out or filled, need fits even where isopoints lie on
 * their edges. */
IsosurfaceParameters
withErrors(const IsosurfacePipelineParameters& parameters);

/** \brief Place and orient isopoints as the parameters ask.
 *
 * Interpolation::Auto doubts an isopoint that is bridged or on a rim, or whose normal
 * and edge disagree. Of the samples at the ends of the edges around it, those of the
 * normal_neighbors nearest isopoints, more may lie on their side of a plane across the
 * linear root than of the tangent plane at the fit: then the isopoint goes back to its
 * edge. The normal of that plane is the bisector of the edge and the mean of the edges
 * around: an edge is right about its own ends, but along a line of samples edges say
 * nothing of what lies beside it.
 * \param isopoints from the extraction that withErrors() asks for, one isovalue after
 * another
 * \param edges of isopoints, with indices into the samples */
IsopointChoice
chooseIsopoints(const CloudView& samples,
                const IsoEdges& edges,
                const IsosurfacePipelineParameters& parameters,
                unsigned threads,
                pcl::PointCloud<PointIso>& isopoints,
                Report& report);

} // namespace pcl_uvol
