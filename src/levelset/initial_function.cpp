// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <cmath>

namespace pcl_uvol {

InitialFunction
InitialFunction::sphere(const Eigen::Vector3d& center, double radius)
{
  InitialFunction function;
  function.kind = InitialKind::Sphere;
  function.first = center;
  function.radius = radius;
  function.check();
  return function;
}

InitialFunction
InitialFunction::box(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  InitialFunction function;
  function.kind = InitialKind::Box;
  function.first = low;
  function.second = high;
  function.check();
  return function;
}

InitialFunction
InitialFunction::plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)
{
  InitialFunction function;
  function.kind = InitialKind::Plane;
  function.first = point;
  function.second = normal;
  function.check();
  return function;
}

InitialFunction
InitialFunction::field(const std::string& name)
{
  InitialFunction function;
  function.kind = InitialKind::Field;
  function.field_name = name;
  return function;
}

double
InitialFunction::computeDistance(const Eigen::Vector3d& x,
                                 const Eigen::Array3d& scale) const
{
  if (kind == InitialKind::Sphere) {
    // Stretched, it is an ellipsoid: to first order.
    const Eigen::Array3d from_center = x.array() - first;
    const double distance = from_center.matrix().norm();
    const double slope = distance > 0.0
                             ? (from_center / scale).matrix().norm() / distance
                             : 1.0 / scale.minCoeff();
    return (radius - distance) / slope;
  }
  if (kind == InitialKind::Box) {
    const Eigen::Array3d beyond = scale * (first - x.array()).max(x.array() - second);
    const double outside = beyond.max(0.0).matrix().norm();
    return outside > 0.0 ? -outside : -beyond.maxCoeff();
  }
  return (first - x.array()).matrix().dot(second.matrix()) /
         (second / scale).matrix().norm();
}

void
InitialFunction::check() const
{
  if (kind == InitialKind::Sphere &&
      (!first.allFinite() || !(radius > 0.0) || !std::isfinite(radius)))
    throw InvalidArgument("initial_sphere_not_allowed", {});
  if (kind == InitialKind::Box &&
      (!first.allFinite() || !second.allFinite() || !(first < second).all()))
    throw InvalidArgument("initial_box_not_allowed", {});
  if (kind == InitialKind::Plane &&
      (!first.allFinite() || !second.allFinite() || !(second.matrix().norm() > 0.0)))
    throw InvalidArgument("initial_plane_not_allowed", {});
}

} // namespace pcl_uvol
