// SPDX-License-Identifier: BSD-3-Clause
// What a level set starts from.
#pragma once

#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <functional>
#include <string>

namespace pcl_uvol {

/** \brief The level-set function at the start: the scaled scalar field itself, a field
 * of the cloud, or the signed distance to a shape, positive inside where values are
 * higher inside (Outside::Lower), else negative. */
class PCL_UVOL_EXPORTS InitialFunction {
public:
  /** \brief f - f_iso, scaled to a distance by its slope: the default. */
  InitialFunction() = default;

  /** \param radius > 0 \throws InvalidArgument */
  static InitialFunction
  sphere(const Eigen::Vector3d& center, double radius);

  /** \param low, high opposite corners, low < high along every axis \throws
   * InvalidArgument */
  static InitialFunction
  box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  /** \param normal to the outside, not 0 \throws InvalidArgument */
  static InitialFunction
  plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

  /** \brief A scalar field of the cloud, in units of length; see ScalarField. */
  static InitialFunction
  field(const std::string& name);

  /** \brief Distance to the shape, positive inside; empty without a shape. */
  const std::function<double(const Eigen::Vector3d&)>&
  getDistance() const
  {
    return distance_;
  }

  /** \brief Empty without a field. */
  const std::string&
  getField() const
  {
    return field_;
  }

private:
  std::function<double(const Eigen::Vector3d&)> distance_;
  std::string field_;
};

} // namespace pcl_uvol
