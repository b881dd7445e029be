// SPDX-License-Identifier: BSD-3-Clause
// Scenes of uvol_raytrace.
#include "charts/bindings.h"
#include "charts/look.h"
#include "common/parameter_json.h"
#include "io/scene_file.h"
#include "render/camera_choice.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>

#include <algorithm>
#include <pybind11/stl.h>
#include <set>
#include <string>
#include <utility>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

/** Names of the parameters that take the place of what a file says. */
using Given = std::set<std::string>;

bool
has(const Given& given, const char* name)
{
  return given.count(name) != 0;
}

void
applyRays(const RayParameters& rays, const Given& given, RayTracingSettings& settings)
{
  if (has(given, "depth"))
    settings.depth = rays.depth;
  if (has(given, "shadows"))
    settings.shadows = rays.shadows;
  if (has(given, "light_samples"))
    settings.light_samples = rays.light_samples;
  if (has(given, "occlusion"))
    settings.occlusion_samples = rays.occlusion;
  if (has(given, "occlusion_distance"))
    settings.occlusion_distance = rays.occlusion_distance;
  settings.cull_back_faces = rays.culling;
}

/** The camera of a file, unless another side is asked for: with what is asked for in
 * the place of what it says.
 * \param turn degrees that it goes around */
Camera
findCamera(const PictureParameters& look,
           const Given& given,
           const SceneFile& file,
           double turn,
           RayTracer& tracer)
{
  if (!file.camera || has(given, "view"))
    return makeCamera(look,
                      {tracer.getBounds()},
                      file.origin,
                      {0, 0, look.width, look.height, ""},
                      turn);
  Camera camera = *file.camera;
  const Eigen::Vector3d shift(file.origin.data());
  if (look.eye)
    camera.eye = look.eye->matrix() - shift;
  if (look.at)
    camera.at = look.at->matrix() - shift;
  if (look.up)
    camera.up = look.up->matrix();
  if (has(given, "fov"))
    camera.vertical_fov = look.fov;
  if (look.parallel)
    camera = camera.parallel();
  return zoomed(camera, look.zoom).orbited(turn);
}

std::array<double, 3>
toNumbers(const Eigen::Vector3d& place)
{
  return {place.x(), place.y(), place.z()};
}

/** What was taken, from the file or instead of it, by the names of Python's keywords.
 * \param origin what was subtracted from the coordinates */
py::dict
describe(const Camera& camera,
         const std::array<double, 3>& origin,
         const PictureParameters& look,
         int supersample,
         const RayTracingSettings& rays)
{
  const Eigen::Vector3d shift(origin.data());
  py::dict dict;
  dict["width"] = look.width;
  dict["height"] = look.height;
  dict["eye"] = toNumbers(camera.eye + shift);
  dict["at"] = toNumbers(camera.at + shift);
  dict["up"] = toNumbers(camera.up);
  dict["fov"] = camera.vertical_fov;
  dict["supersample"] = supersample;
  dict["depth"] = rays.depth;
  dict["shadows"] = rays.shadows;
  dict["light_samples"] = rays.light_samples;
  dict["occlusion"] = rays.occlusion_samples;
  dict["occlusion_distance"] = rays.occlusion_distance;
  dict["culling"] = rays.cull_back_faces;
  return dict;
}

/** A scene of a file, seen as the file says unless parameters say otherwise.
 * \param turn degrees that the camera goes around
 * \return pixels, the report, and the parameters that were taken */
py::tuple
traceScene(const std::string& path,
           const std::string& folder,
           const std::string& json,
           const std::string& ray_json,
           const Given& given,
           double turn,
           unsigned threads,
           const py::object& progress)
{
  PictureParameters look = readPictureParameters(json);
  const auto rays = readJson<RayParameters>(ray_json);
  Image image;
  Report report;
  Camera camera;
  std::array<double, 3> origin{};
  RayTracingSettings settings;
  int supersample = 0;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    report.progress = callback;
    SceneFile file = loadScene(path, folder, threads, report);
    if (has(given, "background"))
      file.scene.background = makeBackground(look);
    if (has(given, "lights"))
      file.scene.lights = makeLights(look);
    RayTracer tracer;
    tracer.setScene(file.scene);
    tracer.settings() = file.settings;
    applyRays(rays, given, tracer.settings());
    tracer.setNumberOfThreads(threads);
    tracer.setProgressCallback(callback);
    supersample =
        has(given, "supersample") ? std::max(look.supersample, 1) : file.supersampling;
    tracer.setSupersampling(supersample);
    if (file.size && !has(given, "size")) {
      look.width = (*file.size)[0];
      look.height = (*file.size)[1];
    }
    tracer.setSize(look.width, look.height);
    camera = findCamera(look, given, file, turn, tracer);
    tracer.setCamera(camera);
    tracer.render(image);
    settings = tracer.settings();
    origin = file.origin;
    report.merge(tracer.getReport());
  });
  const auto height = static_cast<py::ssize_t>(image.height);
  const auto width = static_cast<py::ssize_t>(image.width);
  return py::make_tuple(toArray(std::move(image.color), {height, width, 4}),
                        toDict(report),
                        describe(camera, origin, look, supersample, settings));
}

} // namespace

void
bindScenes(py::module_& module)
{
  module.def("trace_scene", &traceScene);
}

} // namespace pcl_uvol::python
