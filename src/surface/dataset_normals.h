// SPDX-License-Identifier: BSD-3-Clause
// Normals for the points of a data set: what every front end runs.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/surface/surface_normals.h>

namespace pcl_uvol {

/** \brief Estimate normals.
 * \param points of a surface
 * \param parameters with the view point in the coordinates that Dataset::origin counts
 * in
 * \param report gets the counts of SurfaceNormalEstimation, and a warning if no view
 * point is set and the points have no normals
 * \return the points with normals and curvature, and their other fields
 * \throws InvalidArgument as SurfaceNormalEstimation::compute */
PCL_UVOL_EXPORTS Dataset
estimateNormals(const Dataset& points,
                SurfaceNormalParameters parameters,
                unsigned threads,
                Report& report);

} // namespace pcl_uvol
