// SPDX-License-Identifier: BSD-3-Clause
// The parts of space that searches for nearest samples look at.
#pragma once

#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/export.h>

#include <array>

namespace pcl_uvol {

/** \brief All places within a distance of one, as distances are in a metric: an
 * ellipsoid, or a ball where the metric is that of space. A plain value, for messages.
 */
struct PCL_UVOL_EXPORTS Ball {
  using Metric = std::array<std::array<double, 3>, 3>;

  Position center;
  float radius;
  /** \brief Half of its sides along the axes, in radii. */
  std::array<double, 3> extent{{1.0, 1.0, 1.0}};
  /** \brief A linear map whose image of space has the distances, with rows at right
   * angles. */
  Metric metric{{{{1.0, 0.0, 0.0}}, {{0.0, 1.0, 0.0}}, {{0.0, 0.0, 1.0}}}};

  /** \brief The distance in space that no place of it is farther from the center than.
   */
  double
  getReach() const;

  /** \brief True if it is larger or smaller than another one, and else the same. */
  bool
  isConcentric(const Ball& other) const;

  /** \brief True if it holds all of another one; false as well where neither is a ball
   * in space and their metrics differ. */
  bool
  contains(const Ball& other) const;
};

} // namespace pcl_uvol
