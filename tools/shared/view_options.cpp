// SPDX-License-Identifier: BSD-3-Clause
#include "shared/view_options.h"

#include "charts/color_bar.h"
#include "common/numbers.h"
#include "common/records.h"
#include "expressions/formula.h"
#include "render/camera_choice.h"
#include "render/image_space/frame.h"
#include "render/point_colors.h"
#include "render/stretch_surface.h"
#include "shared/point_files.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace uvol_tools {

namespace {

Eigen::Vector3d
toVector(const std::vector<double>& numbers)
{
  return {numbers[0], numbers[1], numbers[2]};
}

/** True for what -color means by itself. */
bool
isColorName(const std::string& color)
{
  return color == "auto" || color == "none" || color == "rgb" || color == "rgba";
}

} // namespace

pcl_uvol::Color
toColor(const std::string& option, const std::vector<double>& numbers)
{
  for (const double number : numbers)
    if (number < 0.0 || number > 1.0)
      throw UsageError("-" + option + " takes three numbers from 0 to 1.");
  return {static_cast<float>(numbers[0]),
          static_cast<float>(numbers[1]),
          static_cast<float>(numbers[2])};
}

void
ViewOptions::declareScene(Options& options, SizeOf size)
{
  options.group("Picture");
  options.choice(
      "view", pcl_uvol::Camera::viewNames(), view_, "side that the camera looks from");
  options.numbers("eye", "x,y,z", 3, eye_, "position of the camera, instead of -view")
      .rare();
  options
      .numbers(
          "at", "x,y,z", 3, at_, "point that the camera looks at (default the centre)")
      .rare();
  options
      .numbers("up",
               "x,y,z",
               3,
               up_,
               "upward direction of the image and of -view (default 0,0,1)")
      .rare();
  options.number("fov", fov_, 0.01, 179.0, "vertical field of view in degrees").rare();
  options
      .flag("parallel", is_parallel_, "use a parallel projection, without perspective")
      .rare();
  options.number("zoom", zoom_, 0.01, 1e4, "enlargement of the image about its centre")
      .rare();
  options.flag("culling", culls_, "omit back faces, which closed surfaces do not need")
      .rare();
  if (size == SizeOf::Picture)
    size_.declareSize(options);
  else
    size_.declarePixels(options);
  options
      .text("background",
            "r,g,b|name",
            background_text_,
            "white, black, gradient, transparent, or a colour from 0 to 1 (default "
            "white)")
      .rare();
  options.text(
      "color",
      "field",
      color_,
      "colour by a scalar field or an expression, log10(rho) or |grad(rho)|, by "
      "rgb or by none (default: rgb if there, else isovalue if there are several)");
  colors_.declare(options);
  options.flag("no-bar", has_bar_, "omit the colour bar", false).rare();
  options
      .numbers("surface-color",
               "r,g,b",
               3,
               surface_color_,
               "colour of points without a colour, 0 to 1")
      .rare();
}

void
ViewOptions::declareExaggeration(Options& options)
{
  options
      .numbers("exaggerate",
               "x,y,z",
               3,
               exaggeration_,
               "stretch the image along the axes, such as 1,1,100; -eye and -at are "
               "positions in the data")
      .rare();
}

void
ViewOptions::declareFigure(Options& options)
{
  figure_.declare(options);
}

void
ViewOptions::declareResolution(Options& options)
{
  options.group("Picture");
  options
      .integer("supersample",
               supersampling_,
               1,
               8,
               "samples per pixel in each direction (default 2, with rays 1)")
      .rare();
  size_.declareDpi(options);
}

void
ViewOptions::declareOrbit(Options& options)
{
  options.group("Picture");
  options.integer("orbit", frames_, 1, 100000, "frames of a full turn about -up");
}

void
ViewOptions::declareLighting(Options& options)
{
  options.group("Light", true);
  options.text("lights",
               "x,y,z;...",
               lights_text_,
               "directions of the lights: x right, y up, z to the viewer");
  options.number("ambient", material_.ambient, 0.0, 1e3, "strength of ambient light");
  options.number(
      "diffuse", material_.diffuse, 0.0, 1e3, "strength of diffuse reflection");
  options.number("specular", material_.specular, 0.0, 1e3, "strength of highlights");
  options.number("shininess", material_.shininess, 0.0, 1e4, "exponent of highlights");
}

void
ViewOptions::parseBackground()
{
  pcl_uvol::Background& background = background_;
  using Kind = pcl_uvol::Background::Kind;
  if (background_text_ == "gradient")
    background.kind = Kind::Gradient;
  else if (background_text_ == "transparent")
    background.kind = Kind::Transparent;
  else if (background_text_ == "black")
    background.color = {0.0f, 0.0f, 0.0f};
  else if (background_text_ != "white") {
    const auto color = parseNumbers("background", background_text_, 3);
    background.color = toColor("background", color);
  }
}

void
ViewOptions::parseLights()
{
  if (lights_text_.empty())
    return;
  lights_.clear();
  for (std::size_t begin = 0; begin <= lights_text_.size();) {
    const std::size_t end =
        std::min(lights_text_.find(';', begin), lights_text_.size());
    pcl_uvol::Light light;
    light.position =
        toVector(parseNumbers("lights", lights_text_.substr(begin, end - begin), 3));
    if (light.position.isZero())
      throw UsageError("-lights takes directions, and 0,0,0 is not a direction.");
    lights_.push_back(light);
    begin = end + 1;
  }
}

void
ViewOptions::check(const Options& options, bool may_have_camera)
{
  constexpr int most = pcl_uvol::View::largest_size;
  size_.parse();
  for (const int size : {getWidth(), getHeight()})
    if (size < 1 || size * std::max(supersampling_, 1) > most)
      throw UsageError("-size is from 1x1 to " + std::to_string(most) + "x" +
                       std::to_string(most) + " pixels before averaging, not " +
                       std::to_string(getWidth()) + " x " +
                       std::to_string(getHeight()) + ".");
  if (options.given("view") && options.given("eye"))
    throw UsageError("-view and -eye both say where the camera is: give one of them.");
  if (is_parallel_ && options.given("fov"))
    throw UsageError("-parallel has no field of view: -zoom enlarges the picture.");
  if (!options.given("eye") && options.given("at") && !may_have_camera)
    throw UsageError("-at needs -eye.");
  if (!up_.empty() && toVector(up_).isZero(0.0))
    throw UsageError("-up takes a direction, and 0,0,0 is not a direction.");
  colors_.check();
  figure_.check(options, size_.get());
  if (options.given("scale-bar") && isExaggerated() &&
      (exaggeration_[0] != exaggeration_[1] || exaggeration_[0] != exaggeration_[2]))
    throw UsageError(
        "-scale-bar needs one scale for all directions, and -exaggerate has "
        "several; -ticks show them.");
  for (const double factor : exaggeration_)
    if (!(factor > 0.0))
      throw UsageError("-exaggerate takes three factors above 0.");
  if (!surface_color_.empty())
    material_.color = toColor("surface-color", surface_color_);
  parseBackground();
  parseLights();
}

void
ViewOptions::addColor(const Options& options,
                      pcl_uvol::Dataset& points,
                      pcl_uvol::Report& report)
{
  labels_ = points.labels;
  if (!isColorName(color_))
    addField(points,
             color_,
             "from points on a surface, but from samples: uvol_isosurface -color "
             "computes them there",
             options,
             report);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(points.cloud);
  warnOfNames(cloud, labels_, color_, report);
  if (colors_.isLogarithmic()) {
    const std::string field = colorField(cloud);
    pcl_uvol::warnOfLogarithms(cloud, field, mapColors(cloud, field), report);
  }
}

void
ViewOptions::addColorOfSamples(const Options& options,
                               pcl_uvol::Dataset& samples,
                               pcl_uvol::Report& report,
                               const std::array<double, 3>& periodic)
{
  labels_ = samples.labels;
  if (hasColorOfSamples())
    addField(samples, color_, options, report, periodic);
}

bool
ViewOptions::hasColorOfSamples() const
{
  return pcl_uvol::mayHaveDerivative(color_);
}

int
ViewOptions::getSupersampling() const
{
  constexpr int usual = 2;
  if (supersampling_ > 0)
    return supersampling_;
  return usual * std::max(getWidth(), getHeight()) <= pcl_uvol::View::largest_size
             ? usual
             : 1;
}

std::string
ViewOptions::colorField(const pcl_uvol::CloudView& cloud) const
{
  const std::string field = pcl_uvol::resolveColor(cloud, color_);
  if (pcl_uvol::findField(cloud.fields, field))
    return field;
  // What addColor() calls an expression, where that was done to another surface.
  std::string name(pcl_uvol::trimmed(field));
  name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
  return pcl_uvol::findField(cloud.fields, name) ? name : field;
}

pcl_uvol::ColorMapping
ViewOptions::colorMapping(const pcl_uvol::CloudView& cloud) const
{
  pcl_uvol::ColorMapping mapping = mapColors(cloud, colorField(cloud));
  if (!shared_)
    return mapping;
  if (colors_.isAutomatic() && !shared_->are_categories)
    mapping.map = colors_.getMap();
  if (!mapping.range)
    mapping.range = shared_->range;
  return mapping;
}

pcl_uvol::ColorMapping
ViewOptions::mapColors(const pcl_uvol::CloudView& cloud, const std::string& field) const
{
  return colors_.isAutomatic() ? mapUsually(cloud, labels_, field)
                               : colors_.mapFor(cloud, field);
}

void
ViewOptions::exaggerate(pcl_uvol::Dataset& surface) const
{
  if (isExaggerated())
    pcl_uvol::stretchSurface(surface, getFactors());
}

pcl_uvol::Camera
ViewOptions::makeCamera(const pcl_uvol::SeenSurface& seen,
                        const std::array<double, 3>& origin,
                        const PictureCell& cell,
                        std::uint64_t frame) const
{
  const auto direction = [](const std::vector<double>& numbers) {
    return numbers.empty() ? std::nullopt : std::optional(toVector(numbers));
  };
  const auto place = [&](const std::vector<double>& numbers) {
    std::optional<Eigen::Vector3d> point = direction(numbers);
    if (point)
      *point = point->cwiseProduct(getFactors());
    return point;
  };
  const pcl_uvol::CameraChoice choice{cell.view.empty() ? view_ : cell.view,
                                      place(eye_),
                                      place(at_),
                                      direction(up_),
                                      fov_,
                                      is_parallel_,
                                      zoom_,
                                      cell.fill,
                                      frames_ > 1};
  const double aspect = static_cast<double>(cell.width) / cell.height;
  return pcl_uvol::orbit(
      choice, chooseCamera(choice, seen, origin, aspect), angleOf(frame));
}

pcl_uvol::Camera
ViewOptions::adjusted(const Options& options,
                      pcl_uvol::Camera camera,
                      const std::array<double, 3>& origin) const
{
  const Eigen::Vector3d shift(origin.data());
  if (!eye_.empty())
    camera.eye = toVector(eye_) - shift;
  if (!at_.empty())
    camera.at = toVector(at_) - shift;
  if (!up_.empty())
    camera.up = toVector(up_);
  if (options.given("fov"))
    camera.vertical_fov = fov_;
  if (is_parallel_)
    camera = camera.parallel();
  return pcl_uvol::zoomed(camera, zoom_);
}

pcl_uvol::Camera
ViewOptions::turned(const pcl_uvol::Camera& camera, std::uint64_t frame) const
{
  return camera.orbited(angleOf(frame));
}

double
ViewOptions::angleOf(std::uint64_t frame) const
{
  return 360.0 * static_cast<double>(frame) / static_cast<double>(frames_);
}

} // namespace uvol_tools
