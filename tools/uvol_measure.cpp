// SPDX-License-Identifier: BSD-3-Clause
// Figures of surfaces: area, volume, axes, genus, integrals of fields, and the samples
// inside; of a mesh, or of the isosurfaces of samples.
#include "charts/line_plot.h"
#include "charts/picture_file.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "neighbors/periodic_box.h"
#include "shared/isosurface_options.h"
#include "shared/measure_table.h"
#include "shared/options.h"
#include "shared/periodic_option.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/series.h"
#include "shared/size_option.h"
#include "uvol_measure/block_measures.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/mesh/surface_measures.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::Report;
using pcl_uvol::SurfaceFigures;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments : uvol_tools::IsosurfaceOptions {
  std::string input, output, samples, picture, plot = "volume";
  std::uint64_t drop_pieces = 0;
  uvol_tools::SizeOption size;
  uvol_tools::PeriodicOption periodic;
  std::vector<double> block;
  bool drop_uncertain = false, with_pieces = false, is_flat = false, is_checked = false;
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output, false);
  arguments.declareSamples(options, true, "of samples");
  options.flag("smooth",
               arguments.parameters.smooth,
               "smooth noisy or uneven samples by a level set first");
  options.integer("drop-pieces",
                  arguments.drop_pieces,
                  0,
                  std::numeric_limits<std::int32_t>::max(),
                  "of samples: remove pieces of fewer triangles");
  arguments.periodic.declare(options);
  options.numbers("block",
                  "dx,dy,dz",
                  3,
                  arguments.block,
                  "of samples: instead of surfaces, volumes and means beyond the "
                  "isovalues by kriging blocks of these sides, as tonnage and grade "
                  "above a cutoff");
  options.group("Input");
  options.input(
      "samples", "file", arguments.samples, "file of samples to count inside a mesh");
  options.group("Measures");
  options.flag(
      "pieces", arguments.with_pieces, "also write a row of the table for every piece");
  options.flag(
      "flat", arguments.is_flat, "measure flat triangles instead of curved ones");
  options.flag(
      "drop-uncertain",
      arguments.drop_uncertain,
      "remove pieces whose error is as large as their area or volume, such as debris");
  options.flag("check", arguments.is_checked, "also find triangles that intersect");
  options.group("Picture");
  options
      .output("png",
              "out.png|.svg|.pdf",
              arguments.picture,
              "of samples: draw a curve over the isovalues, of a series one over time")
      .check(uvol_tools::checkPicturePath);
  options.text("plot",
               "column",
               arguments.plot,
               "with -png: the column of the table that is drawn (default volume)");
  arguments.size.declareChart(options);
  options.shareOutputs();
  uvol_tools::declareSeries(options);
}

/** Whether an option is for the samples that -samples gives. */
bool
isOfGivenSamples(const Options& options, const std::string& name)
{
  return options.given("samples") && (name == "field" || name == "outside");
}

void
checkBlock(const Options& options)
{
  if (!options.given("block"))
    return;
  if (!options.given("iso"))
    throw UsageError(
        "-block needs -iso, the values beyond which volumes are asked for.");
  for (const char* const name : {"smooth",
                                 "drop-pieces",
                                 "periodic",
                                 "pieces",
                                 "flat",
                                 "drop-uncertain",
                                 "check"})
    if (options.given(name))
      throw UsageError(std::string("-") + name +
                       " is for surfaces, and -block takes none.");
}

void
check(const Options& options, Arguments& arguments)
{
  checkBlock(options);
  const bool has_isovalues = options.given("iso");
  for (const char* const name : {"field",
                                 "where",
                                 "scale",
                                 "rotate",
                                 "xyz",
                                 "particles",
                                 "cells",
                                 "outside",
                                 "smooth",
                                 "drop-pieces",
                                 "png"})
    if (options.given(name) && !has_isovalues && !isOfGivenSamples(options, name))
      throw UsageError(std::string("-") + name +
                       " is for isosurfaces of samples, which need -iso.");
  if (has_isovalues) {
    arguments.finish(options);
    if (options.given("samples"))
      throw UsageError("-samples is for meshes: those that -iso is for are known.");
    arguments.parameters.mesh.emplace();
    arguments.parameters.mesh->drop_pieces = arguments.drop_pieces;
  }
  arguments.periodic.check();
  arguments.size.checkChart(options, "png", !arguments.picture.empty());
  if (options.given("plot") && arguments.picture.empty())
    throw UsageError("-plot needs -png.");
  if (options.given("pieces") && arguments.output.empty())
    throw UsageError("-pieces needs a file for the table.");
  const bool is_over_time = uvol_tools::isOfAll(arguments.picture);
  const std::size_t isovalues = arguments.parameters.isosurface.isovalues.size();
  if (!arguments.picture.empty() && !is_over_time && isovalues < 2)
    throw UsageError("-png draws a curve over isovalues: give -iso two or more.");
  if (is_over_time && isovalues != 1)
    throw UsageError("-png of a series draws a curve over time: give -iso one value.");
  if (!arguments.output.empty())
    pcl_uvol::checkSavePath(arguments.output);
}

/** A surface, and the samples to look for inside. */
struct Surface {
  std::shared_ptr<Dataset> vertices = std::make_shared<Dataset>();
  std::vector<pcl_uvol::Triangle> triangles;
  std::shared_ptr<const Dataset> samples;
  std::string field; ///< that it is an isosurface of; empty: not known
  std::array<double, 3> periodic{};
};

Surface
loadSurface(const Options& options, const Arguments& arguments, Report& report)
{
  Surface surface;
  if (pcl_uvol::isMeshPath(arguments.input))
    *surface.vertices =
        uvol_tools::loadMesh(arguments.input, surface.triangles, report);
  else
    *surface.vertices = uvol_tools::loadPoints(arguments.input, report);
  const auto& fields = surface.vertices->cloud.fields;
  if (surface.triangles.empty() && pcl_uvol::findField(fields, "normal_x") == nullptr)
    throw UsageError("'" + arguments.input +
                     "' has neither triangles nor normals: isosurfaces of samples need "
                     "-iso.");
  if (surface.triangles.empty())
    for (const char* const name : {"samples", "flat", "check"})
      if (options.given(name))
        throw UsageError(std::string("-") + name + " needs triangles, and '" +
                         arguments.input + "' has points only.");
  if (!arguments.samples.empty())
    surface.samples =
        std::make_shared<Dataset>(uvol_tools::loadPoints(arguments.samples, report));
  surface.field = arguments.parameters.isosurface.field;
  const Dataset& in_box = surface.samples ? *surface.samples : *surface.vertices;
  surface.periodic = arguments.periodic.findSides(in_box);
  pcl_uvol::warnOfUnusedBox(in_box, surface.periodic, report);
  return surface;
}

/** Samples with the field that is asked for. */
std::shared_ptr<Dataset>
loadSamples(const Options& options, Arguments& arguments, Report& report)
{
  auto samples =
      std::make_shared<Dataset>(uvol_tools::loadPoints(arguments.input,
                                                       report,
                                                       arguments.makeLoadOptions(),
                                                       arguments.getWhere(),
                                                       options.threads()));
  arguments.resolveSpacing(*samples);
  uvol_tools::addField(
      *samples, arguments.parameters.isosurface.field, options, report);
  return samples;
}

/** Meshes of the isosurfaces of samples. */
Surface
extractSurface(const Options& options, Arguments& arguments, Report& report)
{
  const auto samples = loadSamples(options, arguments, report);
  const std::array<double, 3> sides = arguments.periodic.findSides(*samples);
  if (pcl_uvol::isPeriodic(sides)) {
    arguments.parameters.periodic = {sides[0], sides[1], sides[2]};
    arguments.parameters.periodic_mesh = pcl_uvol::PeriodicMesh::Weld;
  }
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(arguments.parameters);
  pipeline.setNumberOfThreads(options.threads());
  pipeline.setProgressCallback(report.progress);
  pcl_uvol::IsosurfaceResult result = pipeline.run();
  report.merge(result.report);
  if (result.triangles.empty())
    throw pcl_uvol::InvalidArgument("no_surface_to_measure", {{"field", result.field}});
  return {std::make_shared<Dataset>(std::move(result.surface)),
          std::move(result.triangles),
          samples,
          result.field,
          sides};
}

/** Whether isovalues are nearer to even ratios than to even steps. */
bool
areLogarithmic(const std::vector<double>& isovalues)
{
  const double low = isovalues.front(), high = isovalues.back(),
               middle = isovalues[isovalues.size() / 2];
  return low > 0.0 && high > 0.0 && isovalues.size() > 2 &&
         std::abs(middle - std::sqrt(low * high)) <
             std::abs(middle - 0.5 * (low + high));
}

/** Names of columns, as many as a sentence holds. */
std::string
listColumns(const uvol_tools::MeasureTable& table)
{
  constexpr std::size_t most_bytes = 140;
  std::string text;
  std::size_t left = table.getColumns().size();
  for (const auto& [column, numbers] : table.getColumns()) {
    const std::string name = pcl_uvol::shortenText(column);
    if (text.size() + name.size() > most_bytes)
      return text + " and " + std::to_string(left) + " more";
    text += (text.empty() ? "" : ", ") + name;
    --left;
  }
  return text;
}

/** The column of -plot over another one, without the rows of pieces. */
uvol_tools::Profile
makeProfile(const Arguments& arguments,
            const uvol_tools::MeasureTable& table,
            const std::string& abscissa)
{
  const std::vector<double>* const values = table.find(arguments.plot);
  if (values == nullptr)
    throw UsageError("There is no column " + pcl_uvol::quoteText(arguments.plot) +
                     " to plot; there are " + listColumns(table) + ".");
  const std::vector<double>* const errors = table.find(arguments.plot + "_error");
  const std::vector<double>& pieces = *table.find("piece");
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i] < 0.0) // all of an isovalue
      order.push_back(i);
  const std::vector<double>& abscissas = *table.find(abscissa);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return abscissas[a] < abscissas[b];
  });
  uvol_tools::Profile profile;
  for (const std::size_t i : order) {
    profile.abscissas.push_back(abscissas[i]);
    profile.values.push_back((*values)[i]);
    profile.errors.push_back(errors == nullptr ? 0.0 : (*errors)[i]);
  }
  profile.abscissa = abscissa;
  profile.ordinate = arguments.plot;
  return profile;
}

void
savePicture(const Arguments& arguments, const uvol_tools::Profile& profile)
{
  const uvol_tools::Paper& paper = arguments.size.get();
  const uvol_tools::PictureFile file(arguments.picture, paper.dots_per_inch);
  file.save(uvol_tools::drawProfile(profile, paper));
}

void
drawCurve(const Arguments& arguments, const uvol_tools::MeasureTable& table)
{
  uvol_tools::Profile profile = makeProfile(arguments, table, "isovalue");
  if (areLogarithmic(profile.abscissas)) {
    for (double& isovalue : profile.abscissas)
      isovalue = std::log10(isovalue);
    profile.abscissa = "log10 of the isovalue";
  }
  savePicture(arguments, profile);
}

/** A table with a row per isovalue, and per piece if that is asked for, and what is
 * told of it. */
struct Measured {
  uvol_tools::MeasureTable table;
  uvol_tools::Facts facts;
};

Measured
measureSurfaces(const Options& options,
                const Arguments& arguments,
                const Surface& surface,
                Report& report)
{
  pcl_uvol::SurfaceMeasuresParameters parameters;
  parameters.curved = !arguments.is_flat;
  parameters.find_intersections = arguments.is_checked;
  parameters.drop_uncertain = arguments.drop_uncertain;
  parameters.field = surface.field;
  parameters.outside = arguments.parameters.isosurface.outside;
  parameters.periodic = {surface.periodic[0], surface.periodic[1], surface.periodic[2]};
  const SurfaceFigures figures =
      uvol_tools::measureSurface(surface.vertices,
                                 surface.triangles,
                                 surface.samples,
                                 arguments.parameters.isosurface.isovalues,
                                 parameters,
                                 options.threads(),
                                 report);
  uvol_tools::MeasureTable table(figures.isovalues);
  if (arguments.with_pieces)
    table.append(figures.pieces);
  return {table, uvol_tools::describeMeasures(figures)};
}

Measured
measureBlocks(const Options& options, Arguments& arguments, Report& report)
{
  pcl_uvol::IsosurfacePipeline pipeline; // finds what is left to it: field and scale
  const auto samples = loadSamples(options, arguments, report);
  pipeline.setInput(samples);
  pipeline.setParameters(arguments.parameters);
  pipeline.setNumberOfThreads(options.threads());
  const pcl_uvol::IsosurfaceParameters parameters = pipeline.resolveParameters();
  pcl_uvol::detail::BlockParameters blocks;
  blocks.field = parameters.field;
  blocks.isovalues = parameters.isovalues;
  blocks.is_lower_outside = parameters.outside == pcl_uvol::Outside::Lower;
  blocks.sides = Eigen::Map<const Eigen::Array3d>(arguments.block.data()).cast<float>();
  blocks.scale = parameters.scale;
  blocks.rotation = arguments.parameters.rotation;
  auto found = pcl_uvol::detail::estimateBlockVolumes(
      pcl_uvol::viewOf(samples->cloud), blocks, options.threads(), report);
  for (pcl_uvol::detail::BlockVolume& beyond : found.isovalues)
    beyond.centroid += Eigen::Map<const Eigen::Vector3d>(samples->origin.data());
  return {uvol_tools::makeTable(found, parameters.field),
          uvol_tools::describeBlocks(found, parameters.field)};
}

/** What the files of a series have in common: a table over time, and its picture. */
class MeasureSeries {
public:
  /** Add the rows of a file. */
  void
  add(const Arguments& arguments,
      const uvol_tools::SeriesStep& step,
      uvol_tools::MeasureTable rows)
  {
    // Which outputs are those of all files is known while one of them is worked on.
    arguments_ = arguments;
    writes_table_ = uvol_tools::isOfAll(arguments.output);
    draws_curve_ = uvol_tools::isOfAll(arguments.picture);
    have_times_ = have_times_ && step.time;
    rows.prepend("time", step.time.value_or(std::numeric_limits<double>::quiet_NaN()));
    rows.prepend("number", static_cast<double>(step.number));
    table_.append(rows);
    ++files_;
  }

  /** Write what is the same file for all of them. */
  void
  write() const
  {
    if (writes_table_) {
      Report report;
      uvol_tools::savePoints(arguments_.output, table_.toDataset(), {}, report);
    }
    if (draws_curve_)
      savePicture(arguments_,
                  makeProfile(arguments_, table_, have_times_ ? "time" : "number"));
  }

  bool
  isEmpty() const
  {
    return files_ == 0;
  }

private:
  Arguments arguments_;
  uvol_tools::MeasureTable table_{uvol_tools::Fact::Members()};
  bool have_times_ = true, writes_table_ = false, draws_curve_ = false;
  std::size_t files_ = 0;
};

int
run(int argc, char** argv, const uvol_tools::SeriesStep* step, MeasureSeries& series)
{
  Arguments arguments;
  Options options(
      "uvol_measure",
      "surface-or-samples [out.csv] [options]",
      "Measure a mesh (ply vtp vtkhdf obj off stl), points with normals, or "
      "isosurfaces of samples (-iso).\n"
      "Report: area, volume, centroid, axes, genus, integrals of fields on the "
      "surface and inside, and the\n"
      "samples inside (points: no genus, no integrals inside). Output: csv pcd ply "
      "vtp, a row per isovalue.");
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  check(options, arguments);
  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  const Measured measured =
      options.given("block")
          ? measureBlocks(options, arguments, report)
          : measureSurfaces(options,
                            arguments,
                            options.given("iso")
                                ? extractSurface(options, arguments, report)
                                : loadSurface(options, arguments, report),
                            report);
  if (step)
    series.add(arguments, *step, measured.table);
  if (!arguments.picture.empty() && !uvol_tools::isOfAll(arguments.picture))
    drawCurve(arguments, measured.table);
  if (!arguments.output.empty() && !uvol_tools::isOfAll(arguments.output))
    uvol_tools::savePoints(arguments.output, measured.table.toDataset(), {}, report);
  uvol_tools::Facts facts = {{"input", arguments.input}};
  uvol_tools::append(facts, measured.facts);
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  constexpr const char* tool = "uvol_measure";
  MeasureSeries series;
  const int outcome = uvol_tools::runSeries(
      tool,
      argc,
      argv,
      [&](int count, char** words, const uvol_tools::SeriesStep* step) {
        return run(count, words, step, series);
      });
  if (series.isEmpty())
    return outcome;
  const int written = uvol_tools::runTool(tool, [&] {
    series.write();
    return 0;
  });
  return outcome == 0 ? written : outcome;
}
