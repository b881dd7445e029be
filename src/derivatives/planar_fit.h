// SPDX-License-Identifier: BSD-3-Clause
// The zero level of weighted least-squares polynomials through samples that lie on a
// plane, which determine no polynomial of space.
#pragma once

#include "derivatives/fit_kernel.h"
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <cstddef>

namespace pcl_uvol {

/** \brief Orthogonal unit vectors along a plane. */
using PlaneAxes = Eigen::Matrix<double, 3, 2>;

/** \brief Find the plane that samples around a place lie on.
 * \param offsets of the samples, the nearest ones first
 * \return false if they lie on none, or if some of the nearest ones lie along a line */
PCL_UVOL_EXPORTS bool
findPlane(const Eigen::Matrix3Xd& offsets, PlaneAxes& axes);

/** \brief What FitKernel does, for the samples of a lane as they are seen along the
 * normal of a plane: a cubic has 10 terms there and a quadratic 6, and derivatives
 * across the plane are 0.
 * \param count the first ones of that lane; the farthest has length 1
 * \param result gets this lane; its pivot is 1 */
PCL_UVOL_EXPORTS void
fitZeroLevelInPlane(const FitSample* samples,
                    std::size_t count,
                    std::size_t lane,
                    const PlaneAxes& axes,
                    FitResult& result);

} // namespace pcl_uvol
