// SPDX-License-Identifier: BSD-3-Clause
// How large a cloud is, where a few of its points may lie far from all others.
#pragma once

#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/export.h>

#include <array>
#include <vector>

namespace pcl_uvol {

/** \brief Sides of the box of all points; along an axis where a few of these make it
 * more than twice as long as without them, that of the others. A few are a hundredth at
 * either end, rounded down.
 * \param positions all finite; of none the sides are 0 */
PCL_UVOL_EXPORTS std::array<double, 3>
findUsualSides(const std::vector<Position>& positions);

} // namespace pcl_uvol
