// SPDX-License-Identifier: BSD-3-Clause
// A renderer of all planes on the CPU, for tests of single passes.
#pragma once

#include "render/image_space/frame.h"
#include "support/surfaces.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>

#include <cmath>

namespace uvol_test {

using Renderer = pcl_uvol::ImageSpaceRenderer<pcl::PointNormal>;

const inline Eigen::Vector3d from_above(0.3, 0.2, 1.0), upwards(0.0, 1.0, 0.0);

/** \brief Where prepare() looks from. */
inline pcl_uvol::Camera
cameraOf(Renderer& renderer, int width, int height)
{
  return pcl_uvol::Camera::fit(renderer.getBounds(),
                               from_above,
                               upwards,
                               30.0,
                               static_cast<double>(width) / height,
                               0.72);
}

/** \brief A renderer of all planes, the cloud in full view. */
inline void
prepare(Renderer& renderer, const SurfaceCloudPtr& cloud, int width, int height)
{
  renderer.setInputCloud(cloud);
  renderer.setSize(width, height);
  pcl_uvol::ImagePlanes planes;
  planes.depth = planes.normal = planes.id = true;
  renderer.setPlanes(planes);
  renderer.setCamera(cameraOf(renderer, width, height));
}

/** \brief Leave out every pass but the first. */
inline void
onlyProject(pcl_uvol::ImageSpaceSettings& settings)
{
  settings.cull_back_faces = true;
  settings.footprints = false;
  settings.background_fill = settings.occluded_fill = 0;
  settings.smoothing = pcl_uvol::SmoothingFilter::None;
  settings.anti_aliasing = false;
}

/** \brief Pixels that are not background. */
inline std::size_t
seenPixels(const pcl_uvol::Image& image)
{
  std::size_t seen = 0;
  for (const std::uint32_t id : image.id)
    seen += id != pcl_uvol::Image::background ? 1 : 0;
  return seen;
}

/** \brief A sphere of radius 1 about the origin in the image: its outline is a circle.
 */
struct Outline {
  double center_x, center_y, radius;

  Outline(const pcl_uvol::Camera& camera, const pcl_uvol::View& view)
  {
    const Eigen::Vector3d c = camera.rotation() * -camera.eye;
    // Seen along its axis: the fitted camera looks at the centre.
    radius = view.focal * std::tan(std::asin(1.0 / c.norm()));
    center_x = 0.5 * view.width;
    center_y = 0.5 * view.height;
  }

  /** \brief Pixels by which the middle of one lies outside. */
  double
  beyond(int column, int row) const
  {
    return std::hypot(column + 0.5 - center_x, row + 0.5 - center_y) - radius;
  }
};

} // namespace uvol_test
