// SPDX-License-Identifier: BSD-3-Clause
// A smooth level-set function of scattered samples (thesis chapter 3).
#include "charts/line_plot.h"
#include "charts/picture_file.h"
#include "io/table_file.h"
#include "pipeline/level_set_job.h"
#include "shared/level_set.h"
#include "shared/periodic_option.h"
#include "shared/point_job.h"
#include "shared/sampling_fact.h"
#include "shared/scale_option.h"
#include "shared/size_option.h"

namespace {

using uvol_tools::Options;

struct Arguments {
  pcl_uvol::LevelSetRequest request;
  uvol_tools::ScaleOption scale;
  uvol_tools::PeriodicOption periodic;
  uvol_tools::SizeOption plot_size;
  std::string start, table, plot;
};

/** Options for shapes to start from. */
void
declareShapes(Options& options, pcl_uvol::InitialFunction& start)
{
  const auto declare = [&](auto name, auto numbers, auto count, auto help) {
    const auto take = [&start, name](const std::vector<double>& read) {
      pcl_uvol::fromWord(name, start.kind);
      start.first = Eigen::Array3d(read.data());
      if (read.size() == 4)
        start.radius = read[3];
      else
        start.second = Eigen::Array3d(read.data() + 3);
      start.check();
    };
    options.numbers(name, numbers, count, take, help);
  };
  declare("sphere", "x,y,z,r", 4, "start from a sphere's distance");
  declare("box", "x0,y0,z0,x1,y1,z1", 6, "start from a box's distance");
  declare(
      "plane", "x,y,z,nx,ny,nz", 6, "start from a plane whose normal points outside");
}

void
declare(Options& options, uvol_tools::PointJob& job, Arguments& arguments)
{
  pcl_uvol::LevelSetParameters& parameters = arguments.request.level_set;
  options.group("Level set");
  options.members(parameters,
                  {"isovalue", "mu", "band_width", "k", "max_steps", "tolerance"});
  declareShapes(options, parameters.initial);
  options.text("start", "name", arguments.start, "start from a field, such as phi");
  options.members(parameters, {"outside"});
  job.declareInput(&parameters.field);
  arguments.scale.declare(options, "distances", uvol_tools::AutomaticScale::Field);
  arguments.periodic.declare(options);
  job.declareOutput();
  options.members(arguments.request, {"snapshots"});
  options.output("csv", "out.csv", arguments.table, "write a table of all steps")
      .check(pcl_uvol::checkTablePath);
  options.output("plot", "out.png|.svg|.pdf", arguments.plot, "draw the convergence")
      .check(uvol_tools::checkPicturePath);
  arguments.plot_size.declareChart(options);
  options.group("Schemes", true);
  options.members(parameters,
                  {"scheme", "flow", "integration", "bound", "reinitialization"});
}

/** Check what does not depend on the samples, before these are read. */
void
finish(const Options& options, Arguments& arguments)
{
  pcl_uvol::LevelSetRequest& request = arguments.request;
  if (!options.given("iso"))
    throw uvol_tools::UsageError("-iso is missing: give one isovalue, as in -iso 0.3.");
  if (options.oneOf({"sphere", "box", "plane", "start"}) == "start")
    request.level_set.initial = pcl_uvol::InitialFunction::field(arguments.start);
  arguments.scale.finish(options);
  request.automatic_scale = arguments.scale.isFromField();
  request.level_set.rotation = arguments.scale.getStretch().rotation;
  arguments.periodic.check((request.level_set.rotation != 0.0).any());
  arguments.plot_size.checkChart(options, "plot", !arguments.plot.empty());
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options(
      "uvol_levelset",
      "in.pcd out.ply -iso v [options]",
      "Smooth a noisy or unevenly sampled field near an isosurface by a level set.\n"
      "Output: phi, roughly the distance to the surface (stretched space),\n"
      "positive at higher values.");
  uvol_tools::PointJob job(options);
  declare(options, job, arguments);
  if (!options.parse(argc, argv))
    return 0;
  finish(options, arguments);
  pcl_uvol::LevelSetRequest& request = arguments.request;
  pcl_uvol::LevelSetParameters& wanted = request.level_set;
  const auto samples = std::make_shared<pcl_uvol::Dataset>(job.read());
  request.periodic = arguments.periodic.findSides(*samples);
  for (std::string* field : {&wanted.field, &wanted.initial.field_name})
    uvol_tools::addField(*samples, *field, options, job.report, request.periodic);
  wanted.scale = arguments.scale.findStretch(pcl_uvol::viewOf(samples->cloud)).scale;
  pcl_uvol::checkSavePath(job.getOutput(), samples->cloud.fields);
  const auto save = [&](std::size_t steps, const auto& surface) {
    saveDataset(uvol_tools::numberedPath(job.getOutput(), steps), surface, {});
  };
  const pcl_uvol::SmoothedSamples result = pcl_uvol::runLevelSet(
      samples, nullptr, request, save, options.threads(), job.report.progress);
  job.report.merge(result.report);
  if (!arguments.table.empty())
    pcl_uvol::saveRows(arguments.table, "step", result.summary.steps);
  if (!arguments.plot.empty())
    uvol_tools::PictureFile(arguments.plot, arguments.plot_size.get().dots_per_inch)
        .save(uvol_tools::drawLinePlot(result.summary.steps,
                                       {"change", "slope_error", "energy"},
                                       "step",
                                       arguments.plot_size.get()));
  job.facts.emplace_back("field", result.taken.field);
  if (result.box)
    job.facts.push_back(uvol_tools::describeBox(*result.box));
  append(job.facts, arguments.scale.describe(result.taken, result.scale_choice));
  job.facts.push_back(uvol_tools::describeSampling(result.sampling));
  append(job.facts, uvol_tools::describe(result.summary, !wanted.mu));
  return job.finish(result.samples);
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_levelset", [&] { return run(argc, argv); });
}
