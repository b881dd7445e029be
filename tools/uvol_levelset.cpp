// SPDX-License-Identifier: BSD-3-Clause
// A smooth level-set function of scattered samples (thesis chapter 3).
#include "charts/line_plot.h"
#include "charts/picture_file.h"
#include "io/table_file.h"
#include "pipeline/level_set_job.h"
#include "pipeline/memory_need.h"
#include "shared/level_set.h"
#include "shared/memory_guard.h"
#include "shared/options.h"
#include "shared/periodic_option.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/sampling_fact.h"
#include "shared/scale_option.h"
#include "shared/size_option.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <iomanip>
#include <memory>
#include <sstream>

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::InitialFunction;
using pcl_uvol::LevelSetParameters;
using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::derivativeBytes;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments {
  uvol_tools::ScaleOption scale;
  uvol_tools::InputOptions reading;
  std::string input, output, table, plot, start_field;
  uvol_tools::PeriodicOption periodic;
  LevelSetParameters parameters;
  std::vector<double> iso, sphere, box, plane;
  std::uint64_t snapshots = 0;
  uvol_tools::SizeOption plot_size;
  bool ascii = false;

  Arguments()
  {
    parameters.field.clear();
  } // intensity, else the only candidate
};

void
declare(Options& options, Arguments& arguments)
{
  constexpr std::uint64_t many = 1000000;
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  options.group("Level set");
  options.numbers("iso", "v", 1, arguments.iso, "isovalue (required)");
  options.group("Input");
  options.text("field",
               "name",
               arguments.parameters.field,
               "scalar field: density, vel[1], |vel|, |vx,vy,vz|, or an expression: "
               "log10(rho), rho*u, |grad(rho)|, Q(vel) (default: intensity, else the "
               "only candidate)");
  options.group("Level set");
  options.members(arguments.parameters, {"mu"});
  options.group("Schemes", true);
  options.members(arguments.parameters,
                  {"scheme", "flow", "integration", "bound", "reinitialization"});
  options.group("Level set");
  options.members(arguments.parameters, {"band_width", "k", "max_steps", "tolerance"});
  options.numbers(
      "sphere", "x,y,z,r", 4, arguments.sphere, "start from a sphere's distance");
  options.numbers(
      "box", "x0,y0,z0,x1,y1,z1", 6, arguments.box, "start from a box's distance");
  options.numbers("plane",
                  "x,y,z,nx,ny,nz",
                  6,
                  arguments.plane,
                  "start from a plane's distance; the normal looks outside");
  options.text(
      "start", "name", arguments.start_field, "start from a field, such as phi");
  options.members(arguments.parameters, {"outside"});
  options.group("Input");
  arguments.scale.declare(options, "distances", uvol_tools::AutomaticScale::Field);
  arguments.reading.declare(options);
  arguments.periodic.declare(options);
  options.group("Output");
  options.integer("snapshots",
                  arguments.snapshots,
                  1,
                  many,
                  "write the zero level every so many steps, as out_00010.ply");
  options.output("csv", "out.csv", arguments.table, "write a table of all steps");
  options.output("plot", "out.png|.svg|.pdf", arguments.plot, "draw how it converged");
  arguments.plot_size.declareChart(options);
  options.flag("ascii", arguments.ascii, "write PCD and PLY as text");
}

InitialFunction
makeInitialFunction(const Options& options, const Arguments& arguments)
{
  const auto given = {options.given("sphere"),
                      options.given("box"),
                      options.given("plane"),
                      options.given("start")};
  if (std::count(given.begin(), given.end(), true) > 1)
    throw UsageError("Only one of -sphere, -box, -plane and -start can be given.");
  const auto vector = [](const std::vector<double>& numbers, std::size_t first) {
    return Eigen::Vector3d(numbers[first], numbers[first + 1], numbers[first + 2]);
  };
  if (options.given("sphere"))
    return InitialFunction::sphere(vector(arguments.sphere, 0), arguments.sphere[3]);
  if (options.given("box"))
    return InitialFunction::box(vector(arguments.box, 0), vector(arguments.box, 3));
  if (options.given("plane"))
    return InitialFunction::plane(vector(arguments.plane, 0),
                                  vector(arguments.plane, 3));
  if (options.given("start"))
    return InitialFunction::field(arguments.start_field);
  return {};
}

/** What the options ask for, but for what depends on the samples. */
pcl_uvol::LevelSetRequest
makeRequest(const Options& options, Arguments& arguments)
{
  if (arguments.iso.empty())
    throw UsageError("-iso is missing: give one isovalue, as in -iso 0.3.");
  arguments.scale.finish(options);
  arguments.periodic.check();
  pcl_uvol::LevelSetRequest request;
  request.automatic_scale = arguments.scale.isFromField();
  request.snapshots = arguments.snapshots;
  LevelSetParameters& parameters = request.level_set;
  parameters = arguments.parameters;
  parameters.isovalue = arguments.iso.front();
  parameters.initial = makeInitialFunction(options, arguments);
  parameters.rotation = arguments.scale.getStretch().rotation;
  if (arguments.periodic.isAskedFor() && (parameters.rotation != 0.0).any())
    throw UsageError("-periodic goes without -rotate and a -scale of nine numbers: the "
                     "sides of the box lie along x, y and z.");
  return request;
}

void
writeTable(const std::string& path, const pcl_uvol::LevelSetSummary& summary)
{
  std::ostringstream table;
  table << "step,time,change,min_slope,max_slope,slope_error,energy,reinitialized\n";
  for (std::size_t i = 0; i < summary.steps.size(); ++i) {
    const auto& step = summary.steps[i];
    table << i + 1 << ',' << step.time << ',' << step.change << ',' << step.min_slope
          << ',' << step.max_slope << ',' << step.slope_error << ',' << step.energy
          << ',' << step.reinitialized << '\n';
  }
  pcl_uvol::saveTable(path, table.str());
}

void
writePlot(const std::string& path,
          const uvol_tools::Paper& paper,
          const pcl_uvol::LevelSetSummary& summary)
{
  std::vector<uvol_tools::PlotLine> lines = {
      {"change of the zero level, spacings per unit of time", {}},
      {"mean of | |grad phi| - 1 |", {}},
      {"energy", {}}};
  for (const auto& step : summary.steps) {
    lines[0].values.push_back(step.change);
    lines[1].values.push_back(step.slope_error);
    lines[2].values.push_back(step.energy);
  }
  const uvol_tools::PictureFile file(path, paper.dots_per_inch);
  file.save(uvol_tools::drawLinePlot(lines, "step", paper));
}

/** out.ply becomes out_00010.ply. */
std::string
snapshotPath(const std::string& output, std::size_t steps)
{
  const std::size_t dot = output.rfind('.');
  std::ostringstream path;
  path << output.substr(0, dot) << '_' << std::setw(5) << std::setfill('0') << steps
       << output.substr(dot);
  return path.str();
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options(
      "uvol_levelset",
      "in.pcd out.ply -iso v [options]",
      "Smooths a noisy or unevenly sampled scalar field about an isosurface "
      "by a level set on the samples, and writes it as the field phi: about "
      "the distance to the surface, positive where values are higher, in the space "
      "that -scale stretches.");
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  pcl_uvol::LevelSetRequest request = makeRequest(options, arguments);
  LevelSetParameters& parameters = request.level_set;
  const pcl_uvol::LoadOptions load = arguments.reading.makeLoadOptions();
  const std::string& where = arguments.reading.getWhere();
  pcl_uvol::checkSavePath(arguments.output);
  if (!arguments.table.empty())
    pcl_uvol::checkTablePath(arguments.table);
  arguments.plot_size.checkChart(options, "plot", !arguments.plot.empty());
  if (!arguments.plot.empty())
    uvol_tools::checkPicturePath(arguments.plot);
  uvol_tools::MemoryGuard memory("A level set");
  const auto bytes = [&](double points, double step) {
    return std::max({pcl_uvol::levelSetJobBytes(points, step, request),
                     derivativeBytes(parameters.field, points),
                     derivativeBytes(parameters.initial.field_name, points)});
  };
  memory.checkFile(arguments.input,
                   where.empty() ? uvol_tools::MemoryGuard::Bytes(bytes) : nullptr,
                   load);

  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  auto total = std::make_unique<StepTimer>(report, "total");
  const auto samples = std::make_shared<Dataset>(
      uvol_tools::loadPoints(arguments.input, report, load, where, options.threads()));
  const std::size_t points = samples->cloud.width + report.getCount("removed_by_where");
  request.periodic = arguments.periodic.findSides(*samples, report);
  for (std::string* field : {&parameters.field, &parameters.initial.field_name})
    uvol_tools::addField(*samples, *field, options, report, request.periodic);
  parameters.scale =
      arguments.scale.findStretch(pcl_uvol::viewOf(samples->cloud)).scale;
  pcl_uvol::checkSavePath(arguments.output, samples->cloud.fields);
  memory.checkCloud(*samples, bytes);
  const auto save_snapshot = [&](std::size_t steps, const Dataset& surface) {
    pcl_uvol::saveDataset(snapshotPath(arguments.output, steps), surface, {});
  };
  pcl_uvol::SmoothedSamples result = pcl_uvol::runLevelSet(
      samples, nullptr, request, save_snapshot, options.threads(), report.progress);
  report.merge(result.report);

  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  uvol_tools::savePoints(arguments.output, result.samples, save, report);
  if (!arguments.table.empty())
    writeTable(arguments.table, result.summary);
  if (!arguments.plot.empty())
    writePlot(arguments.plot, arguments.plot_size.get(), result.summary);
  report.count("points", points);
  total.reset();
  uvol_tools::Facts facts = {{"input", arguments.input},
                             {"output", arguments.output},
                             {"field", result.taken.field}};
  const auto append = [&](const uvol_tools::Facts& more) {
    facts.insert(facts.end(), more.begin(), more.end());
  };
  if (result.box)
    facts.push_back(uvol_tools::describeBox(*result.box, samples->origin));
  if (arguments.scale.isGiven())
    append(uvol_tools::describe({result.taken.scale, result.taken.rotation},
                                result.scale_choice));
  facts.push_back(uvol_tools::describeSampling(result.sampling));
  append(uvol_tools::describe(result.summary, !parameters.mu));
  facts.push_back(memory.describe());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_levelset", [&] { return run(argc, argv); });
}
