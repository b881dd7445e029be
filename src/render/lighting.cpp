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
    throw InvalidArgument(std::string("The ") + name + " lies between " +
                          std::to_string(low) + " and " + std::to_string(high) +
                          ", and is not " + std::to_string(value) + ".");
}

void
checkColor(const char* name, const Color& color)
{
  for (const float channel : {color.r, color.g, color.b})
    if (!(channel >= 0.0f) || !std::isfinite(channel))
      throw InvalidArgument(std::string("The colour of ") + name +
                            " has finite parts of 0 or more, not " +
                            std::to_string(channel) + ".");
}

void
checkMaterial(const Material& material)
{
  for (const double factor :
       {material.ambient, material.diffuse, material.specular, material.shininess})
    if (!(factor >= 0.0) || !std::isfinite(factor))
      throw InvalidArgument("The factors of a material are finite and 0 or more, not " +
                            std::to_string(factor) + ".");
  checkColor("the material", material.color);
}

void
checkLights(const std::vector<Light>& lights)
{
  for (const Light& light : lights) {
    checkColor("a light", light.color);
    if (!light.position.allFinite() ||
        (light.kind == Light::Kind::Directional && light.position.isZero(0.0)))
      throw InvalidArgument(
          "A light comes from a finite place, or from a direction that "
          "is not zero.");
    if (!(light.radius >= 0.0) || !std::isfinite(light.radius))
      throw InvalidArgument("The radius of a light is finite and 0 or more, not " +
                            std::to_string(light.radius) + ".");
  }
}

void
checkBackground(const Background& background)
{
  checkColor("the background", background.color);
  checkColor("the background", background.top);
}

} // namespace pcl_uvol
