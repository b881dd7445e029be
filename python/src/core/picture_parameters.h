// SPDX-License-Identifier: BSD-3-Clause
// What pictures are asked for with: the options of uvol_render and uvol_raytrace by
// their names.
#pragma once

#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/render/image_space/settings.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <tuple>

namespace pcl_uvol {

/** \brief What is behind the surface. */
enum class BackgroundKind { White, Black, Gradient, Transparent };

constexpr std::array<EnumWord<BackgroundKind>, 4>
listWords(BackgroundKind)
{
  return {{{BackgroundKind::White, "white"},
           {BackgroundKind::Black, "black"},
           {BackgroundKind::Gradient, "gradient"},
           {BackgroundKind::Transparent, "transparent"}}};
}

/** \brief Camera, size, colours and lines of a picture. */
struct PictureParameters {
  std::string color = "auto"; ///< a field, rgb, none; auto: see usualColorField
  std::string colormap = "viridis";
  std::optional<Eigen::Array2d> range;
  std::string view = "iso";
  std::optional<Eigen::Array3d> eye, at, up;
  double fov = 30.0, zoom = 1.0;
  int width = 1024, height = 1024;
  int supersample = 0; ///< 0: 2, with rays 1
  BackgroundKind background = BackgroundKind::White;
  std::optional<Eigen::Array3d> background_color, surface_color;
  bool culling = false, footprints = true, silhouettes = false, features = false;
  int thickness = ImageSpaceSettings().silhouette_thickness;
  std::optional<Eigen::Array3d> line_color;

  static auto
  listMembers()
  {
    using Own = PictureParameters;
    return std::make_tuple(Member{"color", &Own::color},
                           Member{"colormap", &Own::colormap},
                           Member{"range", &Own::range},
                           Member{"view", &Own::view},
                           Member{"eye", &Own::eye},
                           Member{"at", &Own::at},
                           Member{"up", &Own::up},
                           Member{"fov", &Own::fov},
                           Member{"zoom", &Own::zoom},
                           Member{"width", &Own::width},
                           Member{"height", &Own::height},
                           Member{"supersample", &Own::supersample},
                           Member{"background", &Own::background},
                           Member{"background_color", &Own::background_color},
                           Member{"surface_color", &Own::surface_color},
                           Member{"culling", &Own::culling},
                           Member{"footprints", &Own::footprints},
                           Member{"silhouettes", &Own::silhouettes},
                           Member{"features", &Own::features},
                           Member{"thickness", &Own::thickness},
                           Member{"line_color", &Own::line_color});
  }
};

/** \brief What rays do, and what they meet. */
struct RayParameters {
  int depth = 4;
  bool shadows = true;
  int light_samples = 16, occlusion = 0;
  double occlusion_distance = 0.0;
  double reflect = 0.0, transparent = 0.0, index = 1.0;
  std::optional<SplatParameters> splats; ///< none: the usual ones

  static auto
  listMembers()
  {
    using Own = RayParameters;
    return std::make_tuple(Member{"depth", &Own::depth},
                           Member{"shadows", &Own::shadows},
                           Member{"light_samples", &Own::light_samples},
                           Member{"occlusion", &Own::occlusion},
                           Member{"occlusion_distance", &Own::occlusion_distance},
                           Member{"reflect", &Own::reflect},
                           Member{"transparent", &Own::transparent},
                           Member{"index", &Own::index},
                           Member{"splats", &Own::splats});
  }
};

} // namespace pcl_uvol
