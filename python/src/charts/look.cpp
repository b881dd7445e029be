// SPDX-License-Identifier: BSD-3-Clause
#include "shared/look.h"

#include "common/parameter_json.h"
#include "render/camera_choice.h"
#include "render/lighting.h"

#include <algorithm>
#include <optional>

namespace pcl_uvol::python {

Color
toColor(const Eigen::Array3d& numbers)
{
  if (!(numbers >= 0.0).all() || !(numbers <= 1.0).all())
    throw InvalidArgument("A colour is red, green and blue, from 0 to 1 each.");
  return {static_cast<float>(numbers[0]),
          static_cast<float>(numbers[1]),
          static_cast<float>(numbers[2])};
}

PictureParameters
readPictureParameters(const std::string& json)
{
  const auto parameters = readJson<PictureParameters>(json);
  if (parameters.width - parameters.margin < 1 || parameters.height < 1)
    throw InvalidArgument("A picture is at least 1 x 1 pixels.");
  if (parameters.range && !((*parameters.range)[0] < (*parameters.range)[1]))
    throw InvalidArgument("The range of colours is two numbers, the lower one first.");
  if (parameters.range && parameters.log && !((*parameters.range)[0] > 0.0))
    throw InvalidArgument("The range of logarithmic colours is two numbers above 0.");
  if (parameters.exaggerate && !(*parameters.exaggerate > 0.0).all())
    throw InvalidArgument("exaggerate is three factors above 0.");
  const ColorMap map =
      parameters.colormap == "auto" ? ColorMap() : ColorMap(parameters.colormap);
  if (parameters.log && map.isCategorical())
    throw InvalidArgument("Logarithmic colours need a map of shades, and " +
                          parameters.colormap + " is one of categories.");
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

Camera
makeCamera(const PictureParameters& parameters,
           const BoundingSphere& bounds,
           const std::array<double, 3>& origin,
           const CloudView* cloud)
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
  choice.view = parameters.view;
  choice.eye = place(parameters.eye);
  choice.at = place(parameters.at);
  choice.up = direction(parameters.up);
  choice.fov = parameters.fov;
  choice.zoom = parameters.zoom;
  const int width = parameters.width - parameters.margin;
  return chooseCamera(
      choice, bounds, origin, static_cast<double>(width) / parameters.height, cloud);
}

std::string
findColorField(const PictureParameters& parameters, const CloudView& cloud)
{
  if (parameters.color == "auto")
    return usualColorField(cloud);
  return parameters.color == "none" ? "" : parameters.color;
}

ColorMapping
makeColorMapping(const PictureParameters& parameters,
                 const CloudView& cloud,
                 const std::string& field)
{
  if (parameters.colormap == "auto" && !parameters.log && !parameters.range)
    return usualColorMapping(cloud, field);
  ColorMapping mapping;
  if (parameters.colormap != "auto")
    mapping.map = ColorMap(parameters.colormap);
  if (parameters.range)
    mapping.range = {(*parameters.range)[0], (*parameters.range)[1]};
  mapping.is_logarithmic = parameters.log;
  return mapping;
}

void
addMargin(Image& image, const Background& background, int columns)
{
  const std::size_t row_bytes = 4 * std::size_t{image.width};
  std::vector<std::uint8_t> wide;
  wide.reserve((row_bytes + 4 * static_cast<std::size_t>(columns)) * image.height);
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const auto begin =
        image.color.begin() + static_cast<std::ptrdiff_t>(row * row_bytes);
    wide.insert(wide.end(), begin, begin + static_cast<std::ptrdiff_t>(row_bytes));
    const float below =
        (static_cast<float>(row) + 0.5f) / static_cast<float>(image.height);
    const Rgba color = background.kind == Background::Kind::Transparent
                           ? 0
                           : toRgba(backgroundAt(background, below));
    for (int k = 0; k < 4 * columns; ++k)
      wide.push_back(static_cast<std::uint8_t>(color >> (8 * (k % 4))));
  }
  image.color = std::move(wide);
  image.width += static_cast<std::uint32_t>(columns);
}

} // namespace pcl_uvol::python
