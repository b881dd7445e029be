// SPDX-License-Identifier: BSD-3-Clause
// What a kriged field says of the isosurface through a place: where it is, which way it
// looks, and how uncertain that is.
#pragma once

#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The kriged field at a place, by the coordinates of the stretched space. */
struct KrigedSlope {
  Eigen::Array3d direction; ///< of steepest ascent, a unit vector
  double length;            ///< of the gradient
  double value, deviation;

  /** \brief The distance to an isosurface, along the direction. */
  double
  findOffset(double isovalue) const
  {
    return (isovalue - value) / length;
  }

  /** \brief How far in the original space the surface may be off: the deviation over
   * the slope there.
   * \param scale of the stretched space */
  double
  findError(const Eigen::Array3d& scale) const
  {
    return deviation / (length * (direction * scale).matrix().norm());
  }
};

/** \brief Slopes between values a step to both sides along the axes, since the gradient
 * of a kriged field jumps at samples.
 * \param field kriged, with errors
 * \param step in the stretched space */
std::vector<KrigedSlope>
findKrigedSlopes(const FieldInterpolator& field,
                 const std::vector<std::array<double, 3>>& places,
                 double step,
                 const Eigen::Array3d& scale,
                 unsigned threads,
                 const ProgressCallback& progress);

} // namespace pcl_uvol::detail
