// SPDX-License-Identifier: BSD-3-Clause
#include "render/camera_choice.h"

#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>

#include <cmath>

namespace pcl_uvol {

namespace {

/** z, or y for a camera that looks along z. */
Eigen::Vector3d
upwardsOf(const Camera& camera)
{
  constexpr double least_sine = 1e-3;
  const Eigen::Vector3d sight = (camera.at - camera.eye).normalized();
  return sight.head<2>().norm() > least_sine ? Eigen::Vector3d::UnitZ()
                                             : Eigen::Vector3d::UnitY();
}

/** What a camera turns about: one that has its place about its own upward direction,
 * views about that of the world. */
Eigen::Vector3d
axisOf(const CameraChoice& choice, const Camera& camera)
{
  return choice.eye ? camera.up : choice.up.value_or(Eigen::Vector3d::UnitZ());
}

/** A named view of the world turned so that what was z is another direction. */
Camera
turnedUpwards(Camera camera, const Eigen::Vector3d& up)
{
  if (!(up.norm() > 0.0))
    throw InvalidArgument("camera_up_of_zero", {});
  const auto turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up);
  camera.eye = camera.at + turn * (camera.eye - camera.at);
  camera.up = turn * camera.up;
  return camera;
}

} // namespace

Camera
fitToSurface(const Camera& camera,
             const SeenSurface& seen,
             double aspect,
             const ImageFill& fill,
             const std::optional<Eigen::Vector3d>& axis)
{
  if (seen.cloud == nullptr)
    return camera;
  const auto fit = [&](const std::vector<FittedDisc>& discs) {
    return fitToPoints(camera, {*seen.cloud, discs, axis}, aspect, fill);
  };
  Camera fitted = fit({});
  if (!seen.find_discs)
    return fitted;
  const std::vector<FittedDisc> discs = seen.find_discs(fitted);
  return discs.empty() ? fitted : fit(discs);
}

Camera
chooseCamera(const CameraChoice& choice,
             const SeenSurface& seen,
             const std::array<double, 3>& origin,
             double aspect)
{
  const Eigen::Vector3d shift(origin.data());
  const bool is_far = choice.is_parallel && !choice.eye;
  Camera camera = Camera::fit(seen.bounds,
                              choice.view,
                              is_far ? Camera::parallel_fov : choice.fov,
                              aspect,
                              choice.fill.least());
  if (choice.eye) {
    camera.eye = *choice.eye - shift;
    if (choice.at)
      camera.at = *choice.at - shift;
    camera.up = choice.up ? *choice.up : upwardsOf(camera);
    if (choice.is_parallel)
      camera = camera.parallel();
  }
  else {
    if (choice.up)
      camera = turnedUpwards(camera, *choice.up);
    const auto axis =
        choice.turns ? std::optional(axisOf(choice, camera)) : std::nullopt;
    camera = fitToSurface(camera, seen, aspect, choice.fill, axis);
  }
  return zoomed(camera, choice.zoom);
}

Camera
orbit(const CameraChoice& choice, Camera camera, double angle)
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  const Eigen::AngleAxisd turn(angle * degree, axisOf(choice, camera).normalized());
  camera.eye = camera.at + turn * (camera.eye - camera.at);
  camera.up = turn * camera.up;
  return camera;
}

Camera
zoomed(Camera camera, double zoom)
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  if (zoom != 1.0)
    camera.vertical_fov =
        2.0 * std::atan(std::tan(0.5 * degree * camera.vertical_fov) / zoom) / degree;
  return camera;
}

} // namespace pcl_uvol
