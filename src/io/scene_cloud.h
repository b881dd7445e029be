// SPDX-License-Identifier: BSD-3-Clause
// Clouds of a scene: read, covered by splats, coloured and put into their places.
#pragma once

#include "scene_words.h"
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/ray_tracing/scene.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Where a cloud goes: a point x comes to turn * (scale * x) + at. */
struct CloudPlacement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< a rotation
  double scale = 1.0;
  Eigen::Vector3d at{0.0, 0.0, 0.0};
  /** The bounding box is first centred at the origin, and its longest side scaled to
   * this length; 0: it is not, and scale counts. */
  double fit_size = 0.0;
};

/** \brief What a scene says about a cloud. */
struct CloudItem {
  ScenePlace place;
  std::string name; ///< of the file, as the scene gives it
  std::string path;
  RayMaterial material;
  CloudPlacement placement;
  SplatParameters parameters;
  bool has_parameters = false; ///< the scene says something about them
  std::string color_field;     ///< "": the colours that the cloud may have
  ScenePlace color_place;      ///< of the field
  ColorMap color_map;
  std::optional<std::array<double, 2>> color_range;
};

/** \brief Add clouds to a scene. \return the origin of its coordinates, which is that
 * of the first cloud that is not fitted, where its placement brings it: so float keeps
 * the digits of large coordinates
 * \throws IOError that starts with the place of the item */
std::array<double, 3>
addClouds(const std::vector<CloudItem>& clouds,
          unsigned threads,
          Report& report,
          Scene& scene);

} // namespace io
} // namespace pcl_uvol
