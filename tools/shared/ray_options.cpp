// SPDX-License-Identifier: BSD-3-Clause
#include "shared/ray_options.h"

#include "charts/picture_file.h"
#include "render/point_colors.h"
#include "render/ray_tracing/fitted_splats.h"
#include "render/ray_tracing/gap_dots.h"
#include "surface/splat_input.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace uvol_tools {

void
RayOptions::declareRays(Options& options)
{
  options.integer("depth",
                  settings_.depth,
                  0,
                  10000,
                  "largest number of reflections and refractions of a ray");
  options.flag("no-shadows", shadows_, "draw no shadows", false);
  options
      .integer("light-samples",
               settings_.light_samples,
               1,
               4096,
               "shadow rays to a light that has a radius")
      .rare();
  options.integer("occlusion-rays",
                  settings_.occlusion_samples,
                  0,
                  4096,
                  "rays per point for ambient occlusion; 0: off");
  options
      .number(
          "occlusion-distance",
          settings_.occlusion_distance,
          0.0,
          1e30,
          "largest distance of occluders, a length; 0: a fifth of the scene's radius")
      .rare();
}

void
RayOptions::declareSurface(Options& options)
{
  options.number(
      "reflect", reflectivity_, 0.0, 1.0, "proportion of light that is reflected");
  options.number("transparent",
                 transparency_,
                 0.0,
                 1.0,
                 "proportion of light that passes through");
  options
      .number("index", refractive_index_, 0.01, 100.0, "refractive index of the inside")
      .rare();
  splats_.declare(options);
}

const std::vector<std::string>&
RayOptions::surfaceOptions()
{
  static const std::vector<std::string> names = {
      "reflect", "transparent", "index", "delta", "delta-abs", "lambda"};
  return names;
}

void
RayOptions::check(const Options& options) const
{
  splats_.parameters(options);
  if (reflectivity_ + transparency_ > 1.0)
    throw UsageError("-reflect and -transparent are together at most 1.");
}

void
RayOptions::apply(const Options& options,
                  const ViewOptions& view,
                  pcl_uvol::RayTracingSettings& settings) const
{
  settings.cull_back_faces = view.culls();
  if (options.given("depth"))
    settings.depth = settings_.depth;
  if (options.given("no-shadows"))
    settings.shadows = shadows_;
  if (options.given("light-samples"))
    settings.light_samples = settings_.light_samples;
  if (options.given("occlusion-rays"))
    settings.occlusion_samples = settings_.occlusion_samples;
  if (options.given("occlusion-distance"))
    settings.occlusion_distance = settings_.occlusion_distance;
}

pcl_uvol::Scene
RayOptions::makeScene(const ViewOptions& view,
                      const pcl_uvol::CloudView& cloud,
                      pcl_uvol::Splats&& splats,
                      std::array<double, 2>& range) const
{
  std::vector<pcl_uvol::Rgba> colors;
  const std::string field = view.colorField(cloud);
  if (!field.empty()) {
    const auto colored = pcl_uvol::colorPoints(cloud, field, view.colorMapping(cloud));
    range = {colored.scale.low, colored.scale.high};
    colors = colored.colors;
  }
  pcl_uvol::RayMaterial material;
  static_cast<pcl_uvol::Material&>(material) = view.getMaterial();
  material.reflectivity = reflectivity_;
  material.transparency = transparency_;
  material.refractive_index = refractive_index_;
  pcl_uvol::Scene scene = makeSplatScene(cloud,
                                         std::move(splats),
                                         colors,
                                         material,
                                         std::min(view.getWidth(), view.getHeight()));
  scene.lights = view.getLights();
  scene.background = view.getBackgroundOfViews();
  return scene;
}

pcl_uvol::Scene
makeSplatScene(const pcl_uvol::CloudView& cloud,
               pcl_uvol::Splats&& splats,
               const std::vector<pcl_uvol::Rgba>& colors,
               const pcl_uvol::RayMaterial& material,
               int side)
{
  if (splats.cloud.empty())
    throw pcl_uvol::InvalidArgument("splats_out_of_range", {});
  pcl_uvol::SplatObject object;
  if (!colors.empty())
    for (const std::uint32_t source : splats.sources)
      object.colors.push_back(colors[source]);
  object.splats =
      pcl::make_shared<pcl::PointCloud<pcl_uvol::PointSplat>>(std::move(splats.cloud));
  object.material = material;
  object.two_sided = splats.two_sided;
  object.rims = std::move(splats.rims);
  pcl_uvol::Scene scene;
  addWithDots(std::move(object), cloud, splats.sources, side, scene);
  return scene;
}

void
traceScene(const Options& options,
           const ViewOptions& view,
           pcl_uvol::RayTracer& tracer,
           const pcl_uvol::SceneFile& file,
           const std::string& output,
           pcl_uvol::Report& report)
{
  tracer.setNumberOfThreads(options.threads());
  tracer.setProgressCallback(report.progress);
  const auto findCamera = [&](std::uint64_t frame) {
    return file.camera
               ? view.turned(view.adjusted(options, *file.camera, file.origin), frame)
               : view.makeCamera(
                     {tracer.getBounds()},
                     file.origin,
                     ViewOptions::wholePicture(tracer.getWidth(), tracer.getHeight()),
                     frame);
  };
  const DataBox data{
      {}, Eigen::Vector3d(file.origin.data()), Eigen::Vector3d::Ones(), ""};
  pcl_uvol::Report tracing;
  for (std::uint64_t frame = 0; frame < view.countFrames(); ++frame) {
    const pcl_uvol::Camera seen_by = findCamera(frame);
    tracer.setCamera(seen_by);
    pcl_uvol::Image image;
    tracer.render(image);
    tracing = tracer.getReport();
    std::vector<pcl_uvol::ImageText> texts = describeOrigin(options);
    addIsovalues({file.isovalues.begin(), file.isovalues.end()}, texts);
    texts.emplace_back("Camera", describeCamera(seen_by, data));
    const pcl_uvol::StepTimer timer(report, "write");
    PictureFile(view.frameName(output, frame), view.getDotsPerInch())
        .save(image, texts);
  }
  report.merge(tracing);
}

std::size_t
RayOptions::traceCloud(const Options& options,
                       const ViewOptions& view,
                       const pcl_uvol::Dataset& surface,
                       const std::string& output,
                       pcl_uvol::Report& report) const
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(surface.cloud);
  std::array<double, 2> range{};
  pcl_uvol::Splats splats = pcl_uvol::findSplats(cloud,
                                                 splats_.parameters(options),
                                                 splats_.isGiven(options),
                                                 options.threads(),
                                                 report);
  const std::size_t drawn = splats.cloud.size();
  pcl_uvol::FittedSplats fitted(splats, surface.cloud, options.threads());
  pcl_uvol::RayTracer tracer;
  tracer.setScene(makeScene(view, cloud, std::move(splats), range));
  apply(options, view, tracer.settings());
  tracer.setSupersampling(view.getRaySupersampling());
  tracer.setNumberOfThreads(options.threads());
  tracer.setProgressCallback(report.progress);
  pcl_uvol::Report tracing;
  view.drawFrames(
      options,
      {cloud,
       tracer.getBounds(),
       surface.origin,
       std::nullopt,
       [&](const pcl_uvol::Camera& camera, const PictureCell& cell) {
         return fitted.find(camera, cell.width, cell.height);
       }},
      [&](const pcl_uvol::Camera& camera, const PictureCell& cell, auto& image) {
        tracer.setSize(cell.width, cell.height);
        tracer.setCamera(camera);
        tracer.render(image);
        tracing = tracer.getReport();
      },
      [&] { return range; },
      output,
      report);
  report.merge(tracing);
  return drawn;
}

} // namespace uvol_tools
