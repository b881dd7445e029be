// SPDX-License-Identifier: BSD-3-Clause
// A smooth level-set function of scattered samples (thesis chapter 3).
#include "charts/line_plot.h"
#include "charts/picture_file.h"
#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "expressions/memory_need.h"
#include "io/table_file.h"
#include "levelset/memory_need.h"
#include "levelset/phi_cloud.h"
#include "pipeline/guessed_isopoints.h"
#include "pipeline/zero_level.h"
#include "shared/level_set.h"
#include "shared/memory_guard.h"
#include "shared/options.h"
#include "shared/periodic_option.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/sampling_fact.h"
#include "shared/scale_option.h"
#include "shared/size_option.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>
#include <sstream>

namespace {

using pcl_uvol::InitialFunction;
using pcl_uvol::LevelSetParameters;
using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments {
  uvol_tools::ScaleOption scale;
  uvol_tools::InputOptions reading;
  std::string input, output, mu = "auto", table, plot, start_field;
  uvol_tools::PeriodicOption periodic;
  LevelSetParameters parameters;
  std::vector<double> iso, sphere, box, plane;
  std::uint64_t k = parameters.k, steps = parameters.max_steps, snapshots = 0;
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
  options.text(
      "mu",
      "m|auto",
      arguments.mu,
      "weight of the data against smoothness, 0 to 1; auto: smooth as far as the "
      "expected deviation falls");
  options.group("Schemes", true);
  options.choice("scheme",
                 arguments.parameters.scheme,
                 "local fits; linear: the thesis's, unstable on noise");
  options.choice("flow",
                 arguments.parameters.flow,
                 "smooth by the curvature less its local mean, or by the mean "
                 "curvature as in the thesis, which shrinks");
  options.choice("integration",
                 arguments.parameters.integration,
                 "every sample its own time step, or one for all");
  options.choice("bound",
                 arguments.parameters.bound,
                 "time steps by the stencils' weights, or by the thesis's condition");
  options.choice("reinit",
                 arguments.parameters.reinitialization,
                 "what keeps the slope at 1: distance to the isopoints, the Eikonal "
                 "equation, or a diffusion term");
  options.group("Level set");
  options.number("band",
                 arguments.parameters.band_width,
                 0.0,
                 std::numeric_limits<double>::max(),
                 "advance only samples so many spacings from the surface; 0: all");
  options.integer("k", arguments.k, 3, 1000, "nearest neighbours of a stencil");
  options.integer("steps", arguments.steps, 1, many, "time steps at most");
  options.number("tolerance",
                 arguments.parameters.tolerance,
                 std::numeric_limits<double>::min(),
                 std::numeric_limits<double>::max(),
                 "end when the surface moves by less, in spacings per unit of time");
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
  options.choice("outside",
                 arguments.parameters.outside,
                 "the outside of -sphere, -box and -plane is where values are so");
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

/** The same shape where coordinates count from an origin. */
InitialFunction
shift(InitialFunction initial, const std::array<double, 3>& origin)
{
  const Eigen::Array3d by(origin[0], origin[1], origin[2]);
  initial.first -= by;
  if (initial.kind == pcl_uvol::InitialKind::Box)
    initial.second -= by;
  return initial;
}

/** The parameters that the options ask for, but for what depends on the samples. */
LevelSetParameters
makeParameters(const Options& options, const Arguments& arguments)
{
  if (arguments.iso.empty())
    throw UsageError("-iso is missing: give one isovalue, as in -iso 0.3.");
  LevelSetParameters parameters = arguments.parameters;
  parameters.isovalue = arguments.iso.front();
  parameters.mu = uvol_tools::parseAutomatic("mu", arguments.mu, 0.0, 1.0);
  parameters.initial = makeInitialFunction(options, arguments);
  parameters.k = arguments.k;
  parameters.max_steps = arguments.steps;
  return parameters;
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

/** What the tool holds beside the points.
 * \param surface of the isovalue */
uvol_tools::MemoryGuard::Work
forecastMemory(const LevelSetParameters& parameters,
               bool has_snapshots,
               const pcl_uvol::SurfaceSize& surface)
{
  return
      [=, &parameters](double points, double step, pcl_uvol::MemoryForecast& forecast) {
        forecast.hold(sizeof(int) * points); // indices of all
        pcl_uvol::MemoryNeed need = pcl_uvol::levelSetNeed(points, surface, parameters);
        // extractSnapshot(), beside the level set
        const double of_phi = pcl_uvol::phi_point_bytes * points;
        if (has_snapshots)
          need.peak += of_phi + pcl_uvol::isosurfaceNeed(points, {surface}).peak;
        forecast.run(need);
        forecast.hold(of_phi);
        // Indices, edges and the output, phi longer than the input.
        forecast.hold(
            (sizeof(std::uint32_t) + sizeof(pcl_uvol::IsoEdge) + step + sizeof(float)) *
            points);
      };
}

/** Warn where the surface that is smoothed lies between lines of samples, as one that
 * is extracted does. */
void
warnOfGuesses(const pcl_uvol::SamplingSummary& sampling, Report& report)
{
  if (const auto warning = pcl_uvol::tellSmoothedGuesses(report, sampling))
    report.warnings.push_back(*warning);
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
  LevelSetParameters parameters = makeParameters(options, arguments);
  arguments.scale.finish(options);
  arguments.periodic.check();
  if (arguments.periodic.isAskedFor() &&
      (arguments.scale.getStretch().rotation != 0.0).any())
    throw UsageError("-periodic goes without -rotate and a -scale of nine numbers: the "
                     "sides of the box lie along x, y and z.");
  const pcl_uvol::LoadOptions load = arguments.reading.makeLoadOptions();
  const std::string& where = arguments.reading.getWhere();
  pcl_uvol::checkSavePath(arguments.output);
  if (!arguments.table.empty())
    pcl_uvol::checkTablePath(arguments.table);
  arguments.plot_size.checkChart(options, "plot", !arguments.plot.empty());
  if (!arguments.plot.empty())
    uvol_tools::checkPicturePath(arguments.plot);
  const bool has_snapshots = arguments.snapshots > 0;
  uvol_tools::MemoryGuard memory("A level set");
  const auto work = [&](double points,
                        double step,
                        pcl_uvol::MemoryForecast& forecast) {
    for (const std::string* field : {&parameters.field, &parameters.initial.field_name})
      forecast.run(pcl_uvol::derivedFieldNeed(*field, points, step));
    forecastMemory(parameters, has_snapshots, {})(points, step, forecast);
  };
  if (where.empty())
    memory.checkFile(arguments.input, work, load);
  else
    memory.checkFile(arguments.input, nullptr, load);

  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  auto total = std::make_unique<StepTimer>(report, "total");
  pcl_uvol::Dataset dataset =
      uvol_tools::loadPoints(arguments.input, report, load, where, options.threads());
  const std::size_t points = dataset.cloud.width + report.getCount("removed_by_where");
  const auto sides = arguments.periodic.findSides(dataset, report);
  for (std::string* field : {&parameters.field, &parameters.initial.field_name}) {
    uvol_tools::addField(dataset, *field, options, report, sides);
    pcl_uvol::refuseNames(dataset, *field);
  }
  uvol_tools::Facts of_scale;
  const auto stretch = arguments.scale.resolve(
      pcl_uvol::viewOf(dataset.cloud),
      parameters.field.empty()
          ? pcl_uvol::ScalarField::defaultName(dataset.cloud.fields)
          : parameters.field,
      options.threads(),
      report,
      of_scale);
  parameters.scale = stretch.scale;
  parameters.rotation = stretch.rotation;
  pcl_uvol::SamplesInBox boxed(
      dataset, sides, parameters.scale, options.threads(), report);
  pcl_uvol::checkSavePath(arguments.output, dataset.cloud.fields);
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(dataset.cloud);
  parameters.initial = shift(parameters.initial, dataset.origin);
  if (parameters.field.empty())
    parameters.field =
        pcl_uvol::ScalarField::defaultName(pcl_uvol::listNumberFields(dataset));
  pcl_uvol::IsosurfaceParameters at_start;
  at_start.field = parameters.field;
  at_start.isovalues = arguments.iso;
  at_start.scale = parameters.scale;
  memory.checkCloud(
      dataset,
      forecastMemory(
          parameters,
          has_snapshots,
          pcl_uvol::allowForDetail(
              pcl_uvol::estimateSurfaces(view, at_start, options.threads()).front())));
  pcl_uvol::LevelSetEvolution<pcl::PCLPointCloud2> evolution;
  evolution.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
  evolution.setParameters(parameters);
  evolution.setExamined(true);
  evolution.setNumberOfThreads(options.threads());
  evolution.setProgressCallback(report.progress);
  evolution.setSnapshotCallback(
      arguments.snapshots,
      [&](const pcl_uvol::LevelSetSummary& so_far, const std::vector<float>& phi) {
        pcl_uvol::saveDataset(snapshotPath(arguments.output, so_far.steps.size()),
                              pcl_uvol::extractSnapshot(dataset,
                                                        parameters,
                                                        Eigen::Array3d(sides.data()),
                                                        phi,
                                                        options.threads()),
                              {});
      });
  pcl_uvol::Dataset result = pcl_uvol::withoutCloud(dataset);
  evolution.evolve(result.cloud);
  boxed.dropImages(result);
  report.merge(evolution.getReport());
  const pcl_uvol::SamplingSummary& sampling = *evolution.getSampling();
  if (!boxed.isPeriodic()) // most of what is examined there may be images
    warnOfGuesses(sampling, report);
  const pcl_uvol::LevelSetSummary& summary = evolution.getSummary();

  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  uvol_tools::savePoints(arguments.output, result, save, report);
  if (!arguments.table.empty())
    writeTable(arguments.table, summary);
  if (!arguments.plot.empty())
    writePlot(arguments.plot, arguments.plot_size.get(), summary);
  report.count("points", points);
  total.reset();
  uvol_tools::Facts facts = {{"input", arguments.input},
                             {"output", arguments.output},
                             {"field", parameters.field}};
  uvol_tools::tellBox(boxed, facts);
  facts.insert(facts.end(), of_scale.begin(), of_scale.end());
  facts.push_back(uvol_tools::describeSampling(sampling));
  for (const auto& fact : uvol_tools::describe(summary, !parameters.mu))
    facts.push_back(fact);
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
