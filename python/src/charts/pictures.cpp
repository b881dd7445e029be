// SPDX-License-Identifier: BSD-3-Clause
// Pictures of points with normals, on the CPU: no display, no OpenGL.
#include "common/parameter_json.h"
#include "core/bindings.h"
#include "render/image_space/frame.h"
#include "render/ray_tracing/gap_dots.h"
#include "render/stretch_surface.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include "shared/look.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>

#include <algorithm>
#include <optional>
#include <pybind11/stl.h>
#include <string>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

/** A picture that is made, and what its colours stand for. */
struct Drawing {
  /** \param surface must outlive it, unless it is stretched */
  Drawing(const DatasetPtr& surface, const PictureParameters& asked)
      : parameters(asked)
      , points(surface)
  {
    if (parameters.exaggerate) {
      points = std::make_shared<Dataset>(*surface);
      stretchSurface(*points, parameters.exaggerate->matrix());
    }
    cloud = viewOf(points->cloud);
    field = findColorField(parameters, cloud);
    if (!field.empty())
      mapping = makeColorMapping(parameters, cloud, field);
  }

  /** Columns for the surface. */
  int
  width() const
  {
    return parameters.width - parameters.margin;
  }

  const PictureParameters& parameters;
  DatasetPtr points;
  CloudView cloud;
  std::string field;
  ColorMapping mapping;
  Image image;
  std::array<double, 2> range{{0.0, 1.0}};
  Report report;
};

/** Pixels, field, values at the ends of the colours, and the report. */
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
applyPasses(const PictureParameters& parameters, ImageSpaceSettings& settings)
{
  const PassParameters& passes = parameters.passes;
  settings.cull_back_faces = parameters.culling;
  settings.footprints = parameters.footprints;
  settings.background_fill = passes.fill;
  settings.occluded_fill = passes.occluded;
  settings.layer_distance = passes.layers;
  settings.shading = passes.shading;
  settings.smoothing = passes.smoothing;
  settings.smoothing_iterations = passes.smoothings;
  settings.silhouettes = parameters.silhouettes;
  settings.silhouette_threshold = passes.silhouette_threshold;
  settings.silhouette_thickness = parameters.thickness;
  settings.feature_lines = parameters.features;
  settings.feature_threshold = passes.feature_threshold;
  if (parameters.line_color)
    settings.line_color = toColor(*parameters.line_color);
  settings.anti_aliasing = passes.antialias;
  settings.anti_aliasing_threshold = passes.antialias_threshold;
}

void
draw(Drawing& drawing, unsigned threads)
{
  const PictureParameters& parameters = drawing.parameters;
  ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(drawing.points, &drawing.points->cloud));
  ImageSpaceSettings& settings = renderer.settings();
  applyPasses(parameters, settings);
  settings.background = makeBackground(parameters);
  settings.material = makeMaterial(parameters);
  settings.lights = makeLights(parameters);
  renderer.setColorField(drawing.field);
  renderer.setColorMap(drawing.mapping.map);
  renderer.setLogarithmicColors(drawing.mapping.is_logarithmic);
  if (const auto& range = drawing.mapping.range)
    renderer.setColorRange((*range)[0], (*range)[1]);
  renderer.setNumberOfThreads(threads);
  renderer.setProgressCallback(drawing.report.progress);
  renderer.setSize(drawing.width(), parameters.height);
  const int largest = std::max(parameters.width, parameters.height);
  const int usual = 2 * largest <= View::largest_size ? 2 : 1;
  renderer.setSupersampling(parameters.supersample > 0 ? parameters.supersample
                                                       : usual);
  renderer.setCamera(makeCamera(
      parameters, renderer.getBounds(), drawing.points->origin, &drawing.cloud));
  renderer.render(drawing.image);
  drawing.range = renderer.getColorRange();
  drawing.report.merge(renderer.getReport());
}

/** Add the points to a scene, which has its background. */
void
coverPoints(const RayParameters& rays, unsigned threads, Drawing& drawing, Scene& scene)
{
  const Splats splats = findSplats(drawing.cloud,
                                   rays.splats.value_or(SplatParameters()),
                                   rays.splats.has_value(),
                                   threads,
                                   drawing.report);
  if (splats.cloud.empty())
    throw InvalidArgument("None of the splats is usable.");
  SplatObject object;
  if (!drawing.field.empty()) {
    const auto colored = colorPoints(drawing.cloud, drawing.field, drawing.mapping);
    drawing.range = {colored.scale.low, colored.scale.high};
    for (const std::uint32_t source : splats.sources)
      object.colors.push_back(colored.colors[source]);
  }
  object.splats = pcl::make_shared<pcl::PointCloud<PointSplat>>(splats.cloud);
  static_cast<Material&>(object.material) = makeMaterial(drawing.parameters);
  object.material.reflectivity = rays.reflect;
  object.material.transparency = rays.transparent;
  object.material.refractive_index = rays.index;
  addWithDots(std::move(object),
              drawing.cloud,
              splats.sources,
              std::min(drawing.width(), drawing.parameters.height),
              scene);
}

void
trace(const RayParameters& rays, Drawing& drawing, unsigned threads)
{
  const PictureParameters& parameters = drawing.parameters;
  Scene scene;
  scene.lights = makeLights(parameters);
  scene.background = makeBackground(parameters);
  coverPoints(rays, threads, drawing, scene);
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
  tracer.setSize(drawing.width(), parameters.height);
  tracer.setSupersampling(std::max(parameters.supersample, 1));
  tracer.setCamera(makeCamera(
      parameters, tracer.getBounds(), drawing.points->origin, &drawing.cloud));
  tracer.render(drawing.image);
  drawing.report.merge(tracer.getReport());
}

/** \param work draws, and tells the drawing's report */
template <typename Work>
py::tuple
drawInterruptibly(const DatasetPtr& points,
                  const std::string& json,
                  const py::object& progress,
                  const Work& work)
{
  const PictureParameters parameters = readPictureParameters(json);
  std::optional<Drawing> drawing;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    drawing.emplace(points, parameters);
    drawing->report.progress = callback;
    work(*drawing);
    addMargin(drawing->image, makeBackground(parameters), parameters.margin);
  });
  return toTuple(std::move(*drawing));
}

py::tuple
renderPoints(const DatasetPtr& points,
             const std::string& json,
             unsigned threads,
             const py::object& progress)
{
  return drawInterruptibly(
      points, json, progress, [&](Drawing& drawing) { draw(drawing, threads); });
}

py::tuple
tracePoints(const DatasetPtr& points,
            const std::string& json,
            const std::string& ray_json,
            unsigned threads,
            const py::object& progress)
{
  const auto rays = readJson<RayParameters>(ray_json);
  return drawInterruptibly(
      points, json, progress, [&](Drawing& drawing) { trace(rays, drawing, threads); });
}

/** The field that a picture is coloured by; "" for the colour of the surface. */
py::str
nameColorField(const Dataset& points, const std::string& color)
{
  PictureParameters parameters;
  parameters.color = color;
  return toText(findColorField(parameters, viewOf(points.cloud)));
}

} // namespace

void
bindPictures(py::module_& module)
{
  module.def("render", &renderPoints);
  module.def("raytrace", &tracePoints);
  module.def("color_field", &nameColorField);
}

} // namespace pcl_uvol::python
