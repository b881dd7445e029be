// SPDX-License-Identifier: BSD-3-Clause
// What both renderers check of colours, materials and lights, and reckon with.
#pragma once

#include <pcl_uvol/render/lighting.h>

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

inline Eigen::Vector3d
toVector(const Color& color)
{
  return {color.r, color.g, color.b};
}

} // namespace pcl_uvol
