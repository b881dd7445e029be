// SPDX-License-Identifier: BSD-3-Clause
#include "shared/render_options.h"

#include "charts/color_bar.h"
#include "gl/gl_backend.h"
#include "render/image_space/cpu_backend.h"
#include "render/surface_cloud.h"
#include "shared/fallback_backend.h"
#include "shared/flat_colors.h"
#include "web/surface_page.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <filesystem>
#include <memory>
#include <numeric>
#include <utility>

namespace uvol_tools {

namespace {

constexpr double largest = 1e9;

/** What -backend names: auto takes a graphics card if there is one that can draw, else
 * the CPU, which is far faster than OpenGL in software.
 * \param card the only one that may draw */
std::shared_ptr<pcl_uvol::ImageSpaceBackend>
makeBackend(const std::string& name, std::optional<int> card)
{
  if (name == "cpu")
    return std::make_shared<pcl_uvol::CpuBackend>();
  if (name != "auto" || card)
    return std::make_shared<pcl_uvol::GlBackend>(
        pcl_uvol::createHeadlessContext(name == "auto" ? "egl" : name, card));
  try {
    if (const auto context = pcl_uvol::findHardwareContext())
      return std::make_shared<FallbackBackend>(
          std::make_shared<pcl_uvol::GlBackend>(context));
  }
  catch (const pcl_uvol::GlError&) { // a card without what drawing needs
  }
  return std::make_shared<pcl_uvol::CpuBackend>();
}

} // namespace

void
RenderOptions::declareView(Options& options)
{
  declareScene(options);
  declareResolution(options);
  options
      .choice("backend",
              {"auto", "cpu", "osmesa", "egl"},
              backend_,
              "renderer; auto: OpenGL if there is a GPU, otherwise the CPU")
      .rare();
  options
      .integer(
          "device",
          card_,
          0,
          1000,
          "zero-based index of the graphics card (default: the first that can draw)")
      .rare();
}

void
RenderOptions::declareOpacity(Options& options)
{
  options.group("Picture");
  options.numbers(
      "opacity",
      "a,...",
      0,
      opacities_,
      "opacity per isovalue, lowest first, or one for all (0 transparent, 1 "
      "opaque)");
}

void
RenderOptions::declarePasses(Options& options)
{
  using pcl_uvol::ImageSpaceSettings;
  ImageSpaceSettings& s = settings_;
  constexpr int most = 1000000;
  options.group("Drawing points", true);
  options.flag("no-footprints", s.footprints, "draw every point as one pixel", false);
  options.integer(
      "fill", s.background_fill, 0, most, "largest number of background fills");
  options.integer(
      "occluded", s.occluded_fill, 0, most, "largest number of occluded fills");
  options.number("layers",
                 s.layer_distance,
                 1e-9,
                 1.0,
                 "smallest difference in depth of two layers");
  options.flag("no-shading",
               s.shading,
               "draw colours without light (without -color: white, for line drawings)",
               false);
  options.number(
      "occlusion",
      s.ambient_occlusion,
      0.0,
      1.0,
      "strength of ambient occlusion, which darkens pits and creases (0: off)");
  options.choice("smoothing",
                 {"none", "box", "gaussian", "alleviated"},
                 smoothing_,
                 "filter of colours");
  options.integer(
      "smoothings", s.smoothing_iterations, 0, 6, "number of smoothing passes");
  options.group("Picture");
  options.flag("silhouettes", s.silhouettes, "draw silhouettes").rare();
  options.group("Lines", true);
  options.number("silhouette-threshold",
                 s.silhouette_threshold,
                 1e-9,
                 largest,
                 "least step in depth");
  options.integer("thickness",
                  s.silhouette_thickness,
                  1,
                  7,
                  "thickness t of silhouettes: 2 t - 1 pixels");
  options.group("Picture");
  options.flag("features", s.feature_lines, "draw feature lines").rare();
  options.group("Lines", true);
  options.number("feature-threshold",
                 s.feature_threshold,
                 1e-9,
                 largest,
                 "least 1 - cos between normals");
  options.numbers(
      "line-color", "r,g,b", 3, line_color_, "colour of lines, 0 to 1 (default black)");
  options.flag("no-antialias", s.anti_aliasing, "switch anti-aliasing off", false);
  options.number("antialias-threshold",
                 s.anti_aliasing_threshold,
                 1e-9,
                 largest,
                 "least step in depth that is smoothed");
  declareLighting(options);
}

const std::vector<std::string>&
RenderOptions::passNames()
{
  static const std::vector<std::string> names{"no-footprints",
                                              "fill",
                                              "occluded",
                                              "layers",
                                              "no-shading",
                                              "occlusion",
                                              "smoothing",
                                              "smoothings",
                                              "silhouettes",
                                              "silhouette-threshold",
                                              "thickness",
                                              "features",
                                              "feature-threshold",
                                              "line-color",
                                              "no-antialias",
                                              "antialias-threshold"};
  return names;
}

void
RenderOptions::check(const Options& options)
{
  ViewOptions::check(options);
  if (options.given("device") && backend_ != "auto" && backend_ != "egl")
    throw UsageError("-device is a graphics card, and -backend " + backend_ +
                     " draws on none.");
  for (const double opacity : opacities_)
    if (!(opacity >= 0.0 && opacity <= 1.0))
      throw UsageError("-opacity takes numbers from 0 to 1.");
  if (!line_color_.empty())
    settings_.line_color = toColor("line-color", line_color_);
  using Filter = pcl_uvol::SmoothingFilter;
  settings_.smoothing = smoothing_ == "none"       ? Filter::None
                        : smoothing_ == "box"      ? Filter::Box
                        : smoothing_ == "gaussian" ? Filter::Gaussian
                                                   : Filter::AlleviatedGaussian;
  settings_.cull_back_faces = culls();
  settings_.background = getBackground();
  settings_.material = getMaterial();
  settings_.lights = getLights();
}

void
RenderOptions::applyLook(const Options& options,
                         const pcl_uvol::CloudView& cloud,
                         pcl_uvol::ImageSpaceRendererBase& renderer) const
{
  renderer.settings() = settings_;
  renderer.setNumberOfThreads(options.threads());
  renderer.setColorField(colorField(cloud));
  const pcl_uvol::ColorMapping mapping = colorMapping(cloud);
  renderer.setColorMap(mapping.map);
  renderer.setLogarithmicColors(mapping.is_logarithmic);
  if (mapping.range)
    renderer.setColorRange((*mapping.range)[0], (*mapping.range)[1]);
}

std::string
RenderOptions::drawCloud(const Options& options,
                         const pcl_uvol::Dataset& surface,
                         const std::string& output,
                         pcl_uvol::Report& report) const
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(surface.cloud);
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&surface.cloud, [](const void*) {}));
  applyLook(options, cloud, renderer);
  if (options.given("color") && !colorField(cloud).empty())
    showColorsWithoutLight(renderer.settings());
  else if (isInvisible(settings_))
    report.warn("white_on_white");
  renderer.settings().background = getBackgroundOfViews();
  renderer.setOpacities(opacities_);
  renderer.setBackend(makeBackend(
      backend_, options.given("device") ? std::optional(card_) : std::nullopt));
  const auto prepared = std::make_shared<pcl_uvol::PreparedSurface>(
      surface.cloud, options.threads(), report.progress);
  renderer.setPreparedSurface(prepared);
  renderer.setSupersampling(getSupersampling());
  Subject subject{cloud, prepared->getBounds(), surface.origin};
  if (settings_.footprints)
    subject.find_discs = [&](const pcl_uvol::Camera& camera, const PictureCell& cell) {
      return prepared->findFittedDiscs(camera, cell.width, cell.height);
    };
  pcl_uvol::Report drawing;
  drawFrames(
      options,
      subject,
      [&](const pcl_uvol::Camera& camera, const PictureCell& cell, auto& image) {
        renderer.setSize(cell.width, cell.height);
        renderer.setCamera(camera);
        renderer.render(image);
        drawing = renderer.getReport();
      },
      [&] { return renderer.getColorRange(); },
      output,
      report);
  report.merge(drawing);
  return renderer.describeBackend();
}

void
RenderOptions::writePage(const Options& options,
                         const pcl_uvol::Dataset& surface,
                         const std::string& output,
                         pcl_uvol::Report& report) const
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(surface.cloud);
  std::vector<std::uint32_t> all(cloud.count);
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::SurfaceCloud points(cloud, all, options.threads(), report);
  Subject subject{cloud, points.getBounds(), surface.origin};
  if (settings_.footprints) {
    pcl_uvol::Footprints discs = points.findFootprints(options.threads(), report);
    subject.find_discs = [fitted = points.listFittedDiscs(discs, cloud.count)](
                             const auto&, const auto&) { return fitted; };
    points.setFootprints(std::move(discs));
  }
  SurfacePage page;
  page.title = std::filesystem::path(output).stem().string();
  page.camera =
      findCameraOf(withSharedBox(subject),
                   wholePicture(getHeight(), getHeight()),
                   [&](const pcl_uvol::SeenSurface& seen, const PictureCell& cell) {
                     return makeCamera(seen, surface.origin, cell);
                   });
  page.material = getMaterial();
  page.lights = getLights();
  page.background = getBackground().color;
  const std::string field = colorField(cloud);
  if (field.empty())
    points.setColor(pcl_uvol::toRgba(page.material.color));
  else {
    const pcl_uvol::ColorMapping mapping = colorMapping(cloud);
    const pcl_uvol::PointColors colors = colorPoints(cloud, field, mapping);
    points.setColors(colors.colors);
    if (drawsBar(cloud)) {
      page.field = getColors().getLabel(field);
      page.map = mapping.map;
      page.scale = colors.scale;
      page.categories = listNamedCategories(cloud, getLabels(), field, mapping.map);
    }
  }
  points.fadeBridged(page.background);
  const pcl_uvol::StepTimer timer(report, "write");
  writeSurfacePage(output, points, page);
}

} // namespace uvol_tools
