// SPDX-License-Identifier: BSD-3-Clause
#include "common/constants.h"
#include "render/image_space/frame.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** In parts of the far distance: points nearer than that are not drawn. */
constexpr double nearest_part = 1e-4;

/** Room beyond the farthest point for discs and rounding. */
constexpr double far_room = 1.05;

} // namespace

View::View(const Camera& camera,
           const BoundingSphere& bounds,
           int image_width,
           int image_height)
    : width(image_width)
    , height(image_height)
    , shorter_side(std::min(image_width, image_height))
    , unit(chooseLengthUnit(bounds))
{
  if (width < 1 || height < 1 || width > largest_size || height > largest_size)
    throw InvalidArgument(
        "bad_image_size",
        {{"width", width}, {"height", height}, {"most", largest_size}});
  const Eigen::Matrix3d turn = camera.rotation();
  const Eigen::Vector3d shift = unit * (turn * (bounds.center - camera.eye));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rotation[3 * row + column] = static_cast<float>(turn(row, column));
    translation[row] = static_cast<float>(shift[row]);
  }
  const double half = std::tan(camera.vertical_fov * pi / 360.0);
  focal = static_cast<float>(0.5 * height / half);
  center_x = static_cast<float>(guard + 0.5 * width);
  center_y = static_cast<float>(guard + 0.5 * height);
  const double farthest = shift.norm() + unit * bounds.radius;
  far = static_cast<float>(far_room * (farthest > 0.0 ? farthest : 1.0));
  near = static_cast<float>(nearest_part * far);
}

View
View::ofPart(const BoundingSphere& bounds, const BoundingSphere& part) const
{
  View view = *this;
  view.unit = chooseLengthUnit(part);
  const double growth = view.unit / unit;
  const Eigen::Vector3d shift = view.unit * (part.center - bounds.center);
  for (int row = 0; row < 3; ++row) {
    const Eigen::Vector3d axis(
        rotation[3 * row], rotation[3 * row + 1], rotation[3 * row + 2]);
    view.translation[row] =
        static_cast<float>(growth * translation[row] + axis.dot(shift));
  }
  view.near = static_cast<float>(growth * near);
  view.far = static_cast<float>(growth * far);
  return view;
}

View
View::coarser(int factor) const
{
  if (factor == 1)
    return *this; // nothing is rounded
  const auto shrunk = [&](int side) { return (side + factor - 1) / factor; };
  const float scale = 1.0f / static_cast<float>(factor);
  View view = *this;
  view.width = shrunk(width);
  view.height = shrunk(height);
  view.shorter_side = shrunk(shorter_side);
  view.focal *= scale;
  view.center_x = guard + scale * (center_x - guard);
  view.center_y = guard + scale * (center_y - guard);
  return view;
}

float
Frame::layerDistance() const
{
  constexpr float discs = 2.0f;
  const float disc = discs * cloud.getTypicalFootprint() / view.far;
  const auto least = static_cast<float>(settings.layer_distance);
  return hasFootprints() ? std::max(least, disc) : least;
}

Eigen::Vector3d
Frame::lightVector(const Light& light) const
{
  const float* const r = view.rotation;
  const auto turnBack = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return {r[0] * v[0] + r[3] * v[1] + r[6] * v[2],
            r[1] * v[0] + r[4] * v[1] + r[7] * v[2],
            r[2] * v[0] + r[5] * v[1] + r[8] * v[2]};
  };
  const Eigen::Vector3d& p = light.position;
  if (light.follows_camera)
    return turnBack({p[0], -p[1], -p[2]});
  if (light.kind == Light::Kind::Directional)
    return p;
  const Eigen::Vector3d shift(
      view.translation[0], view.translation[1], view.translation[2]);
  return view.unit * (p - cloud.getBounds().center) + turnBack(shift);
}

void
resizePlanes(const Frame& frame, Image& image)
{
  image.width = static_cast<std::uint32_t>(frame.view.width);
  image.height = static_cast<std::uint32_t>(frame.view.height);
  image.color.resize(4 * image.pixels());
  image.depth.resize(frame.planes.depth ? image.pixels() : 0);
  image.normal.resize(frame.planes.normal ? 3 * image.pixels() : 0);
  image.id.resize(frame.planes.id ? image.pixels() : 0);
}

} // namespace pcl_uvol
