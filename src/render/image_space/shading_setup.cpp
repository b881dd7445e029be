// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/shading_setup.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** Part of a light: far below what 8 bits per channel show. */
constexpr double least_highlight = 1e-4;

ShadingLight
convert(const Light& light, const Frame& frame)
{
  const bool is_point = light.kind == Light::Kind::Point;
  const Eigen::Vector3d seen = frame.lightVector(light);
  const Eigen::Vector3d position = is_point ? seen : seen.normalized();
  ShadingLight converted{};
  for (int axis = 0; axis < 3; ++axis)
    converted.position[axis] = static_cast<float>(position[axis]);
  converted.color[0] = light.color.r;
  converted.color[1] = light.color.g;
  converted.color[2] = light.color.b;
  converted.is_point = is_point;
  return converted;
}

} // namespace

ShadingSetup::ShadingSetup(const Frame& frame)
{
  const View& view = frame.view;
  const Material& material = frame.settings.material;
  for (const Light& light : frame.settings.lights)
    lights_.push_back(convert(light, frame));
  shading_.looks =
      reinterpret_cast<const std::uint32_t*>(frame.cloud.getLooks().data());
  std::copy(view.rotation, view.rotation + 9, shading_.rotation);
  shading_.center_x = view.center_x;
  shading_.center_y = view.center_y;
  shading_.per_focal = 1.0f / view.focal;
  shading_.far = view.far;
  shading_.ambient = static_cast<float>(material.ambient);
  shading_.diffuse = static_cast<float>(material.diffuse);
  shading_.specular = static_cast<float>(material.specular);
  shading_.shininess = static_cast<float>(material.shininess);
  shading_.least_base =
      static_cast<float>(std::pow(least_highlight, 1.0 / material.shininess));
  shading_.lights = lights_.data();
  shading_.light_count = static_cast<int>(lights_.size());
  shading_.is_lit = frame.settings.shading;
  shading_.two_sided = !frame.culls();
}

} // namespace pcl_uvol
