// SPDX-License-Identifier: BSD-3-Clause
#include "render/camera_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr double pi = 3.14159265358979323846;

/** Largest values of linear functions over points in the directions of a camera. */
struct Extremes {
  double right, left, below, above; ///< beyond planes that lie aslant by a slope
  double nearest, farthest;

  Extremes()
      : right(-std::numeric_limits<double>::infinity())
      , left(right)
      , below(right)
      , above(right)
      , nearest(-right)
      , farthest(right)
  {
  }

  void
  add(const Eigen::Vector3d& point, double slope_x, double slope_y)
  {
    right = std::max(right, point.x() - slope_x * point.z());
    left = std::max(left, -point.x() - slope_x * point.z());
    below = std::max(below, point.y() - slope_y * point.z());
    above = std::max(above, -point.y() - slope_y * point.z());
    nearest = std::min(nearest, point.z());
    farthest = std::max(farthest, point.z());
  }
};

} // namespace

Camera
fitToPoints(const Camera& camera, const CloudView& cloud, double aspect, double fill)
{
  // A point x is in the image of a camera at e if |x - e|_x <= slope (x - e)_z: all of
  // them are if e lies behind four planes that touch the points from outside.
  const Eigen::Matrix3d turn = camera.rotation();
  const double slope_y = fill * std::tan(camera.vertical_fov * pi / 360.0);
  const double slope_x = slope_y * aspect;
  Extremes most;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const Eigen::Vector3f point = Eigen::Map<const Eigen::Vector3f>(cloud.xyz(i));
    if (point.allFinite())
      most.add(turn * (point.cast<double>() - camera.at), slope_x, slope_y);
  }
  const double behind = std::max((most.right + most.left) / (2.0 * slope_x),
                                 (most.below + most.above) / (2.0 * slope_y));
  if (!(behind + most.nearest > 0.0) || !std::isfinite(behind))
    return camera;
  const Eigen::Vector3d eye(
      0.5 * (most.right - most.left), 0.5 * (most.below - most.above), -behind);
  Camera fitted = camera;
  fitted.eye = camera.at + turn.transpose() * eye;
  fitted.at =
      camera.at +
      turn.transpose() *
          Eigen::Vector3d(eye.x(), eye.y(), 0.5 * (most.nearest + most.farthest));
  return fitted;
}

} // namespace pcl_uvol
