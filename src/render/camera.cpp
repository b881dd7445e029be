// SPDX-License-Identifier: BSD-3-Clause
#include "common/constants.h"
#include "common/printable.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** Sine of the least angle between the upward direction and the line of sight. */
constexpr double least_sine = 1e-6;

double
radians(double degrees)
{
  return degrees * pi / 180.0;
}

void
checkFieldOfView(double degrees)
{
  if (!(degrees > 0.0 && degrees < 180.0))
    throw InvalidArgument("bad_field_of_view", {{"degrees", degrees}});
}

struct Side {
  const char* name;
  double from[3], up[3];
};

constexpr Side sides[] = {{"front", {0, -1, 0}, {0, 0, 1}},
                          {"back", {0, 1, 0}, {0, 0, 1}},
                          {"left", {-1, 0, 0}, {0, 0, 1}},
                          {"right", {1, 0, 0}, {0, 0, 1}},
                          {"top", {0, 0, 1}, {0, 1, 0}},
                          {"bottom", {0, 0, -1}, {0, -1, 0}},
                          {"iso", {0.7, -1, 0.6}, {0, 0, 1}}};

} // namespace

double
chooseLengthUnit(const BoundingSphere& bounds)
{
  // Radii of clouds that are drawn in their own unit: squares of parts of a pixel, and
  // of distances a thousand times as large, are far inside float's range.
  constexpr double smallest = 0x1p-20, largest = 0x1p20;
  if (!(bounds.radius > 0.0) || (bounds.radius >= smallest && bounds.radius <= largest))
    return 1.0;
  return std::exp2(-std::floor(std::log2(bounds.radius)));
}

Eigen::Matrix3d
Camera::rotation() const
{
  checkFieldOfView(vertical_fov);
  const Eigen::Vector3d sight = at - eye;
  if (!eye.allFinite() || !at.allFinite() || !up.allFinite() || sight.norm() == 0.0)
    throw InvalidArgument("camera_without_sight", {});
  const Eigen::Vector3d forward = sight.normalized();
  const Eigen::Vector3d right = forward.cross(up.normalized());
  if (!(right.norm() > least_sine))
    throw InvalidArgument("camera_up_along_sight", {});
  Eigen::Matrix3d rows;
  rows.row(0) = right.normalized();
  rows.row(1) = forward.cross(right.normalized());
  rows.row(2) = forward;
  return rows;
}

Camera
Camera::fit(const BoundingSphere& sphere,
            const Eigen::Vector3d& from,
            const Eigen::Vector3d& up,
            double vertical_fov,
            double aspect,
            double fill)
{
  checkFieldOfView(vertical_fov);
  // Tangents to the sphere end at that part of the smaller half side: in the image, a
  // ball with the sine s of its angular radius has the radius tan(asin(s)).
  const double half = std::tan(0.5 * radians(vertical_fov)) * std::min(1.0, aspect);
  const double sine = std::sin(std::atan(fill * half));
  const double radius = sphere.radius > 0.0 ? sphere.radius : 1.0;
  Camera camera;
  camera.at = sphere.center;
  camera.eye = sphere.center + from.normalized() * (radius / sine);
  camera.up = up;
  camera.vertical_fov = vertical_fov;
  return camera;
}

Camera
Camera::fit(const BoundingSphere& sphere,
            const std::string& view,
            double vertical_fov,
            double aspect,
            double fill)
{
  for (const Side& side : sides)
    if (view == side.name)
      return fit(sphere,
                 Eigen::Vector3d(side.from),
                 Eigen::Vector3d(side.up),
                 vertical_fov,
                 aspect,
                 fill);
  throw InvalidArgument("unknown_view", {{"view", shortenText(view)}});
}

const std::vector<std::string>&
Camera::viewNames()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Side& side : sides)
      list.emplace_back(side.name);
    return list;
  }();
  return names;
}

Camera
Camera::parallel() const
{
  checkFieldOfView(vertical_fov);
  Camera far = *this;
  far.vertical_fov = parallel_fov;
  far.eye = at + (eye - at) * (std::tan(0.5 * radians(vertical_fov)) /
                               std::tan(0.5 * radians(parallel_fov)));
  return far;
}

Camera
Camera::orbited(double angle) const
{
  Camera turned = *this;
  turned.eye = at + Eigen::AngleAxisd(radians(angle), up.normalized()) * (eye - at);
  return turned;
}

} // namespace pcl_uvol
