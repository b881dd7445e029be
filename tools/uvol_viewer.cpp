// SPDX-License-Identifier: BSD-3-Clause
// A surface given as points, or the isosurfaces of samples, in a window.
#include "shared/point_files.h"
#include "viewer/display.h"
#include "viewer/keys.h"
#include "viewer/viewer_window.h"
#include <pcl_uvol/io/image_file.h>

#include <vtkLogger.h>

#include <iostream>
#include <utility>
#include <vector>

namespace {

using pcl_uvol::Report;

struct Arguments {
  std::string input, field, screenshot;
  std::vector<double> isovalues;
  pcl_uvol::WindowBackend backend = pcl_uvol::WindowBackend::Auto;
};

void
declare(uvol_tools::Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.group("Input");
  options.text("field",
               "name",
               arguments.field,
               "the points are samples of this scalar field: show an isosurface");
  options.numbers("iso",
                  "v,...",
                  0,
                  arguments.isovalues,
                  "isovalues to start with, of which the last one moves (default the "
                  "first that uvol_info proposes)");
  options.group("Picture");
  options.choice("backend",
                 arguments.backend,
                 "renderer; auto: OpenGL if there is a GPU, otherwise the CPU, "
                 "whose picture OpenGL shows");
  options.output("screenshot",
                 "out.png",
                 arguments.screenshot,
                 "save what the window shows first, and close it");
}

void
checkCombinations(const uvol_tools::Options& options,
                  const Arguments& arguments,
                  uvol_tools::RenderOptions& look)
{
  if (options.given("iso") && arguments.field.empty())
    throw uvol_tools::UsageError("-iso needs -field: isovalues are of a scalar field.");
  look.check(options);
  if (look.isTransparent())
    throw uvol_tools::UsageError(
        "-background transparent is for pictures: a window has another one.");
  if (!arguments.screenshot.empty())
    pcl_uvol::checkPngPath(arguments.screenshot);
}

/** Read a file, of which the look gets to know the colours. */
uvol_tools::ShownFile
load(const uvol_tools::Options& options,
     const std::string& path,
     std::string field,
     uvol_tools::RenderOptions look)
{
  Report report;
  pcl_uvol::Dataset dataset = uvol_tools::loadPoints(path, report);
  if (field.empty())
    look.addColor(options, dataset, report);
  else {
    uvol_tools::addField(dataset, field, options, report);
    look.addColorOfSamples(options, dataset, report);
  }
  const auto add_color = [look, &options](pcl_uvol::Dataset& surface,
                                          Report& drawing) mutable {
    look.addColor(options, surface, drawing);
  };
  return {{std::move(dataset), field, options.threads(), look.getFactors(), add_color},
          look,
          report};
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  uvol_tools::RenderOptions look;
  uvol_tools::Options options(
      "uvol_viewer",
      "in.ply [options]",
      "Show a surface given as points in a window, or with -field the isosurfaces of\n"
      "samples, with a slider for the isovalue. In the window:\n" +
          uvol_tools::describeKeys());
  declare(options, arguments);
  look.declareScene(options, uvol_tools::ViewOptions::SizeOf::Window);
  look.declareExaggeration(options);
  look.declareOpacity(options);
  look.declarePasses(options);
  if (!options.parse(argc, argv))
    return 0;
  checkCombinations(options, arguments, look);
  uvol_tools::checkDisplay();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_ERROR); // PCL and X cause warnings

  const auto open = [&](const std::string& path) {
    return load(options, path, arguments.field, look);
  };
  uvol_tools::ShownFile file = open(arguments.input);
  if (!arguments.field.empty()) {
    file.surface.setIsoValues(
        options.given("iso") ? arguments.isovalues
                             : std::vector<double>{file.surface.proposeIsoValue()});
  }
  uvol_tools::ViewerWindow window(
      arguments.input, file.surface, file.look, options, arguments.backend, open);
  Report report = file.report;
  report.merge(window.getReport());
  if (!arguments.screenshot.empty())
    window.save(arguments.screenshot);
  uvol_tools::printReport(
      options,
      report,
      {{"input", arguments.input}, {"backend", window.describeBackend()}});
  std::cout.flush();
  if (arguments.screenshot.empty())
    window.run();
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_viewer", [&] { return run(argc, argv); });
}
