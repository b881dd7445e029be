// SPDX-License-Identifier: BSD-3-Clause
#include "render/lighting.h"
#include <pcl_uvol/render/renderer.h>

namespace pcl_uvol {

namespace {

constexpr double default_fov = 30.0; // degrees, vertical

} // namespace

void
Renderer::checkPictureSize(int largest) const
{
  checkRange("supersampling", supersampling_, 1, 8);
  checkRange("width", width_, 1, largest);
  checkRange("height", height_, 1, largest);
}

Camera
Renderer::cameraFor(const BoundingSphere& bounds) const
{
  return camera_.value_or(
      Camera::fit(bounds, "iso", default_fov, static_cast<double>(width_) / height_));
}

} // namespace pcl_uvol
