// SPDX-License-Identifier: BSD-3-Clause
// Pictures of points with normals, on the CPU: no display, no OpenGL.
#include "common/parameter_json.h"
#include "core/bindings.h"
#include "core/interruptible.h"
#include "core/picture_parameters.h"
#include "render/camera_choice.h"
#include "render/image_space/frame.h"
#include "render/point_colors.h"
#include "shared/convert.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>

#include <algorithm>
#include <pybind11/stl.h>
#include <string>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

Color
toColor(const Eigen::Array3d& numbers)
{
  if (!(numbers >= 0.0).all() || !(numbers <= 1.0).all())
    throw InvalidArgument("A colour is red, green and blue, from 0 to 1 each.");
  return {static_cast<float>(numbers[0]),
          static_cast<float>(numbers[1]),
          static_cast<float>(numbers[2])};
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
  return material;
}

Camera
makeCamera(const PictureParameters& parameters,
           const BoundingSphere& bounds,
           const Dataset& points,
           const CloudView& cloud)
{
  const auto vector = [](const std::optional<Eigen::Array3d>& numbers) {
    return numbers ? std::optional<Eigen::Vector3d>(numbers->matrix()) : std::nullopt;
  };
  return chooseCamera({parameters.view,
                       vector(parameters.eye),
                       vector(parameters.at),
                       vector(parameters.up),
                       parameters.fov,
                       parameters.zoom},
                      bounds,
                      points.origin,
                      static_cast<double>(parameters.width) / parameters.height,
                      &cloud);
}

std::string
colorField(const PictureParameters& parameters, const CloudView& cloud)
{
  if (parameters.color == "auto")
    return usualColorField(cloud);
  return parameters.color == "none" ? "" : parameters.color;
}

/** \throws InvalidArgument for what would divide by zero before the renderer looks */
PictureParameters
readParameters(const std::string& json)
{
  const auto parameters = readJson<PictureParameters>(json);
  if (parameters.width < 1 || parameters.height < 1)
    throw InvalidArgument("A picture is at least 1 x 1 pixels.");
  if (parameters.range && !((*parameters.range)[0] < (*parameters.range)[1]))
    throw InvalidArgument("The range of colours is two numbers, the lower one first.");
  return parameters;
}

/** Pixels, the values at the ends of the colours, and the report. */
struct Drawing {
  Image image;
  std::array<double, 2> range{{0.0, 1.0}};
  std::string field;
  Report report;
};

py::tuple
toTuple(Drawing&& drawing)
{
  const py::dict report = toDict(drawing.report);
  const auto height = static_cast<py::ssize_t>(drawing.image.height);
  const auto width = static_cast<py::ssize_t>(drawing.image.width);
  return py::make_tuple(toArray(std::move(drawing.image.color), {height, width, 4}),
                        toText(drawing.field),
                        drawing.range,
                        report);
}

void
draw(const DatasetPtr& points,
     const PictureParameters& parameters,
     unsigned threads,
     Drawing& drawing)
{
  const CloudView cloud = viewOf(points->cloud);
  ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(pcl::PCLPointCloud2::ConstPtr(points, &points->cloud));
  ImageSpaceSettings& settings = renderer.settings();
  settings.background = makeBackground(parameters);
  settings.material = makeMaterial(parameters);
  settings.cull_back_faces = parameters.culling;
  settings.footprints = parameters.footprints;
  settings.silhouettes = parameters.silhouettes;
  settings.silhouette_thickness = parameters.thickness;
  settings.feature_lines = parameters.features;
  if (parameters.line_color)
    settings.line_color = toColor(*parameters.line_color);
  drawing.field = colorField(parameters, cloud);
  renderer.setColorField(drawing.field);
  renderer.setColorMap(ColorMap(parameters.colormap));
  if (parameters.range)
    renderer.setColorRange((*parameters.range)[0], (*parameters.range)[1]);
  renderer.setNumberOfThreads(threads);
  renderer.setProgressCallback(drawing.report.progress);
  renderer.setSize(parameters.width, parameters.height);
  const int largest = std::max(parameters.width, parameters.height);
  const int usual = 2 * largest <= View::largest_size ? 2 : 1;
  renderer.setSupersampling(parameters.supersample > 0 ? parameters.supersample
                                                       : usual);
  renderer.setCamera(makeCamera(parameters, renderer.getBounds(), *points, cloud));
  renderer.render(drawing.image);
  drawing.range = renderer.getColorRange();
  drawing.report.merge(renderer.getReport());
}

SplatObject
coverPoints(const Dataset& points,
            const PictureParameters& parameters,
            const RayParameters& rays,
            unsigned threads,
            Drawing& drawing)
{
  const CloudView cloud = viewOf(points.cloud);
  const Splats splats = findSplats(cloud,
                                   rays.splats.value_or(SplatParameters()),
                                   rays.splats.has_value(),
                                   threads,
                                   drawing.report);
  if (splats.cloud.empty())
    throw InvalidArgument("None of the splats is usable.");
  SplatObject object;
  drawing.field = colorField(parameters, cloud);
  if (!drawing.field.empty()) {
    std::optional<std::array<double, 2>> range;
    if (parameters.range)
      range = {(*parameters.range)[0], (*parameters.range)[1]};
    const auto colored = colorPoints(
        cloud, drawing.field, {ColorMap(parameters.colormap), range, false});
    drawing.range = {colored.scale.low, colored.scale.high};
    for (const std::uint32_t source : splats.sources)
      object.colors.push_back(colored.colors[source]);
  }
  object.splats = pcl::make_shared<pcl::PointCloud<PointSplat>>(splats.cloud);
  static_cast<Material&>(object.material) = makeMaterial(parameters);
  object.material.reflectivity = rays.reflect;
  object.material.transparency = rays.transparent;
  object.material.refractive_index = rays.index;
  return object;
}

void
trace(const DatasetPtr& points,
      const PictureParameters& parameters,
      const RayParameters& rays,
      unsigned threads,
      Drawing& drawing)
{
  Scene scene;
  scene.splats.push_back(coverPoints(*points, parameters, rays, threads, drawing));
  scene.background = makeBackground(parameters);
  RayTracer tracer;
  tracer.setScene(scene);
  RayTracingSettings& settings = tracer.settings();
  settings.depth = rays.depth;
  settings.shadows = rays.shadows;
  settings.light_samples = rays.light_samples;
  settings.occlusion_samples = rays.occlusion;
  settings.occlusion_distance = rays.occlusion_distance;
  tracer.setNumberOfThreads(threads);
  tracer.setProgressCallback(drawing.report.progress);
  tracer.setSize(parameters.width, parameters.height);
  tracer.setSupersampling(std::max(parameters.supersample, 1));
  const CloudView cloud = viewOf(points->cloud);
  tracer.setCamera(makeCamera(parameters, tracer.getBounds(), *points, cloud));
  tracer.render(drawing.image);
  drawing.report.merge(tracer.getReport());
}

py::tuple
renderPoints(const DatasetPtr& points,
             const std::string& json,
             unsigned threads,
             const py::object& progress)
{
  const PictureParameters parameters = readParameters(json);
  Drawing drawing;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    drawing.report.progress = callback;
    draw(points, parameters, threads, drawing);
  });
  return toTuple(std::move(drawing));
}

py::tuple
tracePoints(const DatasetPtr& points,
            const std::string& json,
            const std::string& ray_json,
            unsigned threads,
            const py::object& progress)
{
  const PictureParameters parameters = readParameters(json);
  const auto rays = readJson<RayParameters>(ray_json);
  Drawing drawing;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    drawing.report.progress = callback;
    trace(points, parameters, rays, threads, drawing);
  });
  return toTuple(std::move(drawing));
}

} // namespace

void
bindPictures(py::module_& module)
{
  module.def("render", &renderPoints);
  module.def("raytrace", &tracePoints);
}

} // namespace pcl_uvol::python
