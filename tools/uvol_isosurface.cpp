// SPDX-License-Identifier: BSD-3-Clause
// The main job: a file of scattered samples in, an oriented isosurface out.
#include "common/isosurface_memory.h"
#include "common/level_set.h"
#include "common/options.h"
#include "common/point_files.h"
#include "common/progress_bar.h"
#include "common/ray_options.h"
#include "common/render_options.h"
#include "common/scale_option.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>

namespace {

using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments {
  std::string input, output, field, where, picture;
  bool raytrace = false;
  uvol_tools::RenderOptions look;
  uvol_tools::RayOptions rays;
  std::vector<double> isovalues, xyz;
  std::string scale, outside = "lower", criterion = "kept", neighbors = "kdtree";
  std::uint64_t grid = 0;
  std::string interpolation = "smooth", normals = "auto";
  double max_error = std::numeric_limits<double>::infinity();
  std::uint64_t k = 30;
  std::string mu = "auto";
  bool smooth = false, drop_bridged = false, ascii = false;
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  options.numbers("iso", "v,...", 0, arguments.isovalues, "isovalues (required)");
  options.text("field",
               "name",
               arguments.field,
               "scalar field: density, vel[1], |vel|, |vx,vy,vz| (default: intensity, "
               "else the only candidate)");
  options.text("where",
               "expr",
               arguments.where,
               "use only the points for which it holds: \"experiment=1 && T>4\"");
  options.text("scale",
               "sx,sy,sz|auto",
               arguments.scale,
               "measure distances in a stretched space; auto: equal spread per axis");
  options.numbers("xyz",
                  "ix,iy,iz",
                  3,
                  arguments.xyz,
                  "columns of a text file that hold the coordinates, from 0");
  options.choice("outside",
                 {"lower", "higher"},
                 arguments.outside,
                 "the side normals point to: where values are lower or higher");
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
  options.choice("criterion",
                 {"kept", "all"},
                 arguments.criterion,
                 "angle criterion against kept or against all closer candidates");
  options.choice("interpolation",
                 {"linear", "smooth"},
                 arguments.interpolation,
                 "isopoints along the edges, or on local polynomial fits");
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
  pcl_uvol::LoadOptions options;
  for (std::size_t i = 0; i < arguments.xyz.size(); ++i) {
    options.xyz_columns[i] = static_cast<int>(arguments.xyz[i]);
    if (options.xyz_columns[i] < 0 || options.xyz_columns[i] != arguments.xyz[i])
      throw UsageError("-xyz takes three column numbers from 0.");
  }
  pcl_uvol::Dataset dataset =
      uvol_tools::loadPoints(arguments.input, report, options, arguments.where);
  report.count("points", dataset.cloud.width + report.getCount("removed_by_where"));
  return dataset;
}

template <typename T>
std::string
joined(const T& numbers)
{
  std::ostringstream text;
  for (const auto number : numbers)
    text << (text.tellp() > 0 ? "," : "") << number;
  return text.str();
}

/** What only some combinations of options allow. */
void
checkCombinations(const Options& options, Arguments& arguments)
{
  if (arguments.isovalues.empty())
    throw UsageError(
        "-iso is missing: give one isovalue or several, as in -iso 0.3,0.6.");
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
  extraction.setOutside(arguments.outside == "lower" ? pcl_uvol::Outside::Lower
                                                     : pcl_uvol::Outside::Higher);
  extraction.setInterpolation(arguments.interpolation == "smooth"
                                  ? pcl_uvol::Interpolation::Smooth
                                  : pcl_uvol::Interpolation::Linear);
  extraction.setAngleCriterion(arguments.criterion == "kept"
                                   ? pcl_uvol::AngleCriterion::Kept
                                   : pcl_uvol::AngleCriterion::All);
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
                           uvol_tools::cloudOfPhi(view, phi),
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

/** Fields of the samples that give way to those of the isopoints: a column called
 * error, say. Coordinates and normals are meant to. */
void
warnOfReplacedFields(const pcl_uvol::Dataset& input,
                     const pcl::PCLPointCloud2& isopoints,
                     Report& report)
{
  for (const auto& field : isopoints.fields)
    if (field.name.size() > 1 && field.name.rfind("normal_", 0) != 0 &&
        pcl_uvol::findField(input.cloud.fields, field.name) != nullptr)
      report.warnings.push_back("The samples' field '" + field.name +
                                "' is left out: isopoints have one of that name.");
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
  uvol_tools::MemoryGuard memory("An isosurface");
  memory.checkFile(arguments.input, memoryOf(options, arguments, {}));

  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  auto total = std::make_unique<StepTimer>(report, "total");
  const pcl_uvol::Dataset input = load(arguments, report);
  pcl_uvol::checkSavePath(arguments.output, input.cloud.fields);
  const std::string field = arguments.field.empty()
                                ? pcl_uvol::ScalarField::defaultName(input.cloud.fields)
                                : arguments.field;
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(input.cloud);
  const Eigen::Array3f scale = scale_option.scaleOf(view);
  memory.checkCloud(
      input,
      memoryOf(options,
               arguments,
               pcl_uvol::estimateSurfaces(
                   view, field, arguments.isovalues, scale, options.threads())));
  pcl_uvol::IsoEdges edges;
  std::vector<std::pair<std::string, std::string>> level_set_facts;
  auto isopoints = arguments.smooth ? extractLevelSets(options,
                                                       arguments,
                                                       input.cloud,
                                                       field,
                                                       scale,
                                                       edges,
                                                       level_set_facts,
                                                       report)
                                    : extract(options,
                                              arguments,
                                              input.cloud,
                                              field,
                                              arguments.isovalues,
                                              scale,
                                              edges,
                                              report);
  replaceNormals(options, arguments, scale, isopoints, report);
  filter(options, arguments, isopoints, edges, report);

  pcl_uvol::Dataset output = uvol_tools::withoutCloud(input);
  {
    const StepTimer timer(report, "fields");
    pcl::toPCLPointCloud2(isopoints, output.cloud);
    warnOfReplacedFields(input, output.cloud, report);
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
  facts.push_back(memory.describe());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_isosurface", [&] { return run(argc, argv); });
}
