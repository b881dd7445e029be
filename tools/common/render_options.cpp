// SPDX-License-Identifier: BSD-3-Clause
#include "common/render_options.h"

#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/gl/gl_backend.h>
#include <pcl_uvol/io/color_bar.h>
#include <pcl_uvol/render/image_space/cpu_backend.h>

#include <algorithm>
#include <charconv>
#include <memory>

namespace uvol_tools {

namespace {

constexpr double largest = 1e9;

pcl_uvol::Color
toColor(const std::vector<double>& numbers)
{
  return {static_cast<float>(numbers[0]),
          static_cast<float>(numbers[1]),
          static_cast<float>(numbers[2])};
}

Eigen::Vector3d
toVector(const std::vector<double>& numbers)
{
  return {numbers[0], numbers[1], numbers[2]};
}

/** "640x480", or one number for a square. */
bool
parseSize(const std::string& text, int& width, int& height)
{
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  if (first.ec != std::errc())
    return false;
  height = width;
  if (first.ptr == end)
    return true;
  if (*first.ptr != 'x')
    return false;
  const auto second = std::from_chars(first.ptr + 1, end, height);
  return second.ec == std::errc() && second.ptr == end;
}

void
checkColor(const std::string& option, const std::vector<double>& numbers)
{
  for (const double number : numbers)
    if (number < 0.0 || number > 1.0)
      throw UsageError("-" + option + " takes three numbers from 0 to 1.");
}

/** What -backend names: auto takes a graphics card if there is one, else the CPU, which
 * is far faster than OpenGL in software. */
std::shared_ptr<pcl_uvol::ImageSpaceBackend>
makeBackend(const std::string& name)
{
  if (name == "cpu")
    return std::make_shared<pcl_uvol::CpuBackend>();
  const auto context = name == "auto" ? pcl_uvol::findHardwareContext()
                                      : pcl_uvol::createHeadlessContext(name);
  if (context)
    return std::make_shared<pcl_uvol::GlBackend>(context);
  return std::make_shared<pcl_uvol::CpuBackend>();
}

bool
hasColors(const pcl_uvol::CloudView& cloud)
{
  return pcl_uvol::findField(cloud.fields, "rgb") != nullptr ||
         pcl_uvol::findField(cloud.fields, "rgba") != nullptr;
}

} // namespace

void
RenderOptions::declareScene(Options& options)
{
  options.choice("view", pcl_uvol::Camera::viewNames(), view_, "side to look from");
  options.numbers("eye", "x,y,z", 3, eye_, "place of the camera, instead of -view");
  options.numbers("at", "x,y,z", 3, at_, "place that it looks at (default the centre)");
  options.numbers("up", "x,y,z", 3, up_, "direction that is upwards (default 0,0,1)");
  options.number("fov", fov_, 0.01, 179.0, "vertical field of view in degrees");
  options.text("size", "WxH", size_text_, "pixels of the picture (default 1024x1024)");
  options.text("background",
               "r,g,b|name",
               background_text_,
               "white, black, gradient, transparent, or a colour from 0 to 1 (default "
               "white)");
  options.text("color",
               "field",
               color_,
               "colour by a scalar field, by rgb or by none (default: rgb if there)");
  options.choice(
      "colormap", pcl_uvol::ColorMap::names(), color_map_, "colours of a scalar field");
  options.numbers("range", "low,high", 2, range_, "values at the ends of the colours");
  options.flag("no-bar", has_bar_, "no colour bar in the picture", false);
  options.numbers(
      "surface-color", "r,g,b", 3, surface_color_, "of points without a colour");
}

void
RenderOptions::declareView(Options& options)
{
  declareScene(options);
  options.integer(
      "supersample", supersampling_, 1, 8, "rays per pixel in each direction");
  options.choice("backend",
                 {"auto", "cpu", "osmesa", "egl"},
                 backend_,
                 "what draws; auto: OpenGL on a GPU where there is one, else the CPU");
}

void
RenderOptions::declarePasses(Options& options)
{
  using pcl_uvol::ImageSpaceSettings;
  ImageSpaceSettings& s = settings_;
  constexpr int most = 1000000;
  options.flag("no-culling", s.cull_back_faces, "draw back faces as well", false);
  options.flag(
      "no-footprints", s.footprints, "every point is one pixel, however near", false);
  options.integer("fill", s.background_fill, 0, most, "background fills at most");
  options.integer("occluded", s.occluded_fill, 0, most, "occluded fills at most");
  options.number(
      "layers", s.layer_distance, 1e-9, 1.0, "least distance of two layers in depth");
  options.flag("no-shading", s.shading, "a white surface, for lines alone", false);
  options.choice("smoothing",
                 {"none", "box", "gaussian", "alleviated"},
                 smoothing_,
                 "filter of colours");
  options.integer(
      "smoothings", s.smoothing_iterations, 0, 6, "times that it is applied");
  options.flag("silhouettes", s.silhouettes, "draw silhouettes");
  options.number("silhouette-threshold",
                 s.silhouette_threshold,
                 1e-9,
                 largest,
                 "least step in depth");
  options.integer(
      "thickness", s.silhouette_thickness, 1, 7, "of silhouettes, in pixels");
  options.flag("features", s.feature_lines, "draw feature lines");
  options.number("feature-threshold",
                 s.feature_threshold,
                 1e-9,
                 largest,
                 "least 1 - cos between normals");
  options.numbers("line-color", "r,g,b", 3, line_color_, "of lines (default black)");
  options.flag("no-antialias", s.anti_aliasing, "leave borders jagged", false);
  options.number("antialias-threshold",
                 s.anti_aliasing_threshold,
                 1e-9,
                 largest,
                 "least step in depth that is smoothed");
  options.text("lights",
               "x,y,z;...",
               lights_text_,
               "directions that light comes from: x right, y up, z to the viewer");
  options.number("ambient", s.material.ambient, 0.0, 1e3, "light from everywhere");
  options.number("diffuse", s.material.diffuse, 0.0, 1e3, "of the lights");
  options.number("specular", s.material.specular, 0.0, 1e3, "highlights");
  options.number("shininess", s.material.shininess, 0.0, 1e4, "exponent of highlights");
}

void
RenderOptions::parseBackground()
{
  pcl_uvol::Background& background = settings_.background;
  using Kind = pcl_uvol::Background::Kind;
  if (background_text_ == "gradient")
    background.kind = Kind::Gradient;
  else if (background_text_ == "transparent")
    background.kind = Kind::Transparent;
  else if (background_text_ == "black")
    background.color = {0.0f, 0.0f, 0.0f};
  else if (background_text_ != "white") {
    const auto color = parseNumbers("background", background_text_, 3);
    checkColor("background", color);
    background.color = toColor(color);
  }
}

void
RenderOptions::parseLights()
{
  if (lights_text_.empty())
    return;
  settings_.lights.clear();
  for (std::size_t begin = 0; begin <= lights_text_.size();) {
    const std::size_t end =
        std::min(lights_text_.find(';', begin), lights_text_.size());
    pcl_uvol::Light light;
    light.position =
        toVector(parseNumbers("lights", lights_text_.substr(begin, end - begin), 3));
    if (light.position.isZero())
      throw UsageError("-lights takes directions, and 0,0,0 is none.");
    settings_.lights.push_back(light);
    begin = end + 1;
  }
}

void
RenderOptions::check(const Options& options)
{
  constexpr int most = pcl_uvol::View::largest_size;
  if (!parseSize(size_text_, width_, height_))
    throw UsageError("-size is WxH in pixels, as in 1024x768, not '" + size_text_ +
                     "'.");
  for (const int size : {width_, height_})
    if (size < 1 || size * supersampling_ > most)
      throw UsageError("-size is from 1x1 to " + std::to_string(most) + "x" +
                       std::to_string(most) + " pixels before averaging, not " +
                       size_text_ + ".");
  if (options.given("view") && options.given("eye"))
    throw UsageError("-view and -eye both say where the camera is: give one of them.");
  if (!options.given("eye") && options.given("at"))
    throw UsageError("-at needs -eye.");
  if (!range_.empty() && !(range_[0] < range_[1]))
    throw UsageError("-range takes two numbers, the lower one first.");
  checkColor("surface-color", surface_color_);
  checkColor("line-color", line_color_);
  if (!surface_color_.empty())
    settings_.material.color = toColor(surface_color_);
  if (!line_color_.empty())
    settings_.line_color = toColor(line_color_);
  using Filter = pcl_uvol::SmoothingFilter;
  settings_.smoothing = smoothing_ == "none"       ? Filter::None
                        : smoothing_ == "box"      ? Filter::Box
                        : smoothing_ == "gaussian" ? Filter::Gaussian
                                                   : Filter::AlleviatedGaussian;
  parseBackground();
  parseLights();
}

std::string
RenderOptions::colorField(const pcl_uvol::CloudView& cloud) const
{
  if (color_ == "auto")
    return hasColors(cloud) ? "rgb" : "";
  return color_ == "none" ? "" : color_;
}

void
RenderOptions::applyLook(const Options& options,
                         const pcl_uvol::CloudView& cloud,
                         pcl_uvol::ImageSpaceRendererBase& renderer) const
{
  renderer.settings() = settings_;
  renderer.setNumberOfThreads(options.threads());
  renderer.setColorField(colorField(cloud));
  renderer.setColorMap(colorMap());
  if (!range_.empty())
    renderer.setColorRange(range_[0], range_[1]);
}

void
RenderOptions::configure(const Options& options,
                         const pcl_uvol::CloudView& cloud,
                         pcl_uvol::ImageSpaceRendererBase& renderer) const
{
  applyLook(options, cloud, renderer);
  renderer.setBackend(makeBackend(backend_));
  renderer.setSize(width_, height_);
  renderer.setSupersampling(supersampling_);
}

pcl_uvol::Camera
RenderOptions::makeCamera(const pcl_uvol::BoundingSphere& bounds,
                          const std::array<double, 3>& origin) const
{
  const Eigen::Vector3d shift(origin.data());
  pcl_uvol::Camera camera =
      pcl_uvol::Camera::fit(bounds, view_, fov_, static_cast<double>(width_) / height_);
  if (!eye_.empty()) {
    camera.eye = toVector(eye_) - shift;
    camera.up = {0.0, 0.0, 1.0};
    if (!at_.empty())
      camera.at = toVector(at_) - shift;
  }
  if (!up_.empty())
    camera.up = toVector(up_);
  return camera;
}

void
RenderOptions::decorate(const pcl_uvol::CloudView& cloud,
                        const pcl_uvol::ImageSpaceRendererBase& renderer,
                        pcl_uvol::Image& image) const
{
  const std::string field = colorField(cloud);
  if (!has_bar_ || field.empty() || field == "rgb" || field == "rgba")
    return;
  const auto& range = renderer.getColorRange();
  pcl_uvol::drawColorBar(image, colorMap(), range[0], range[1], field);
}

} // namespace uvol_tools
