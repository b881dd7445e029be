// SPDX-License-Identifier: BSD-3-Clause
// The main job: a file of scattered samples in, an oriented isosurface out.
#include "common/memory.h"
#include "common/number_range.h"
#include "common/numbers.h"
#include "common/scalar_field.h"
#include "expressions/derived_source.h"
#include "expressions/memory_need.h"
#include "interpolation/outer_layer.h"
#include "io/point_stream.h"
#include "pipeline/extract_out_of_core.h"
#include "pipeline/memory_need.h"
#include "shared/level_set.h"
#include "shared/measure_table.h"
#include "shared/memory_guard.h"
#include "shared/options.h"
#include "shared/pipeline_options.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/sampling_fact.h"
#include "shared/series.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/mesh.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>

namespace {

using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::IsosurfaceResult;
using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::Fact;
using uvol_tools::Facts;
using uvol_tools::joined;
using uvol_tools::Options;
using Arguments = uvol_tools::PipelineOptions;

/** Median, 95 % and maximum of the estimated errors. */
Fact
describeErrors(const std::optional<pcl_uvol::ErrorSummary>& errors)
{
  if (!errors)
    return {"estimated error", "not estimated", Fact::Members()};
  std::ostringstream text;
  text.precision(3);
  text << "median " << errors->median << ", 95 % within " << errors->percentile_95
       << ", largest " << errors->largest;
  return {"estimated error",
          text.str(),
          Fact::Members{{"median", {errors->median}},
                        {"percentile_95", {errors->percentile_95}},
                        {"largest", {errors->largest}}}};
}

std::string
describeShares(const char* what, const pcl_uvol::ClassShares& shares, std::size_t count)
{
  std::ostringstream text;
  text.precision(3);
  text << what << " right for " << 100.0 * shares.predicted << " % of " << count
       << " (nearest sample " << 100.0 * shares.nearest << " %, always the same "
       << 100.0 * shares.base << " %)";
  return text.str();
}

/** The hold-out test of one isovalue. */
Facts
describeValidation(const pcl_uvol::ValidationScore& score,
                   const std::string& of_isovalue)
{
  std::ostringstream beyond;
  beyond.precision(3);
  beyond << 100.0 * score.side_beyond_error << " % of " << score.beyond_error
         << " on the right side";
  const auto number = [](auto value) {
    return Fact::Numbers{static_cast<double>(value)};
  };
  return {
      Fact("left out near the surface" + of_isovalue,
           score.covered == 0 ? std::string("none of ") + std::to_string(score.tested)
                              : describeShares("side", score.side, score.covered))
          .withoutJson(),
      Fact("left out" + of_isovalue, describeShares("class", score.field, score.tested))
          .withoutJson(),
      Fact("left out beyond the error" + of_isovalue,
           score.beyond_error == 0 ? std::string("none") : beyond.str())
          .withoutJson(),
      Fact("validation" + of_isovalue,
           "",
           Fact::Members{{"tested", number(score.tested)},
                         {"near", number(score.covered)},
                         {"side", number(score.side.predicted)},
                         {"side_of_nearest", number(score.side.nearest)},
                         {"side_base", number(score.side.base)},
                         {"side_of_field", number(score.side_of_field)},
                         {"side_everywhere", number(score.side_everywhere)},
                         {"class", number(score.field.predicted)},
                         {"class_of_nearest", number(score.field.nearest)},
                         {"class_base", number(score.field.base)},
                         {"beyond_error", number(score.beyond_error)},
                         {"side_beyond_error", number(score.side_beyond_error)}})};
}

Fact
describeGaps(const pcl_uvol::GapFilling& gaps)
{
  std::ostringstream text;
  text.precision(3);
  if (gaps.predicted == 0)
    text << "none found to fill";
  else
    text << gaps.predicted << " samples predicted, " << gaps.spacing
         << " apart, up to the range " << gaps.range
         << " of a spherical variogram (nugget " << gaps.nugget << ", sill "
         << gaps.sill << ")";
  return {"gaps",
          text.str(),
          Fact::Members{{"predicted", {static_cast<double>(gaps.predicted)}},
                        {"spacing", {gaps.spacing}},
                        {"range", {gaps.range}},
                        {"nugget", {gaps.nugget}},
                        {"sill", {gaps.sill}}}};
}

/** As MemoryGuard::describe() for a run within a bound. */
Fact
describeBound(const Options& options, const Arguments& arguments)
{
  const auto bound =
      static_cast<double>(arguments.makeOutOfCoreSettings(options).max_memory);
  const auto peak = static_cast<double>(pcl_uvol::peakMemory());
  return {"memory",
          "bound " + pcl_uvol::formatBytes(bound) + ", peak " +
              pcl_uvol::formatBytes(peak),
          Fact::Members{{"bound", {bound}}, {"peak", {peak}}}};
}

/** The memory of fields that are computed first.
 * \param step of a point; becomes that with the fields */
void
addFieldsNeed(const Arguments& arguments,
              double points,
              double& step,
              pcl_uvol::MemoryForecast& forecast)
{
  forecast.run(
      pcl_uvol::derivedFieldNeed(arguments.parameters.isosurface.field, points, step));
  arguments.picture.addColorNeed(points, step, forecast);
}

/** Before work whose result would be lost. */
void
checkOutput(const Arguments& arguments, const pcl_uvol::Dataset& samples)
{
  if (!pcl_uvol::isMeshOnly(arguments.output))
    pcl_uvol::checkSavePath(arguments.output, samples.cloud.fields);
}

void
addOuterLayer(const Options& options,
              const Arguments& arguments,
              pcl_uvol::Dataset& samples,
              Report& report)
{
  if (arguments.parameters.isosurface.interpolation != pcl_uvol::Interpolation::Linear)
    report.warnings.push_back(
        "Fits swing where the field steps to the value outside: pieces beside the "
        "surface "
        "may be theirs, and -interpolation linear, for points, has none.");
  const std::string& field = arguments.parameters.isosurface.field;
  pcl_uvol::addOuterLayer(
      samples,
      field.empty() ? pcl_uvol::ScalarField::defaultName(samples.cloud.fields) : field,
      arguments.outside_value,
      options.threads(),
      report);
}

/** The samples with all fields that are asked for. */
std::shared_ptr<pcl_uvol::Dataset>
loadSamples(const Options& options,
            Arguments& arguments,
            uvol_tools::MemoryGuard& memory,
            Report& report)
{
  auto samples = std::make_shared<pcl_uvol::Dataset>(
      uvol_tools::loadPoints(arguments.input,
                             report,
                             arguments.makeLoadOptions(),
                             arguments.where,
                             options.threads()));
  report.count("points", samples->cloud.width + report.getCount("removed_by_where"));
  memory.checkCloud(
      *samples, [&](double points, double step, pcl_uvol::MemoryForecast& forecast) {
        if (arguments.density.isAskedFor())
          forecast.run(uvol_tools::DensityOptions::getMemoryNeed(points, step));
        addFieldsNeed(arguments, points, step, forecast);
      });
  const auto sides = arguments.periodic.findSides(*samples, report);
  arguments.parameters.periodic = Eigen::Array3d(sides.data());
  const auto add_fields = [&](pcl_uvol::Dataset& points) {
    arguments.density.addField(points, options.threads(), report);
    if (arguments.density.isAskedFor() && arguments.parameters.isosurface.field.empty())
      arguments.parameters.isosurface.field = "sph_density";
    uvol_tools::addField(
        points, arguments.parameters.isosurface.field, options, report);
    if (std::isfinite(arguments.outside_value))
      addOuterLayer(options, arguments, points, report);
    arguments.picture.addColorOfSamples(options, points, report);
  };
  if (arguments.hasFieldsOfNeighbors())
    uvol_tools::addFieldsInBox(*samples,
                               sides,
                               arguments.density.findReach(*samples),
                               options.threads(),
                               add_fields);
  else
    add_fields(*samples);
  checkOutput(arguments, *samples);
  return samples;
}

/** Measure the surface and look for intersections, as asked for, and give its points
 * their share of the area and their piece. */
Facts
measureResult(const Options& options,
              const Arguments& arguments,
              const std::shared_ptr<const pcl_uvol::Dataset>& samples,
              IsosurfaceResult& result)
{
  const bool is_measured = arguments.getMesh().isMeasured();
  pcl_uvol::SurfaceMeasuresParameters parameters;
  parameters.find_intersections = arguments.getMesh().isChecked();
  const bool is_mesh = !result.triangles.empty();
  if (result.surface.cloud.width == 0 ||
      arguments.parameters.mesh.has_value() != is_mesh ||
      (!is_measured && !parameters.find_intersections))
    return {};
  const auto vertices = std::make_shared<pcl_uvol::Dataset>(std::move(result.surface));
  const pcl_uvol::SurfaceFigures figures =
      uvol_tools::measureSurface(vertices,
                                 result.triangles,
                                 is_measured && is_mesh ? samples : nullptr,
                                 arguments.parameters.isosurface.isovalues,
                                 parameters,
                                 options.threads(),
                                 result.report);
  result.surface = std::move(*vertices);
  if (!is_measured)
    return {};
  setField(result.surface, "area", figures.vertex_areas);
  if (!is_mesh)
    setField(result.surface, "piece", figures.piece_of);
  return uvol_tools::describeMeasures(figures);
}

/** \param[out] figures of the box that repeats, and of the mesh, where it is measured
 */
IsosurfaceResult
runInMemory(const Options& options,
            Arguments& arguments,
            uvol_tools::MemoryGuard& memory,
            Report& report,
            Facts& figures)
{
  const auto work =
      [&](double points, double step, pcl_uvol::MemoryForecast& forecast) {
        addFieldsNeed(arguments, points, step, forecast);
        pcl_uvol::addMemoryNeed(arguments.parameters, points, step, {}, forecast);
      };
  if (arguments.where.empty())
    memory.checkFile(arguments.input, work, arguments.makeLoadOptions());
  else
    memory.checkFile(arguments.input, nullptr, arguments.makeLoadOptions());
  const auto samples = loadSamples(options, arguments, memory, report);
  const IsosurfacePipelineParameters& parameters = arguments.parameters;
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(parameters);
  pipeline.setNumberOfThreads(options.threads());
  pipeline.setProgressCallback(report.progress);
  IsosurfacePipelineParameters resolved = parameters;
  resolved.isosurface = pipeline.resolveParameters();
  resolved.automatic_scale = false; // it is filled in now
  pipeline.setParameters(resolved);
  const auto sizes = pcl_uvol::estimateSurfaces(
      pcl_uvol::viewOf(samples->cloud), resolved.isosurface, options.threads());
  memory.checkCloud(
      *samples, [&](double points, double step, pcl_uvol::MemoryForecast& forecast) {
        pcl_uvol::addMemoryNeed(parameters, points, step, sizes, forecast);
        double isopoints = 0.0;
        for (const pcl_uvol::SurfaceSize& size : sizes)
          isopoints += size.isopoints;
        arguments.picture.addMemoryNeed(
            isopoints, arguments.parameters.isosurface.isovalues.size(), forecast);
      });
  IsosurfaceResult result = pipeline.run();
  if ((resolved.periodic > 0.0).any()) {
    Report own; // the pipeline has told of samples outside
    figures.push_back(uvol_tools::describeBox(
        pcl_uvol::findPeriodicBox(
            *samples,
            {{resolved.periodic[0], resolved.periodic[1], resolved.periodic[2]}},
            own),
        samples->origin));
  }
  for (const Fact& fact : measureResult(options, arguments, samples, result))
    figures.push_back(fact);
  return result;
}

IsosurfaceResult
runFromDisk(const Options& options, const Arguments& arguments, Report& report)
{
  pcl_uvol::PointStream file(arguments.input, arguments.makeLoadOptions());
  pcl_uvol::IsosurfacePipelineParameters parameters = arguments.parameters;
  pcl_uvol::DerivedSource points(file, parameters.isosurface.field, options.threads());
  parameters.isosurface.field = points.getField();
  checkOutput(arguments, points.getHeader());
  report.warnings = points.getHeader().notes;
  report.count("points", points.size());
  auto result = pcl_uvol::runPipelineOutOfCore(
      points, parameters, arguments.makeOutOfCoreSettings(options), report.progress);
  points.tell(report);
  return result;
}

bool
isStl(const std::string& path)
{
  return pcl_uvol::lowerCase(std::filesystem::path(path).extension().string()) ==
         ".stl";
}

void
saveMesh(const std::string& path,
         const IsosurfaceResult& result,
         const pcl_uvol::SaveOptions& options,
         Report& report)
{
  const StepTimer timer(report, "write");
  const auto& origin = result.surface.origin;
  if (isStl(path) && origin != std::array<double, 3>{})
    report.warnings.push_back(
        "STL holds single precision, which these coordinates exceed: those in the file "
        "are relative to " +
        joined(std::vector<double>(origin.begin(), origin.end())) + ".");
  pcl_uvol::saveMesh(path, result.surface, result.triangles, options);
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options(
      "uvol_isosurface",
      "in.pcd out.ply -iso v[,v...] [options]",
      "Extracts the isosurface of a scalar field given at scattered points, as "
      "an oriented point cloud,\nor with -mesh as a closed triangle mesh.\nReads pcd "
      "ply csv txt vtk vtp vtu vts h5 nc, snapshots of Gadget and others (uvol "
      "--list-formats), writes pcd ply vtp csv, "
      "meshes as ply vtp obj off "
      "stl.");
  arguments.declare(options);
  uvol_tools::declareSeries(options);
  if (!options.parse(argc, argv))
    return 0;
  arguments.finish(options);
  const bool is_bounded = options.given("max-memory");
  uvol_tools::MemoryGuard memory(arguments.needsAllSamples()
                                     ? "An isosurface"
                                     : "Without -max-memory an isosurface");
  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  auto total = std::make_unique<StepTimer>(report, "total");
  uvol_tools::Facts figures;
  IsosurfaceResult result =
      is_bounded ? runFromDisk(options, arguments, report)
                 : runInMemory(options, arguments, memory, report, figures);
  report.merge(result.report);
  arguments.picture.addColor(options, result.surface, report);

  const auto& isovalues = arguments.parameters.isosurface.isovalues;
  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  save.comments = {"isosurface of " + result.field + " at " + joined(isovalues)};
  if (arguments.parameters.mesh)
    saveMesh(arguments.output, result, save, report);
  else
    uvol_tools::savePoints(arguments.output, result.surface, save, report);
  uvol_tools::Facts facts = {
      {"input", arguments.input},
      {"output", arguments.output},
      {"field", result.field},
      {"isovalues", joined(isovalues), isovalues},
      {"isopoints per isovalue", uvol_tools::toNumbers(result.isopoints)},
      {"scale", uvol_tools::toNumbers(result.scale)},
      {"interpolation", toWord(arguments.parameters.isosurface.interpolation)},
      describeErrors(result.errors)};
  if (result.sampling)
    facts.push_back(uvol_tools::describeSampling(*result.sampling));
  if (result.gaps)
    facts.push_back(describeGaps(*result.gaps));
  const auto of_isovalue = [&](std::size_t i) {
    return isovalues.size() > 1 ? " at " + pcl_uvol::describeNumbers({isovalues[i]})[0]
                                : "";
  };
  const auto append = [&](const Facts& more) {
    facts.insert(facts.end(), more.begin(), more.end());
  };
  if (arguments.parameters.mesh)
    append(uvol_tools::describeMesh(result));
  append(figures);
  for (std::size_t i = 0; i < result.level_sets.size(); ++i)
    append(uvol_tools::describe(
        result.level_sets[i], !arguments.parameters.level_set.mu, of_isovalue(i)));
  for (std::size_t i = 0; i < result.validation.size(); ++i)
    append(describeValidation(result.validation[i], of_isovalue(i)));
  if (arguments.picture.isAskedFor())
    facts.emplace_back("backend",
                       arguments.picture.draw(options, result.surface, report));
  total.reset();
  facts.push_back(is_bounded ? describeBound(options, arguments) : memory.describe());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_isosurface", argc, argv, run);
}
