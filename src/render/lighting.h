// SPDX-License-Identifier: BSD-3-Clause
// What both renderers check of colours, materials and lights, and reckon with.
#pragma once

#include <pcl_uvol/render/color_map.h>

#include <Eigen/Core>

#include <vector>

namespace pcl_uvol {

/** \throws InvalidArgument unless an integer lies in a range */
void
checkRange(const char* name, int value, int low, int high);

/** \throws InvalidArgument for a channel that is negative or not finite */
void
checkColor(const char* name, const Color& color);

/** \throws InvalidArgument for a factor that is negative or not finite */
void
checkMaterial(const Material& material);

/** \throws InvalidArgument for a light that comes from nowhere, or a bad radius */
void
checkLights(const std::vector<Light>& lights);

/** \throws InvalidArgument for a colour out of range */
void
checkBackground(const Background& background);

/** \brief The colour behind the surface in a row of a picture.
 * \param below from 0 at the upper border to 1 at the lower one */
inline Color
backgroundAt(const Background& background, float below)
{
  const Color &top = background.top, &low = background.color;
  if (background.kind != Background::Kind::Gradient)
    return low;
  const auto mix = [&](float a, float b) { return a * (1.0f - below) + b * below; };
  return {mix(top.r, low.r), mix(top.g, low.g), mix(top.b, low.b)};
}

inline Eigen::Vector3d
toVector(const Color& color)
{
  return {color.r, color.g, color.b};
}

} // namespace pcl_uvol
