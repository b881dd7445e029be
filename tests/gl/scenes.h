// SPDX-License-Identifier: BSD-3-Clause
// What both backends draw, and how far their pictures may differ.
#pragma once

#include "render/image_space/frame.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>
#include <pcl/common/io.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>

namespace uvol_test {

/** \brief A cloud to be drawn, with bands of colour. */
template <typename PointT>
std::shared_ptr<pcl_uvol::SurfaceCloud>
makeSurface(const pcl::PointCloud<PointT>& points, bool with_footprints)
{
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::Report report;
  auto surface = std::make_shared<pcl_uvol::SurfaceCloud>(
      pcl_uvol::viewOf(points), all, 0, report);
  std::vector<pcl_uvol::Rgba> colors;
  for (const PointT& point : points)
    colors.push_back(pcl_uvol::toRgba({0.5f + 0.4f * std::sin(3.0f * point.x),
                                       0.5f + 0.4f * std::sin(2.0f * point.y),
                                       0.5f + 0.4f * std::sin(4.0f * point.z)}));
  surface->setColors(colors);
  if (with_footprints)
    surface->computeFootprints(0, report);
  return surface;
}

/** \brief A cloud and where it is looked at from. */
struct Scene {
  std::shared_ptr<pcl_uvol::SurfaceCloud> cloud;
  pcl_uvol::Camera camera;
};

/** \brief Names that makeScene knows. */
inline std::vector<std::string>
sceneNames()
{
  return {"sphere", "knot", "waves", "sparse", "near", "rims", "two_sided"};
}

inline Scene
makeScene(const std::string& name)
{
  const auto seen = [](const auto& points,
                       bool with_footprints,
                       const char* view = "iso",
                       double fill = 0.9) {
    const auto cloud = makeSurface(points, with_footprints);
    return Scene{cloud,
                 pcl_uvol::Camera::fit(cloud->getBounds(), view, 40.0, 1.0, fill)};
  };
  if (name == "sphere")
    return seen(*makeSphere(60000, 3), false);
  if (name == "knot") // as dense as pixels: discs fill holes
    return seen(*makeTorusKnot(45000, 5), true);
  if (name == "waves")
    return seen(*makeWaves(60000, 6), false);
  if (name == "sparse") // few points near the eye, many behind them
    return seen(*joined(*makeSphere(3000, 1), *makeWaves(40000, 2)), true, "iso", 2.5);
  if (name == "near") // discs of all sizes, many from outside of the image
    return seen(*makeSphere(100000, 8), true, "front", 2.2);
  if (name == "rims") // of discs of all sizes
    return seen(*makeWaves(300, 1), true);
  pcl::PointCloud<pcl::PointXYZ> places; // without normals: seen from both sides
  pcl::copyPointCloud(*makeWaves(30000, 4), places);
  return seen(places, true, "bottom");
}

/** \brief Draw with all planes. */
inline pcl_uvol::Image
draw(pcl_uvol::ImageSpaceBackend& backend,
     const Scene& scene,
     const pcl_uvol::ImageSpaceSettings& settings,
     pcl_uvol::Report& report,
     int width = 300,
     int height = 300)
{
  const pcl_uvol::View view(scene.camera, scene.cloud->getBounds(), width, height);
  pcl_uvol::Image image;
  backend.render({*scene.cloud, view, settings, {true, true, true}, 0}, image, report);
  return image;
}

} // namespace uvol_test
