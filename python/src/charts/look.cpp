// SPDX-License-Identifier: BSD-3-Clause
#include "charts/look.h"

#include "charts/color_bar.h"
#include "common/parameter_json.h"
#include "render/camera_choice.h"
#include "render/image_space/frame.h"
#include "render/lighting.h"

#include <algorithm>
#include <optional>

namespace pcl_uvol::python {

Color
toColor(const Eigen::Array3d& numbers)
{
  if (!(numbers >= 0.0).all() || !(numbers <= 1.0).all())
    throw InvalidArgument("bad_picture_color", {});
  return {static_cast<float>(numbers[0]),
          static_cast<float>(numbers[1]),
          static_cast<float>(numbers[2])};
}

namespace {

void
checkColors(const PictureParameters& parameters)
{
  if (parameters.range && !((*parameters.range)[0] < (*parameters.range)[1]))
    throw InvalidArgument("bad_picture_range", {});
  if (parameters.range && parameters.log && !((*parameters.range)[0] > 0.0))
    throw InvalidArgument("bad_logarithmic_range", {});
  const ColorMap map =
      parameters.colormap == "auto" ? ColorMap() : ColorMap(parameters.colormap);
  if (parameters.log && map.isCategorical())
    throw InvalidArgument("logarithms_of_categories", {{"map", parameters.colormap}});
}

void
checkFigure(const PictureParameters& parameters)
{
  if (!parameters.unit.empty() && !parameters.ticks && !parameters.scale_bar)
    throw InvalidArgument("picture_unit_alone", {});
  if (!parameters.views.empty() && parameters.eye)
    throw InvalidArgument("picture_views_and_eye", {});
  if (parameters.scale_bar && parameters.exaggerate &&
      (*parameters.exaggerate != (*parameters.exaggerate)[0]).any())
    throw InvalidArgument("scale_bar_of_several_scales", {});
  if (!makeFigure(parameters).fits(parameters.width, parameters.height))
    throw InvalidArgument("picture_too_small_for_views", {});
}

} // namespace

PictureParameters
readPictureParameters(const std::string& json)
{
  const auto parameters = readJson<PictureParameters>(json);
  for (const int size : {parameters.width, parameters.height})
    if (size < 1 || size > View::largest_size / std::max(parameters.supersample, 1))
      throw InvalidArgument("bad_picture_size",
                            {{"most", View::largest_size},
                             {"width", parameters.width},
                             {"height", parameters.height}});
  if (parameters.at && !parameters.eye)
    throw InvalidArgument("picture_at_without_eye", {});
  if (parameters.frames < 1)
    throw InvalidArgument("picture_without_frames", {});
  if (parameters.exaggerate && !(*parameters.exaggerate > 0.0).all())
    throw InvalidArgument("bad_exaggerate", {});
  checkColors(parameters);
  checkFigure(parameters);
  return parameters;
}

Background
makeBackground(const PictureParameters& parameters)
{
  Background background;
  if (parameters.background == BackgroundKind::Gradient)
    background.kind = Background::Kind::Gradient;
  else if (parameters.background == BackgroundKind::Transparent)
    background.kind = Background::Kind::Transparent;
  else if (parameters.background == BackgroundKind::Black)
    background.color = {0.0f, 0.0f, 0.0f};
  if (parameters.background_color)
    background.color = toColor(*parameters.background_color);
  return background;
}

Material
makeMaterial(const PictureParameters& parameters)
{
  Material material;
  if (parameters.surface_color)
    material.color = toColor(*parameters.surface_color);
  material.ambient = parameters.material.ambient;
  material.diffuse = parameters.material.diffuse;
  material.specular = parameters.material.specular;
  material.shininess = parameters.material.shininess;
  return material;
}

std::vector<Light>
makeLights(const PictureParameters& parameters)
{
  if (parameters.lights.empty())
    return defaultLights();
  std::vector<Light> lights;
  for (const Eigen::Array3d& direction : parameters.lights)
    lights.emplace_back().position = direction;
  return lights;
}

uvol_tools::Figure
makeFigure(const PictureParameters& parameters)
{
  uvol_tools::Figure figure;
  figure.has_ticks = parameters.ticks;
  figure.has_box = parameters.box;
  figure.has_triad = parameters.triad;
  figure.has_scale_bar = parameters.scale_bar;
  figure.unit = parameters.unit;
  figure.title = parameters.title;
  figure.views = parameters.views;
  return figure;
}

Camera
makeCamera(const PictureParameters& parameters,
           const SeenSurface& seen,
           const std::array<double, 3>& origin,
           const uvol_tools::PictureCell& cell,
           double angle)
{
  const auto direction = [](const std::optional<Eigen::Array3d>& numbers) {
    return numbers ? std::optional<Eigen::Vector3d>(numbers->matrix()) : std::nullopt;
  };
  const auto place = [&](std::optional<Eigen::Array3d> numbers) {
    if (numbers && parameters.exaggerate)
      *numbers *= *parameters.exaggerate;
    return direction(numbers);
  };
  CameraChoice choice;
  choice.view = cell.view.empty() ? parameters.view : cell.view;
  choice.eye = place(parameters.eye);
  choice.at = place(parameters.at);
  choice.up = direction(parameters.up);
  choice.fov = parameters.fov;
  choice.is_parallel = parameters.parallel;
  choice.zoom = parameters.zoom;
  choice.fill = cell.fill;
  choice.turns = parameters.frames > 1;
  const double aspect = static_cast<double>(cell.width) / cell.height;
  return orbit(choice, chooseCamera(choice, seen, origin, aspect), angle);
}

std::string
findColorField(const PictureParameters& parameters, const CloudView& cloud)
{
  return resolveColor(cloud, parameters.color);
}

ColorMapping
makeColorMapping(const PictureParameters& parameters,
                 const CloudView& cloud,
                 const LabelNames& labels,
                 const std::string& field)
{
  if (parameters.colormap == "auto" && !parameters.log && !parameters.range)
    return uvol_tools::mapUsually(cloud, labels, field);
  ColorMapping mapping;
  if (parameters.colormap != "auto")
    mapping.map = ColorMap(parameters.colormap);
  if (parameters.range)
    mapping.range = {(*parameters.range)[0], (*parameters.range)[1]};
  mapping.is_logarithmic = parameters.log;
  return mapping;
}

} // namespace pcl_uvol::python
