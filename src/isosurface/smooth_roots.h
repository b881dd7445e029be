// SPDX-License-Identifier: BSD-3-Clause
// From linear isopoints to the zero level of local least-squares polynomials, with
// normal, curvature, error and support.
#pragma once

#include "isopoints.h"

#include <vector>

namespace pcl_uvol {

/** \brief Move isopoints onto fits through their nearest samples.
 * \param edges of the points, sorted by sample indices
 * \param points linear isopoints; where a fit does not
 * serve, the point and its outside vector stay
 * \param report gets "cubic_roots", "quadratic_roots", "linear_singular",
 * "linear_step", "linear_far", "bridged", "rim" and the time of "smooth_roots" */
void
smoothIsopoints(const IsopointInput& input,
                float isovalue,
                const IsoEdges& edges,
                std::vector<PointIso>& points,
                Report& report);

} // namespace pcl_uvol
