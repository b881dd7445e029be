// SPDX-License-Identifier: BSD-3-Clause
// A known point of a surface, and what it tells of the surface around it.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl_uvol::detail {

/** \brief A point of a surface with its unit normal and its mean curvature, positive
 * where the side that the normal leaves is convex. */
struct Foot {
  Eigen::Vector3d place, normal;
  double mean_curvature;

  /** \brief Height of a place above the sphere that touches the surface here, to second
   * order. */
  double
  heightOf(const Eigen::Vector3d& other) const
  {
    const Eigen::Vector3d offset = other - place;
    const double along = normal.dot(offset);
    const double sq_aside = offset.squaredNorm() - along * along;
    return along + 0.5 * mean_curvature * sq_aside;
  }

  /** \brief Direction of the normal of that sphere; not of unit length. */
  Eigen::Vector3d
  normalAt(const Eigen::Vector3d& other) const
  {
    const Eigen::Vector3d offset = other - place;
    return normal + mean_curvature * (offset - normal.dot(offset) * normal);
  }
};

/** \brief The foot below a place, by the mean of others that weighs near ones more.
 * \param feet at least one
 * \param length about the distance between feet */
Foot
blendFeet(const std::vector<Foot>& feet, const Eigen::Vector3d& place, double length);

} // namespace pcl_uvol::detail
