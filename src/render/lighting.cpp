// SPDX-License-Identifier: BSD-3-Clause
#include "render/lighting.h"

#include <pcl_uvol/common/exceptions.h>

#include <cmath>
#include <string>

namespace pcl_uvol {

void
checkRange(const char* name, int value, int low, int high)
{
  if (value < low || value > high)
    throw InvalidArgument(
        "render_setting_out_of_range",
        {{"name", name}, {"low", low}, {"high", high}, {"number", value}});
}

void
checkColor(const char* name, const Color& color)
{
  for (const float channel : {color.r, color.g, color.b})
    if (!(channel >= 0.0f) || !std::isfinite(channel))
      throw InvalidArgument("bad_render_color", {{"name", name}, {"number", channel}});
}

void
checkMaterial(const Material& material)
{
  for (const double factor :
       {material.ambient, material.diffuse, material.specular, material.shininess})
    if (!(factor >= 0.0) || !std::isfinite(factor))
      throw InvalidArgument("bad_material_factor", {{"factor", factor}});
  checkColor("the material", material.color);
}

void
checkLights(const std::vector<Light>& lights)
{
  for (const Light& light : lights) {
    checkColor("a light", light.color);
    if (!light.position.allFinite() ||
        (light.kind == Light::Kind::Directional && light.position.isZero(0.0)))
      throw InvalidArgument("light_from_nowhere", {});
    if (!(light.radius >= 0.0) || !std::isfinite(light.radius))
      throw InvalidArgument("bad_light_radius", {{"radius", light.radius}});
  }
}

void
checkBackground(const Background& background)
{
  checkColor("the background", background.color);
  checkColor("the background", background.top);
}

} // namespace pcl_uvol
