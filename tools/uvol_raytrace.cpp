// SPDX-License-Identifier: BSD-3-Clause
// Ray-traced pictures of scenes, or of one surface given as points (thesis 4.2).
#include "charts/picture_file.h"
#include "io/scene_file.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/ray_options.h"
#include "shared/series.h"
#include <pcl_uvol/io/dataset.h>

#include <filesystem>
#include <memory>
#include <utility>

namespace {

using pcl_uvol::Report;
using uvol_tools::Options;
using uvol_tools::RayOptions;
using uvol_tools::UsageError;
using uvol_tools::ViewOptions;

struct Arguments {
  std::string input, output, folder;
  ViewOptions view;
  RayOptions rays;
};

bool
isScene(const std::string& path)
{
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".txt" || ending == ".scene";
}

/** What belongs to one kind of input only. */
void
checkInput(const Options& options, const Arguments& arguments)
{
  if (!isScene(arguments.input)) {
    if (options.given("folder"))
      throw UsageError("-folder is for the clouds of a scene.");
    return;
  }
  std::vector<std::string> names = RayOptions::surfaceOptions();
  for (const char* name : {"color",
                           "colormap",
                           "range",
                           "log",
                           "exaggerate",
                           "no-bar",
                           "surface-color",
                           "ambient",
                           "diffuse",
                           "specular",
                           "shininess"})
    names.emplace_back(name);
  for (const std::string& name : names)
    if (options.given(name))
      throw UsageError("-" + name + " is for a cloud: a scene says it in its file.");
  for (const std::string& name : uvol_tools::FigureOptions::names())
    if (options.given(name))
      throw UsageError("-" + name + " is for a cloud, and not for a scene.");
}

/** What the command line has takes the place of what the scene says. */
void
traceScene(const Options& options, const Arguments& arguments, Report& report)
{
  pcl_uvol::SceneFile file =
      pcl_uvol::loadScene(arguments.input, arguments.folder, options.threads(), report);
  if (options.given("background"))
    file.scene.background = arguments.view.getBackground();
  if (options.given("lights"))
    file.scene.lights = arguments.view.getLights();
  pcl_uvol::RayTracer tracer;
  tracer.setScene(file.scene);
  tracer.settings() = file.settings;
  arguments.rays.apply(options, arguments.view, tracer.settings());
  tracer.setSupersampling(options.given("supersample")
                              ? arguments.view.getRaySupersampling()
                              : file.supersampling);
  if (file.size && !options.given("size"))
    tracer.setSize((*file.size)[0], (*file.size)[1]);
  else
    tracer.setSize(arguments.view.getWidth(), arguments.view.getHeight());
  if (options.given("view"))
    file.camera.reset();
  if (!file.camera && options.given("at") && !options.given("eye"))
    throw UsageError("-at needs -eye where the scene has no camera.");
  uvol_tools::traceScene(
      options, arguments.view, tracer, file, arguments.output, report);
}

/** A picture on its way. */
struct Job {
  Arguments arguments;
  Options options{"uvol_raytrace",
                  "scene.txt|in.ply out.png|.svg|.pdf [options]",
                  "Draw a scene (.txt, .scene), or a surface of points or splats, by "
                  "ray tracing: shadows,\n"
                  "mirrors and glass. Options override the scene."};
  Report report;
  uvol_tools::ProgressBar bar;

  void
  trace(const pcl_uvol::Dataset& surface)
  {
    arguments.rays.traceCloud(
        options, arguments.view, surface, arguments.output, report);
    print();
  }

  void
  print()
  {
    uvol_tools::printReport(
        options, report, {{"input", arguments.input}, {"output", arguments.output}});
  }
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  options.group("Input");
  options.text("folder", "path", arguments.folder, "folder of the clouds of a scene");
  arguments.view.declareScene(options);
  arguments.view.declareExaggeration(options);
  arguments.view.declareFigure(options);
  arguments.view.declareResolution(options);
  arguments.view.declareOrbit(options);
  options.group("Ray tracing");
  arguments.rays.declareRays(options);
  arguments.rays.declareSurface(options);
  arguments.view.declareLighting(options);
  uvol_tools::declareSeries(options);
}

int
run(int argc, char** argv, uvol_tools::SeriesStep* step)
{
  const auto job = std::make_shared<Job>();
  auto& [arguments, options, report, bar] = *job;
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  arguments.view.check(options, isScene(arguments.input));
  arguments.rays.check(options);
  checkInput(options, arguments);
  uvol_tools::checkPicturePath(arguments.output);

  report.progress = std::ref(bar);
  if (isScene(arguments.input)) {
    traceScene(options, arguments, report);
    job->print();
    return 0;
  }
  pcl_uvol::Dataset surface = uvol_tools::loadPoints(arguments.input, report);
  arguments.view.addColor(options, surface, report);
  arguments.view.exaggerate(surface);
  if (step && arguments.view.sharesView())
    step->pictures.add(options,
                       arguments.view,
                       std::move(surface),
                       [job](const auto& waiting) { job->trace(waiting); });
  else
    job->trace(surface);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_raytrace", argc, argv, run);
}
