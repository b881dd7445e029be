// SPDX-License-Identifier: BSD-3-Clause
// The main job: a file of scattered samples in, an oriented isosurface out.
#include "common/isosurface_memory.h"
#include "common/isosurface_options.h"
#include "common/level_set.h"
#include "common/options.h"
#include "common/point_files.h"
#include "common/progress_bar.h"
#include "common/ray_options.h"
#include "common/render_options.h"
#include "common/scale_option.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/memory.h>
#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/pipeline/extract_out_of_core.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>

namespace {

using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::joined;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments : uvol_tools::IsosurfaceOptions {
  std::string input, output, picture;
  bool raytrace = false;
  uvol_tools::RenderOptions look;
  uvol_tools::RayOptions rays;
  std::string neighbors = "kdtree";
  std::uint64_t grid = 0;
  std::string normals = "auto";
  double max_error = std::numeric_limits<double>::infinity();
  std::uint64_t k = 30;
  std::string mu = "auto";
  std::string max_memory, scratch;
  bool smooth = false, drop_bridged = false, ascii = false;
};

/** Isopoints, and what they rest on. */
struct Extraction {
  pcl_uvol::Dataset input; ///< all samples, or those at the ends of edges
  std::string field;
  Eigen::Array3f scale;
  pcl::PointCloud<PointIso> isopoints;
  pcl_uvol::IsoEdges edges;
  std::vector<std::pair<std::string, std::string>> facts;
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  arguments.declareSamples(options);
  options.choice("neighbors",
                 {"kdtree", "voronoi"},
                 arguments.neighbors,
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
               arguments.smooth,
               "smooth noisy or uneven samples by a level set first");
  options.text("mu",
               "m|auto",
               arguments.mu,
               "with -smooth: weight of the data against smoothness, 0 to 1; auto: by "
               "the noise");
  options.choice("normals",
                 {"auto", "fit", "pca", "edge"},
                 arguments.normals,
                 "of the fits, by principal components of the isopoints, or along the "
                 "edges; auto: fit with smooth, pca with linear interpolation");
  options.integer(
      "k", arguments.k, 2, 1000, "isopoints that a normal by pca is fitted to");
  options.number("max-error",
                 arguments.max_error,
                 0.0,
                 std::numeric_limits<double>::max(),
                 "leave out isopoints of a larger estimated error, in units of length");
  options.flag("drop-bridged",
               arguments.drop_bridged,
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
  options.text("png",
               "out.png",
               arguments.picture,
               "draw the isosurface as well; the options below are for the picture");
  options.flag("raytrace", arguments.raytrace, "by ray tracing of splats");
}

pcl_uvol::Dataset
load(const Arguments& arguments, Report& report)
{
  pcl_uvol::Dataset dataset = uvol_tools::loadPoints(
      arguments.input, report, arguments.makeLoadOptions(), arguments.where);
  report.count("points", dataset.cloud.width + report.getCount("removed_by_where"));
  return dataset;
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

/** Whether something asks for all samples at once. */
bool
needsAllSamples(const Arguments& arguments)
{
  return arguments.smooth || !arguments.where.empty() || arguments.scale == "auto" ||
         arguments.neighbors == "voronoi";
}

/** What only some combinations of options allow. */
void
checkCombinations(const Options& options, Arguments& arguments)
{
  arguments.check();
  const bool smooth = arguments.interpolation == "smooth";
  if (arguments.normals == "auto")
    arguments.normals = smooth ? "fit" : "pca";
  if (arguments.normals == "fit" && !smooth)
    throw UsageError("-normals fit needs -interpolation smooth.");
  if (arguments.normals == "edge" && smooth)
    throw UsageError("-normals edge needs -interpolation linear.");
  if (arguments.raytrace && arguments.picture.empty())
    throw UsageError("-raytrace needs -png.");
  uvol_tools::parseMu(arguments.mu);
  if (options.given("grid") && arguments.neighbors != "voronoi")
    throw UsageError("-grid needs -neighbors voronoi.");
  if (options.given("mu") && !arguments.smooth)
    throw UsageError("-mu needs -smooth.");
  if (options.given("scratch") && !options.given("max-memory"))
    throw UsageError("-scratch needs -max-memory.");
  if (options.given("max-memory") && needsAllSamples(arguments))
    throw UsageError("-max-memory goes without -smooth, -where, -scale auto and "
                     "-neighbors voronoi, which need all samples in memory.");
  if ((options.given("max-error") || arguments.drop_bridged) && !smooth)
    throw UsageError("-max-error and -drop-bridged need -interpolation smooth.");
}

void
replaceNormals(const Options& options,
               const Arguments& arguments,
               const Eigen::Array3f& scale,
               pcl::PointCloud<PointIso>& isopoints,
               Report& report)
{
  if (arguments.normals == "edge" || isopoints.empty())
    return;
  const StepTimer timer(report, "normals");
  pcl_uvol::SurfaceNormalParameters parameters;
  parameters.k = arguments.k;
  parameters.scale = scale;
  parameters.threads = options.threads();
  if (arguments.normals == "pca")
    pcl_uvol::replaceNormals(isopoints, parameters, report);
  else
    pcl_uvol::replaceMissingNormals(isopoints, parameters, report);
}

/** Median, 95 % and maximum of the estimated errors. */
std::string
describeErrors(const pcl::PointCloud<PointIso>& isopoints)
{
  std::vector<float> errors;
  for (const PointIso& point : isopoints)
    if (!std::isnan(point.error))
      errors.push_back(point.error);
  if (errors.empty())
    return "not estimated";
  std::sort(errors.begin(), errors.end());
  std::ostringstream text;
  text.precision(3);
  text << "median " << errors[errors.size() / 2] << ", 95 % within "
       << errors[errors.size() * 95 / 100] << ", largest " << errors.back();
  return text.str();
}

/** The isopoints of one field of a cloud. */
pcl::PointCloud<PointIso>
extract(const Options& options,
        const Arguments& arguments,
        const pcl::PCLPointCloud2& cloud,
        const std::string& field,
        const std::vector<double>& isovalues,
        const Eigen::Array3f& scale,
        pcl_uvol::IsoEdges& edges,
        Report& report)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(pcl::PCLPointCloud2::ConstPtr(&cloud, [](const void*) {}));
  extraction.setScalarField(field);
  extraction.setIsoValues(isovalues);
  extraction.setScale(scale);
  const pcl_uvol::IsosurfaceSettings settings = arguments.makeSettings();
  extraction.setOutside(settings.outside);
  extraction.setInterpolation(settings.interpolation);
  extraction.setAngleCriterion(settings.criterion);
  if (arguments.neighbors == "voronoi") {
    pcl_uvol::VoronoiCandidateSettings voronoi;
    voronoi.cells = static_cast<std::uint32_t>(arguments.grid);
    extraction.setVoronoiGrid(voronoi);
  }
  extraction.setNumberOfThreads(options.threads());
  extraction.setProgressCallback(report.progress);
  pcl::PointCloud<PointIso> isopoints;
  extraction.extract(isopoints);
  report.merge(extraction.getReport());
  edges = extraction.getEdges();
  return isopoints;
}

/** \return without the scale */
pcl_uvol::LevelSetParameters
levelSetOf(const Options& options, const Arguments& arguments)
{
  pcl_uvol::LevelSetParameters parameters;
  parameters.mu = uvol_tools::parseMu(arguments.mu);
  parameters.threads = options.threads();
  return parameters;
}

/** The isopoints of the level sets that start from the isosurfaces. */
pcl::PointCloud<PointIso>
extractLevelSets(const Options& options,
                 const Arguments& arguments,
                 const pcl::PCLPointCloud2& cloud,
                 const std::string& field,
                 const Eigen::Array3f& scale,
                 pcl_uvol::IsoEdges& edges,
                 std::vector<std::pair<std::string, std::string>>& facts,
                 Report& report)
{
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(cloud);
  std::vector<int> all(view.count);
  std::iota(all.begin(), all.end(), 0);
  pcl_uvol::LevelSetParameters parameters = levelSetOf(options, arguments);
  parameters.scale = scale;
  pcl::PointCloud<PointIso> isopoints;
  for (const double isovalue : arguments.isovalues) {
    const auto [phi, summary] =
        pcl_uvol::evolveLevelSet(view, all, field, isovalue, parameters, report);
    pcl_uvol::IsoEdges found;
    auto surface = extract(options,
                           arguments,
                           pcl_uvol::cloudOfPhi(view, phi),
                           "phi",
                           {0.0},
                           scale,
                           found,
                           report);
    for (PointIso& point : surface)
      point.isovalue = static_cast<float>(isovalue);
    isopoints += surface;
    edges.insert(edges.end(), found.begin(), found.end());
    for (const auto& fact : uvol_tools::describe(summary, arguments.mu == "auto"))
      facts.push_back(fact);
  }
  return isopoints;
}

std::string
fieldOf(const Arguments& arguments, const pcl_uvol::Dataset& input)
{
  return arguments.field.empty()
             ? pcl_uvol::ScalarField::defaultName(input.cloud.fields)
             : arguments.field;
}

/** \param surfaces one per isovalue; none where their sizes are not known */
uvol_tools::MemoryGuard::Work
memoryOf(const Options& options,
         const Arguments& arguments,
         std::vector<pcl_uvol::SurfaceSize> surfaces)
{
  uvol_tools::IsosurfaceTask task;
  task.surfaces = std::move(surfaces);
  task.surfaces.resize(arguments.isovalues.size());
  task.normal_neighbors = static_cast<double>(arguments.k);
  if (arguments.smooth)
    task.level_set = levelSetOf(options, arguments);
  task.is_ray_traced = arguments.raytrace;
  const double scale = arguments.look.getSupersampling();
  if (!arguments.picture.empty())
    task.pixels =
        scale * arguments.look.getWidth() * scale * arguments.look.getHeight();
  return uvol_tools::memoryOf(task);
}

Extraction
extractInMemory(const Options& options,
                const Arguments& arguments,
                const uvol_tools::ScaleOption& scale_option,
                uvol_tools::MemoryGuard& memory,
                Report& report)
{
  memory.checkFile(arguments.input,
                   arguments.where.empty() ? memoryOf(options, arguments, {})
                                           : nullptr);
  Extraction result;
  result.input = load(arguments, report);
  pcl_uvol::checkSavePath(arguments.output, result.input.cloud.fields);
  result.field = fieldOf(arguments, result.input);
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(result.input.cloud);
  result.scale = scale_option.scaleOf(view);
  memory.checkCloud(result.input,
                    memoryOf(options,
                             arguments,
                             pcl_uvol::estimateSurfaces(view,
                                                        result.field,
                                                        arguments.isovalues,
                                                        result.scale,
                                                        options.threads())));
  result.isopoints = arguments.smooth ? extractLevelSets(options,
                                                         arguments,
                                                         result.input.cloud,
                                                         result.field,
                                                         result.scale,
                                                         result.edges,
                                                         result.facts,
                                                         report)
                                      : extract(options,
                                                arguments,
                                                result.input.cloud,
                                                result.field,
                                                arguments.isovalues,
                                                result.scale,
                                                result.edges,
                                                report);
  return result;
}

Extraction
extractFromDisk(const Options& options,
                const Arguments& arguments,
                const uvol_tools::ScaleOption& scale_option,
                Report& report)
{
  pcl_uvol::PointStream points(arguments.input, arguments.makeLoadOptions());
  Extraction result;
  result.input = points.getHeader();
  pcl_uvol::checkSavePath(arguments.output, result.input.cloud.fields);
  result.field = fieldOf(arguments, result.input);
  result.scale = scale_option.scaleOf({});
  report.warnings = result.input.notes;
  report.count("points", points.size());

  pcl_uvol::IsosurfaceSettings settings = arguments.makeSettings();
  settings.field = result.field;
  settings.scale = {{result.scale[0], result.scale[1], result.scale[2]}};
  pcl_uvol::OutOfCoreSettings out_of_core;
  out_of_core.max_memory = uvol_tools::parseBytes("max-memory", arguments.max_memory);
  out_of_core.scratch_folder =
      arguments.scratch.empty()
          ? std::filesystem::absolute(arguments.output).parent_path().string()
          : arguments.scratch;
  out_of_core.threads = options.threads();
  auto surface = pcl_uvol::extractOutOfCore(points, settings, out_of_core, report);
  result.isopoints = std::move(surface.isopoints);
  result.edges = std::move(surface.edges);
  result.input.cloud = std::move(surface.samples);
  return result;
}

/** Leave out what -max-error and -drop-bridged do not want. */
void
filter(const Options& options,
       const Arguments& arguments,
       pcl::PointCloud<PointIso>& isopoints,
       pcl_uvol::IsoEdges& edges,
       Report& report)
{
  if (options.given("max-error"))
    report.count(
        "removed_by_error",
        pcl_uvol::filterIsopoints(isopoints, edges, [&](const PointIso& point) {
          return point.error <= arguments.max_error;
        }));
  if (arguments.drop_bridged)
    report.count("removed_bridged",
                 pcl_uvol::filterIsopoints(isopoints, edges, [](const PointIso& point) {
                   return point.support !=
                          static_cast<std::uint8_t>(pcl_uvol::IsoSupport::Bridged);
                 }));
}

/** The surface in image space. \return what it was drawn on */
std::string
project(const Options& options,
        const Arguments& arguments,
        const pcl_uvol::Dataset& surface,
        Report& report)
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(surface.cloud);
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&surface.cloud, [](const void*) {}));
  arguments.look.configure(options, cloud, renderer);
  renderer.setCamera(arguments.look.makeCamera(renderer.getBounds(), surface.origin));
  pcl_uvol::Image image;
  renderer.render(image);
  arguments.look.decorate(cloud, renderer.getColorRange(), image);
  pcl_uvol::savePng(arguments.picture, image);
  report = renderer.getReport();
  return renderer.describeBackend();
}

/** The picture that -png asks for. \return what it was drawn on; "" for none */
std::string
draw(const Options& options,
     const Arguments& arguments,
     const pcl_uvol::Dataset& surface,
     Report& report)
{
  if (surface.cloud.width == 0) {
    report.warnings.push_back("There is nothing to draw: " + arguments.picture +
                              " was not written.");
    return "";
  }
  const StepTimer timer(report, "picture");
  Report drawing;
  drawing.progress = report.progress;
  std::string backend = "ray tracing";
  if (arguments.raytrace)
    arguments.rays.traceCloud(options,
                              arguments.look,
                              pcl_uvol::viewOf(surface.cloud),
                              surface.origin,
                              arguments.picture,
                              drawing);
  else
    backend = project(options, arguments, surface, drawing);
  for (const auto& [pass, milliseconds] : drawing.milliseconds)
    report.time("picture_" + pass, milliseconds);
  if (arguments.raytrace)
    report.count("splats", drawing.getCount("splats"));
  return backend;
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
  arguments.look.declareView(options);
  arguments.rays.declareRays(options);
  arguments.rays.declareSurface(options);
  if (!options.parse(argc, argv))
    return 0;
  checkCombinations(options, arguments);
  const uvol_tools::ScaleOption scale_option(arguments.scale);
  pcl_uvol::checkSavePath(arguments.output);
  arguments.look.check(options);
  arguments.rays.check(options);
  if (!arguments.picture.empty())
    pcl_uvol::checkPngPath(arguments.picture);

  uvol_tools::MemoryGuard memory(needsAllSamples(arguments)
                                     ? "An isosurface"
                                     : "Without -max-memory an isosurface");
  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  auto total = std::make_unique<StepTimer>(report, "total");
  auto [input, field, scale, isopoints, edges, level_set_facts] =
      options.given("max-memory")
          ? extractFromDisk(options, arguments, scale_option, report)
          : extractInMemory(options, arguments, scale_option, memory, report);
  replaceNormals(options, arguments, scale, isopoints, report);
  filter(options, arguments, isopoints, edges, report);

  pcl_uvol::Dataset output = uvol_tools::withoutCloud(input);
  {
    const StepTimer timer(report, "fields");
    pcl::toPCLPointCloud2(isopoints, output.cloud);
    pcl_uvol::warnOfReplacedFields(input.cloud, output.cloud, report);
    pcl_uvol::interpolateFields(input.cloud, edges, output.cloud, options.threads());
  }
  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  save.comments = {"isosurface of " + field + " at " + joined(arguments.isovalues)};
  uvol_tools::savePoints(arguments.output, output, save, report);
  std::vector<std::pair<std::string, std::string>> facts = {
      {"input", arguments.input},
      {"output", arguments.output},
      {"field", field},
      {"isovalues", joined(arguments.isovalues)},
      {"scale", joined(scale)},
      {"interpolation", arguments.interpolation},
      {"estimated error", describeErrors(isopoints)}};
  facts.insert(facts.end(), level_set_facts.begin(), level_set_facts.end());
  if (!arguments.picture.empty())
    facts.emplace_back("backend", draw(options, arguments, output, report));
  total.reset();
  facts.push_back(options.given("max-memory") ? describeBound(arguments)
                                              : memory.describe());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_isosurface", [&] { return run(argc, argv); });
}
