// SPDX-License-Identifier: BSD-3-Clause
// From linear isopoints to the zero level of local least-squares polynomials, with
// normal, curvature, error and support.
#pragma once

#include "isosurface/isopoints.h"
#include "neighbors/ball.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Which root an isopoint is, or why the linear one stayed. */
enum class RootOutcome : std::uint8_t { Cubic, Quadratic, Singular, Step, Far };

/** \brief What became of an isopoint. */
struct RootFit {
  RootOutcome outcome;
  float radius; ///< of the ball around the linear root that the nearest samples lie in,
                ///< in the stretched space; infinite where samples are few
  float value;  ///< at the point as it was given, minus the isovalue, of the fit or of
                ///< one that is more certain of the sign, whether or not the root
                ///< serves; where that is one of logarithms, theirs; NaN without a fit
};

/** \brief Move isopoints onto fits through their nearest samples.
 * \param edges of the points, in any order
 * \param points linear isopoints; where a fit does not serve, the point and its outside
 * vector stay
 * \param searched gets, per point, where else than among the nearest samples was
 * looked: the result depends on no sample outside, and each of these balls on what is
 * in those before
 *
 * \return one per point */
std::vector<RootFit>
fitRoots(const IsopointInput& input,
         float isovalue,
         const IsoEdges& edges,
         std::vector<PointIso>& points,
         StepTimer& step,
         std::vector<std::vector<Ball>>* searched = nullptr);

/** \brief Count "cubic_roots", "quadratic_roots", "linear_singular", "linear_step",
 * "linear_far", "bridged" and "rim".
 * \param outcomes, supports one per point
 * \param errors_only leave out the outcomes, see IsosurfaceParameters */
void
countRoots(const std::vector<RootOutcome>& outcomes,
           const std::vector<std::uint8_t>& supports,
           bool errors_only,
           Report& report);

/** \brief Move isopoints onto fits through their nearest samples.
 * \param edges of the points, sorted by sample indices
 * \param points linear isopoints; where a fit does not
 * serve, the point and its outside vector stay
 * \param report gets the counts of countRoots and the time of "smooth_roots" */
void
smoothIsopoints(const IsopointInput& input,
                float isovalue,
                const IsoEdges& edges,
                std::vector<PointIso>& points,
                Report& report);

} // namespace pcl_uvol
