// SPDX-License-Identifier: BSD-3-Clause
// The main job: a file of scattered samples in, an oriented isosurface out.
#include "common/memory.h"
#include "common/scalar_field.h"
#include "io/point_stream.h"
#include "pipeline/extract_out_of_core.h"
#include "pipeline/memory_need.h"
#include "shared/isosurface_options.h"
#include "shared/level_set.h"
#include "shared/memory_guard.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/surface_picture.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/neighbors/voronoi_grid.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <sstream>

namespace {

using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::IsosurfaceResult;
using pcl_uvol::NeighborSource;
using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::joined;
using uvol_tools::Options;
using uvol_tools::UsageError;
using Facts = std::vector<std::pair<std::string, std::string>>;

struct Arguments : uvol_tools::IsosurfaceOptions {
  std::string input, output, mu = "auto", max_memory, scratch;
  std::uint64_t grid = 0, k = parameters.normal_neighbors,
                steps = parameters.level_set.max_steps;
  double max_error = std::numeric_limits<double>::infinity();
  bool ascii = false;
  uvol_tools::SurfacePicture picture;
};

void
declare(Options& options, Arguments& arguments)
{
  IsosurfacePipelineParameters& parameters = arguments.parameters;
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  arguments.declareSamples(options);
  options.choice("neighbors",
                 parameters.isosurface.neighbors,
                 "candidates from touching cells of the tree, or from adjacent regions "
                 "of a discrete Voronoi diagram: slower");
  options.integer(
      "grid",
      arguments.grid,
      1,
      pcl_uvol::GridShape::largest_side,
      "cells of -neighbors voronoi along the longest side (default: 4 samples "
      "to a cell)");
  arguments.declareMethod(options);
  options.flag("smooth",
               parameters.smooth,
               "smooth noisy or uneven samples by a level set first");
  options.text("mu",
               "m|auto",
               arguments.mu,
               "with -smooth: weight of the data against smoothness, 0 to 1; auto: by "
               "the noise");
  options.integer(
      "steps", arguments.steps, 1, 1000000, "with -smooth: time steps at most");
  options.choice("normals",
                 parameters.normals,
                 "of the fits, by principal components of the isopoints, or along the "
                 "edges; auto: fit with fits, pca with linear interpolation");
  options.integer(
      "k", arguments.k, 2, 1000, "isopoints that a normal by pca is fitted to");
  options.number("max-error",
                 arguments.max_error,
                 0.0,
                 std::numeric_limits<double>::max(),
                 "leave out isopoints of a larger estimated error, in units of length");
  options.flag("drop-bridged",
               parameters.drop_bridged,
               "leave out isopoints in gaps of the sampling");
  options.text("max-memory",
               "bytes",
               arguments.max_memory,
               "take no more memory, as in 1500M or 2G: samples wait on disk; for pcd, "
               "ply and text that are not compressed");
  options.text("scratch",
               "folder",
               arguments.scratch,
               "with -max-memory: where they wait, 24 bytes each (default: beside the "
               "output)");
  options.flag("ascii", arguments.ascii, "write PCD and PLY as text");
  arguments.picture.declare(options);
}

/** Whether something asks for all samples at once. */
bool
needsAllSamples(const Arguments& arguments)
{
  const IsosurfacePipelineParameters& parameters = arguments.parameters;
  return parameters.smooth || parameters.automatic_scale || !arguments.where.empty() ||
         parameters.isosurface.neighbors == NeighborSource::Voronoi;
}

/** What only some combinations of options allow. */
void
checkCombinations(const Options& options, const Arguments& arguments)
{
  using pcl_uvol::NormalMethod;
  const IsosurfacePipelineParameters& parameters = arguments.parameters;
  const bool fits = parameters.isosurface.interpolation == pcl_uvol::Interpolation::Fit;
  if (parameters.normals == NormalMethod::Fit && !fits)
    throw UsageError("-normals fit needs -interpolation fit.");
  if (parameters.normals == NormalMethod::Edge && fits)
    throw UsageError("-normals edge needs -interpolation linear.");
  if (options.given("grid") &&
      parameters.isosurface.neighbors != NeighborSource::Voronoi)
    throw UsageError("-grid needs -neighbors voronoi.");
  for (const char* const name : {"mu", "steps"})
    if (options.given(name) && !parameters.smooth)
      throw UsageError(std::string("-") + name + " needs -smooth.");
  if (options.given("scratch") && !options.given("max-memory"))
    throw UsageError("-scratch needs -max-memory.");
  if (options.given("max-memory") && needsAllSamples(arguments))
    throw UsageError("-max-memory goes without -smooth, -where, -scale auto and "
                     "-neighbors voronoi, which need all samples in memory.");
  if ((options.given("max-error") || parameters.drop_bridged) && !fits)
    throw UsageError("-max-error and -drop-bridged need -interpolation fit.");
}

/** The parameters that the options ask for.
 * \throws UsageError */
void
finishParameters(const Options& options, Arguments& arguments)
{
  IsosurfacePipelineParameters& parameters = arguments.parameters;
  arguments.finish();
  parameters.isosurface.voronoi_cells = static_cast<std::uint32_t>(arguments.grid);
  parameters.normal_neighbors = arguments.k;
  parameters.level_set.mu = uvol_tools::parseMu(arguments.mu);
  parameters.level_set.max_steps = arguments.steps;
  if (options.given("max-error"))
    parameters.max_error = arguments.max_error;
  checkCombinations(options, arguments);
  pcl_uvol::checkSavePath(arguments.output);
  arguments.picture.check(options);
}

/** Median, 95 % and maximum of the estimated errors. */
std::string
describeErrors(const std::optional<pcl_uvol::ErrorSummary>& errors)
{
  if (!errors)
    return "not estimated";
  std::ostringstream text;
  text.precision(3);
  text << "median " << errors->median << ", 95 % within " << errors->percentile_95
       << ", largest " << errors->largest;
  return text.str();
}

/** As MemoryGuard::describe() for a run within a bound. */
std::pair<std::string, std::string>
describeBound(const Arguments& arguments)
{
  return {"memory",
          "bound " +
              pcl_uvol::formatBytes(static_cast<double>(
                  uvol_tools::parseBytes("max-memory", arguments.max_memory))) +
              ", peak " +
              pcl_uvol::formatBytes(static_cast<double>(pcl_uvol::peakMemory()))};
}

IsosurfaceResult
runInMemory(const Options& options,
            const Arguments& arguments,
            uvol_tools::MemoryGuard& memory,
            Report& report)
{
  const IsosurfacePipelineParameters& parameters = arguments.parameters;
  const auto work =
      [&](double points, double step, pcl_uvol::MemoryForecast& forecast) {
        pcl_uvol::addMemoryNeed(parameters, points, step, {}, forecast);
      };
  if (arguments.where.empty())
    memory.checkFile(arguments.input, work);
  else
    memory.checkFile(arguments.input, nullptr);
  const auto samples = std::make_shared<pcl_uvol::Dataset>(uvol_tools::loadPoints(
      arguments.input, report, arguments.makeLoadOptions(), arguments.where));
  report.count("points", samples->cloud.width + report.getCount("removed_by_where"));
  pcl_uvol::checkSavePath(arguments.output, samples->cloud.fields);

  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(parameters);
  pipeline.setNumberOfThreads(options.threads());
  pipeline.setProgressCallback(report.progress);
  IsosurfacePipelineParameters resolved = parameters;
  resolved.isosurface = pipeline.resolveParameters();
  resolved.automatic_scale = false; // it is filled in now
  pipeline.setParameters(resolved);
  const auto sizes = pcl_uvol::estimateSurfaces(pcl_uvol::viewOf(samples->cloud),
                                                resolved.isosurface.field,
                                                resolved.isosurface.isovalues,
                                                resolved.isosurface.scale,
                                                options.threads());
  memory.checkCloud(
      *samples, [&](double points, double step, pcl_uvol::MemoryForecast& forecast) {
        pcl_uvol::addMemoryNeed(parameters, points, step, sizes, forecast);
        double isopoints = 0.0;
        for (const pcl_uvol::SurfaceSize& size : sizes)
          isopoints += size.isopoints;
        arguments.picture.addMemoryNeed(isopoints, forecast);
      });
  return pipeline.run();
}

IsosurfaceResult
runFromDisk(const Options& options, const Arguments& arguments, Report& report)
{
  pcl_uvol::PointStream points(arguments.input, arguments.makeLoadOptions());
  pcl_uvol::Dataset samples = points.getHeader();
  pcl_uvol::checkSavePath(arguments.output, samples.cloud.fields);
  IsosurfacePipelineParameters parameters = arguments.parameters;
  if (parameters.isosurface.field.empty())
    parameters.isosurface.field =
        pcl_uvol::ScalarField::defaultName(samples.cloud.fields);
  report.warnings = samples.notes;
  report.count("points", points.size());

  pcl_uvol::OutOfCoreSettings out_of_core;
  out_of_core.max_memory = uvol_tools::parseBytes("max-memory", arguments.max_memory);
  out_of_core.scratch_folder =
      arguments.scratch.empty()
          ? std::filesystem::absolute(arguments.output).parent_path().string()
          : arguments.scratch;
  out_of_core.threads = options.threads();
  Report of_surface;
  of_surface.progress = report.progress;
  auto surface = pcl_uvol::extractOutOfCore(
      points, parameters.isosurface, out_of_core, of_surface);
  samples.cloud = std::move(surface.samples);
  return pcl_uvol::finishIsosurface(samples,
                                    std::move(surface.isopoints),
                                    std::move(surface.edges),
                                    parameters,
                                    options.threads(),
                                    std::move(of_surface));
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options(
      "uvol_isosurface",
      "in.pcd out.ply -iso v[,v...] [options]",
      "Extracts the isosurface of a scalar field given at scattered points, as "
      "an oriented point cloud.\nReads pcd ply csv txt vtk vtp vtu vts, writes "
      "pcd ply vtp csv.");
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  finishParameters(options, arguments);
  const bool is_bounded = options.given("max-memory");
  uvol_tools::MemoryGuard memory(needsAllSamples(arguments)
                                     ? "An isosurface"
                                     : "Without -max-memory an isosurface");
  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  auto total = std::make_unique<StepTimer>(report, "total");
  const IsosurfaceResult result = is_bounded
                                      ? runFromDisk(options, arguments, report)
                                      : runInMemory(options, arguments, memory, report);
  report.merge(result.report);

  const auto& isovalues = arguments.parameters.isosurface.isovalues;
  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  save.comments = {"isosurface of " + result.field + " at " + joined(isovalues)};
  uvol_tools::savePoints(arguments.output, result.surface, save, report);
  Facts facts = {
      {"input", arguments.input},
      {"output", arguments.output},
      {"field", result.field},
      {"isovalues", joined(isovalues)},
      {"scale", joined(result.scale)},
      {"interpolation", toWord(arguments.parameters.isosurface.interpolation)},
      {"estimated error", describeErrors(result.errors)}};
  for (const pcl_uvol::LevelSetSummary& summary : result.level_sets)
    for (const auto& fact :
         uvol_tools::describe(summary, !arguments.parameters.level_set.mu))
      facts.push_back(fact);
  if (arguments.picture.isAskedFor())
    facts.emplace_back("backend",
                       arguments.picture.draw(options, result.surface, report));
  total.reset();
  facts.push_back(is_bounded ? describeBound(arguments) : memory.describe());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_isosurface", [&] { return run(argc, argv); });
}
