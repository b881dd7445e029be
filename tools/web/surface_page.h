// SPDX-License-Identifier: BSD-3-Clause
// A surface as one file that turns in any browser, without a server or a network.
#pragma once

#include "render/point_colors.h"
#include "render/surface_cloud.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <array>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief What a page shows beside the points. */
struct SurfacePage {
  std::string title;           ///< of the window
  pcl_uvol::Camera camera;     ///< where it starts, in the coordinates of the cloud
  pcl_uvol::Material material; ///< its colour does not count
  std::vector<pcl_uvol::Light> lights; ///< directional ones that follow the camera, 8
  pcl_uvol::Color background;
  std::string field; ///< that the colours stand for; "": there is no bar
  pcl_uvol::ColorMap map;
  pcl_uvol::ColorScale scale;
  std::vector<pcl_uvol::CategoryColor>
      categories; ///< of the field, in the place of a bar
};

/** \brief Write a page: points as lit discs in WebGL 2, 16 bytes each and in base64,
 * with positions in 16 bits per axis and normals in 8.
 * \param surface with colours and footprints
 * \throws IOError */
void
writeSurfacePage(const std::string& path,
                 const pcl_uvol::SurfaceCloud& surface,
                 const SurfacePage& page);

} // namespace uvol_tools
