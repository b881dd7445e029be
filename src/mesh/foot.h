// SPDX-License-Identifier: BSD-3-Clause
// A known point of a surface, and what it tells of the surface around it.
#pragma once

#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <cstdint>
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

/** \brief Sides of the samples' box: a bit per side, by the numbers of ghosts. */
using BoxSides = std::uint8_t;

inline bool
isBound(BoxSides sides, int axis)
{
  return (sides >> (2 * axis) & 3) != 0;
}

/** \brief A direction without its parts at right angles to sides. */
PCL_UVOL_EXPORTS Eigen::Vector3d
keepWithin(BoxSides sides, const Eigen::Vector3d& direction);

/** \brief The way to a surface within sides.
 * \param height above the surface
 * \param normal of it, of unit length
 * \return 0 where the surface hardly crosses the sides */
PCL_UVOL_EXPORTS Eigen::Vector3d
wayDown(double height, const Eigen::Vector3d& normal, BoxSides sides);

/** \brief The foot below a place, by the mean of others that weighs near ones more.
 * \param feet at least one
 * \param length about the distance between feet
 * \param sides that the foot is to stay within */
Foot
blendFeet(const std::vector<Foot>& feet,
          const Eigen::Vector3d& place,
          double length,
          BoxSides sides = 0);

} // namespace pcl_uvol::detail
