// SPDX-License-Identifier: BSD-3-Clause
// Signs of areas and volumes that rounding cannot turn.
#pragma once

#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

namespace pcl_uvol::detail {

/** \brief Sign of the volume of a tetrahedron: 1 where a, b, c are counter-clockwise as
 * seen from d, -1 where they are clockwise, 0 in one plane. Exact for
 * finite coordinates: where double leaves doubt, in whole numbers (the filter is that
 * of Shewchuk 1997, the numbers are Boost's). */
PCL_UVOL_EXPORTS int
signOfVolume(const Eigen::Vector3d& a,
             const Eigen::Vector3d& b,
             const Eigen::Vector3d& c,
             const Eigen::Vector3d& d);

/** \brief Sign of the area of a triangle without one of its coordinates: 1 where it is
 * counter-clockwise in those that follow that one, 0 on a line. Exact as well. */
PCL_UVOL_EXPORTS int
signOfArea(const Eigen::Vector3d& a,
           const Eigen::Vector3d& b,
           const Eigen::Vector3d& c,
           int dropped_axis);

/** \brief An axis along which a triangle is not seen from its side; -1 for one without
 * area. Exact as well. */
PCL_UVOL_EXPORTS int
findVisibleAxis(const Eigen::Vector3d& a,
                const Eigen::Vector3d& b,
                const Eigen::Vector3d& c);

} // namespace pcl_uvol::detail
