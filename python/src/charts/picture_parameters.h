// SPDX-License-Identifier: BSD-3-Clause
// What pictures are asked for with: the options of uvol_render and uvol_raytrace by
// their names.
#pragma once

#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/render/image_space/backend.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

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

constexpr std::array<EnumWord<SmoothingFilter>, 4>
listWords(SmoothingFilter)
{
  return {{{SmoothingFilter::None, "none"},
           {SmoothingFilter::Box, "box"},
           {SmoothingFilter::Gaussian, "gaussian"},
           {SmoothingFilter::AlleviatedGaussian, "alleviated"}}};
}

/** \brief How a surface reflects light, see Material. */
struct MaterialParameters {
  double ambient = Material().ambient, diffuse = Material().diffuse;
  double specular = Material().specular, shininess = Material().shininess;

  static auto
  listMembers()
  {
    using Own = MaterialParameters;
    return std::make_tuple(Member{"ambient", &Own::ambient},
                           Member{"diffuse", &Own::diffuse},
                           Member{"specular", &Own::specular},
                           Member{"shininess", &Own::shininess});
  }
};

/** \brief Steps of the passes in image space that few change, by the names of the
 * tools' options. */
struct PassParameters {
  int fill = ImageSpaceSettings().background_fill;
  int occluded = ImageSpaceSettings().occluded_fill;
  double layers = ImageSpaceSettings().layer_distance;
  bool shading = true;
  double occlusion = ImageSpaceSettings().ambient_occlusion;
  SmoothingFilter smoothing = ImageSpaceSettings().smoothing;
  int smoothings = ImageSpaceSettings().smoothing_iterations;
  double silhouette_threshold = ImageSpaceSettings().silhouette_threshold;
  double feature_threshold = ImageSpaceSettings().feature_threshold;
  bool antialias = true;
  double antialias_threshold = ImageSpaceSettings().anti_aliasing_threshold;

  static auto
  listMembers()
  {
    using Own = PassParameters;
    return std::make_tuple(Member{"fill", &Own::fill},
                           Member{"occluded", &Own::occluded},
                           Member{"layers", &Own::layers},
                           Member{"shading", &Own::shading},
                           Member{"occlusion", &Own::occlusion},
                           Member{"smoothing", &Own::smoothing},
                           Member{"smoothings", &Own::smoothings},
                           Member{"silhouette_threshold", &Own::silhouette_threshold},
                           Member{"feature_threshold", &Own::feature_threshold},
                           Member{"antialias", &Own::antialias},
                           Member{"antialias_threshold", &Own::antialias_threshold});
  }
};

/** \brief Camera, size, colours, lights and lines of a picture. */
struct PictureParameters {
  std::string color = "auto";    ///< a field, rgb, none; auto: see usualColorField
  std::string colormap = "auto"; ///< auto: see usualColorMapping
  std::optional<Eigen::Array2d> range;
  bool log = false;
  std::string view = "iso";
  std::optional<Eigen::Array3d> eye, at, up;
  double fov = 30.0, zoom = 1.0;
  bool parallel = false; ///< no perspective, as CameraChoice says
  int width = 1024, height = 1024;
  int supersample = 0; ///< 0: 2, with rays 1
  BackgroundKind background = BackgroundKind::White;
  std::optional<Eigen::Array3d> background_color, surface_color;
  std::optional<Eigen::Array3d> exaggerate; ///< factors along the axes
  std::vector<Eigen::Array3d> lights;       ///< directions; none: the usual ones
  MaterialParameters material;
  PassParameters passes;
  bool culling = false, footprints = true, silhouettes = false, features = false;
  int thickness = ImageSpaceSettings().silhouette_thickness;
  std::optional<Eigen::Array3d> line_color;
  std::vector<double> opacity; ///< of the isovalues; none: they are opaque
  bool bar = true;             ///< that explains the colours
  bool ticks = false, box = false, triad = false, scale_bar = false;
  std::string unit, title;
  std::vector<std::string> views; ///< in one picture; none: view
  int frames = 1;                 ///< of a full turn

  static auto
  listMembers()
  {
    using Own = PictureParameters;
    return std::make_tuple(Member{"color", &Own::color},
                           Member{"colormap", &Own::colormap},
                           Member{"range", &Own::range},
                           Member{"log", &Own::log},
                           Member{"view", &Own::view},
                           Member{"eye", &Own::eye},
                           Member{"at", &Own::at},
                           Member{"up", &Own::up},
                           Member{"fov", &Own::fov},
                           Member{"parallel", &Own::parallel},
                           Member{"zoom", &Own::zoom},
                           Member{"width", &Own::width},
                           Member{"height", &Own::height},
                           Member{"supersample", &Own::supersample},
                           Member{"background", &Own::background},
                           Member{"background_color", &Own::background_color},
                           Member{"surface_color", &Own::surface_color},
                           Member{"exaggerate", &Own::exaggerate},
                           Member{"lights", &Own::lights},
                           Member{"material", &Own::material},
                           Member{"passes", &Own::passes},
                           Member{"culling", &Own::culling},
                           Member{"footprints", &Own::footprints},
                           Member{"silhouettes", &Own::silhouettes},
                           Member{"features", &Own::features},
                           Member{"thickness", &Own::thickness},
                           Member{"line_color", &Own::line_color},
                           Member{"opacity", &Own::opacity},
                           Member{"bar", &Own::bar},
                           Member{"ticks", &Own::ticks},
                           Member{"box", &Own::box},
                           Member{"triad", &Own::triad},
                           Member{"scale_bar", &Own::scale_bar},
                           Member{"unit", &Own::unit},
                           Member{"title", &Own::title},
                           Member{"views", &Own::views},
                           Member{"frames", &Own::frames});
  }
};

/** \brief What rays do, and what they meet. */
struct RayParameters {
  int depth = 4;
  bool shadows = true;
  int light_samples = 16, occlusion = 0;
  double occlusion_distance = 0.0;
  double reflect = 0.0, transparent = 0.0, index = 1.0;
  bool culling = false;
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
                           Member{"culling", &Own::culling},
                           Member{"splats", &Own::splats});
  }
};

} // namespace pcl_uvol
