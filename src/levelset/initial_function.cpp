// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/levelset/initial_function.h>

#include <cmath>

namespace pcl_uvol {

InitialFunction
InitialFunction::sphere(const Eigen::Vector3d& center, double radius)
{
  if (!center.allFinite() || !(radius > 0.0) || !std::isfinite(radius))
    throw InvalidArgument("The sphere that the level set starts from needs a finite "
                          "centre and a radius above 0.");
  InitialFunction function;
  function.distance_ = [=](const Eigen::Vector3d& x) {
    return radius - (x - center).norm();
  };
  return function;
}

InitialFunction
InitialFunction::box(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  if (!low.allFinite() || !high.allFinite() || !(low.array() < high.array()).all())
    throw InvalidArgument(
        "The box that the level set starts from needs finite corners, "
        "the first below the second along every axis.");
  InitialFunction function;
  function.distance_ = [=](const Eigen::Vector3d& x) {
    const Eigen::Array3d beyond = (low - x).array().max((x - high).array());
    const double outside = beyond.max(0.0).matrix().norm();
    return outside > 0.0 ? -outside : -beyond.maxCoeff();
  };
  return function;
}

InitialFunction
InitialFunction::plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)
{
  if (!point.allFinite() || !normal.allFinite() || !(normal.norm() > 0.0))
    throw InvalidArgument(
        "The plane that the level set starts from needs a finite point "
        "and a normal that is not 0.");
  InitialFunction function;
  function.distance_ = [point, n = normal.normalized()](const Eigen::Vector3d& x) {
    return (point - x).dot(n);
  };
  return function;
}

InitialFunction
InitialFunction::field(const std::string& name)
{
  InitialFunction function;
  function.field_ = name;
  return function;
}

} // namespace pcl_uvol
