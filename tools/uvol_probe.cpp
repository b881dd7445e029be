// SPDX-License-Identifier: BSD-3-Clause
// The field between scattered samples: at points, along lines, in planes and in grids,
// and how sure it is.
#include "interpolation/answer_summary.h"
#include "io/cell_loader.h"
#include "io/formats.h"
#include "io/memory_need.h"
#include "neighbors/samples_in_box.h"
#include "neighbors/sampling.h"
#include "pipeline/periodic_surface.h"
#include "shared/options.h"
#include "shared/periodic_option.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/sampling_fact.h"
#include "shared/series.h"
#include "shared/size_option.h"
#include "uvol_probe/interpolation_options.h"
#include "uvol_probe/probe_picture.h"
#include "uvol_probe/probe_run.h"
#include "uvol_probe/query_options.h"
#include "uvol_probe/variogram_output.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/interpolation/field_interpolation.h>
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::InterpolationModel;
using pcl_uvol::InterpolationParameters;
using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using pcl_uvol::detail::AnswerSummary;
using pcl_uvol::detail::FieldInterpolator;
using pcl_uvol::detail::Slice;
using uvol_tools::Fact;
using uvol_tools::Facts;
using uvol_tools::Options;
using uvol_tools::UsageError;
using Kind = uvol_tools::QueryOptions::Kind;

struct Arguments {
  std::string input, output;
  uvol_tools::InputOptions reading;
  uvol_tools::PeriodicOption periodic;
  uvol_tools::QueryOptions queries;
  uvol_tools::InterpolationOptions model;
  uvol_tools::ProbePicture picture;
  uvol_tools::VariogramOutput variogram;
  uvol_tools::SizeOption picture_size{"", "png-size"};
  bool ascii = false;
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output, false);
  options.group("Where");
  arguments.queries.declare(options);
  options.group("Model");
  arguments.model.declare(options);
  options.group("Input");
  arguments.reading.declare(options);
  arguments.periodic.declare(options);
  options.group("Output");
  options.flag("ascii", arguments.ascii, "write PCD and PLY as text");
  arguments.variogram.declare(options);
  arguments.picture.declare(options);
  arguments.picture_size.declareChart(options);
}

void
check(const Options& options, Arguments& arguments)
{
  arguments.queries.finish(options);
  arguments.model.finish(options);
  arguments.periodic.check();
  arguments.reading.makeLoadOptions(); // what is wrong is told before files are read
  const Kind kind = arguments.queries.getKind();
  arguments.picture_size.checkChart(options,
                                    "png or -variogram-png",
                                    arguments.picture.isAskedFor() ||
                                        arguments.variogram.isDrawn());
  const uvol_tools::Paper& paper = arguments.picture_size.get();
  arguments.picture.finish(options, kind == Kind::Plane, kind == Kind::Line, paper);
  arguments.variogram.finish(options, arguments.model.getParameters().model, paper);
  if (kind == Kind::None) {
    const bool has_work =
        arguments.model.hasValidation() || arguments.variogram.isAskedFor();
    if (!has_work || !arguments.output.empty())
      throw UsageError("Say where the field is asked for: -points, -line, -plane or "
                       "-grid.");
    return;
  }
  if (arguments.output.empty())
    throw UsageError("The argument <out> is missing: where the values go.");
  if (!uvol_tools::isWrittenInParts(arguments.queries, arguments.output))
    pcl_uvol::checkSavePath(arguments.output);
}

/** What the values of each field range over. */
void
addRanges(const AnswerSummary& summary, Facts& facts)
{
  Facts ranges;
  for (const AnswerSummary::Field& field : summary.getFields()) {
    std::ostringstream text;
    if (field.count == 0)
      text << "no value";
    else
      text << field.low << " to " << field.high;
    const auto number = [&](double value) {
      return field.count > 0 ? Fact::Numbers{value} : Fact::Numbers{};
    };
    facts.push_back(Fact(field.name, text.str()).withoutJson());
    ranges.emplace_back(field.name,
                        "",
                        Fact::Members{{"values", {static_cast<double>(field.count)}},
                                      {"min", number(field.low)},
                                      {"max", number(field.high)}});
  }
  facts.emplace_back("ranges", ranges);
}

/** How samples are read: -xyz may be meant for the file of -points only. */
pcl_uvol::LoadOptions
findSampleOptions(const Arguments& arguments, const pcl_uvol::LoadOptions& all)
{
  pcl_uvol::LoadOptions options = all;
  const std::string& points = arguments.queries.getPoints();
  if (!points.empty() &&
      pcl_uvol::io::adaptOptions(points, all).xyz_columns == all.xyz_columns)
    options.xyz_columns = pcl_uvol::io::adaptOptions(arguments.input, all).xyz_columns;
  return options;
}

/** \param lattice null for points */
pcl_uvol::detail::ExpectedQueries
expectQueries(const Arguments& arguments, const Slice* lattice)
{
  using pcl_uvol::detail::QueryShape;
  const Kind kind = arguments.queries.getKind();
  const QueryShape shape = kind == Kind::Line    ? QueryShape::Line
                           : kind == Kind::Plane ? QueryShape::Plane
                                                 : QueryShape::Space;
  if (!lattice) {
    const auto header = pcl_uvol::peekHeader(arguments.queries.getPoints());
    return {shape, header ? static_cast<double>(header->points) : 0.0};
  }
  const std::size_t most =
      uvol_tools::isWrittenInParts(arguments.queries, arguments.output)
          ? pcl_uvol::detail::lattice_block
          : lattice->lattice.size();
  return {shape, static_cast<double>(std::min(lattice->lattice.size(), most))};
}

/** The box of the samples, as they are told.
 * \param sides of a box that repeats and begins where coordinates do, or 0 */
pcl_uvol::detail::Bounds
findBounds(const Dataset& samples, const std::array<double, 3>& sides)
{
  auto bounds = pcl_uvol::detail::findBounds(pcl_uvol::viewOf(samples.cloud));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (sides[axis] > 0.0) {
      bounds.low[axis] = 0.0;
      bounds.high[axis] = sides[axis];
    }
    bounds.low[axis] += samples.origin[axis];
    bounds.high[axis] += samples.origin[axis];
  }
  return bounds;
}

/** The cells of the input, where they decide where its data are. Points that were left
 * out, and images, have none.
 * \return null where the samples decide */
std::shared_ptr<const pcl_uvol::detail::SampleCells>
loadCells(const Arguments& arguments,
          const pcl_uvol::LoadOptions& load,
          const Dataset& samples,
          bool is_periodic,
          Report& report)
{
  if (!arguments.queries.usesCells() || is_periodic ||
      !arguments.reading.getWhere().empty())
    return nullptr;
  const StepTimer timer(report, "cells");
  auto cells = pcl_uvol::findCells(arguments.input, load, samples, report);
  if (cells)
    report.count("cells", cells->size());
  return cells;
}

int
run(int argc, char** argv, uvol_tools::SeriesStep* step)
{
  Arguments arguments;
  Options options(
      "uvol_probe",
      "in.csv out.csv -points file|-line ...|-plane ...|-grid n [options]",
      "Interpolate a field between scattered points, with its standard error. The "
      "field support is\n"
      "1 samples all around, 2 gap, 3 border, 5 underdetermined, 6 no finite "
      "position,\n"
      "7 outside the data (nan). Output: pcd ply vtp csv, and planes and grids also "
      "as vti vts nrrd mha.");
  declare(options, arguments);
  uvol_tools::declareSeries(options);
  if (!options.parse(argc, argv))
    return 0;
  check(options, arguments);
  const Kind kind = arguments.queries.getKind();
  const pcl_uvol::LoadOptions load = arguments.reading.makeLoadOptions();
  const pcl_uvol::LoadOptions of_samples = findSampleOptions(arguments, load);
  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  auto total = std::make_unique<StepTimer>(report, "total");
  std::size_t points = 0;
  Dataset samples = uvol_tools::loadPoints(arguments.input,
                                           report,
                                           of_samples,
                                           arguments.reading.getWhere(),
                                           options.threads(),
                                           &points);
  report.count("points", points);
  const pcl_uvol::SamplesInBox boxed(samples,
                                     arguments.periodic.findSides(samples),
                                     Eigen::Array3f::Ones(),
                                     options.threads(),
                                     report);
  Facts of_scale;
  InterpolationParameters parameters =
      arguments.model.resolve(options, samples, report, of_scale);
  std::optional<Slice> lattice;
  if (kind != Kind::None && kind != Kind::Points)
    lattice = arguments.queries.makeLattice(findBounds(samples, boxed.getSides()));
  const auto cells =
      loadCells(arguments, of_samples, samples, boxed.isPeriodic(), report);
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(samples.cloud);
  pcl::Indices indices(view.count);
  std::iota(indices.begin(), indices.end(), 0);
  pcl::Indices own = indices; // images of samples left out would tell what they are
  if (boxed.isPeriodic())
    own.resize(boxed.countOwn());

  Facts facts = {{"input", arguments.input}};
  if (!arguments.output.empty())
    facts.emplace_back("output", arguments.output);
  uvol_tools::append(facts, of_scale);
  facts.push_back(uvol_tools::describeSampling(
      pcl_uvol::summarizeSampling(view,
                                  indices,
                                  parameters.fields.front(),
                                  parameters.scale,
                                  parameters.rotation,
                                  options.threads())));
  if (parameters.model == InterpolationModel::Auto) {
    const StepTimer timer(report, "choice");
    const auto choice = arguments.model.chooseModel(
        samples, own, parameters, options.threads(), report);
    parameters.model = choice.scores.front().model;
    facts.emplace_back("model", toWord(parameters.model));
    for (const Fact& fact : uvol_tools::describe(choice))
      facts.push_back(fact);
  }
  else
    facts.emplace_back("model", toWord(parameters.model));
  if (arguments.model.hasValidation())
    for (const Fact& fact :
         arguments.model.validate(samples, own, parameters, options.threads(), report))
      facts.push_back(fact);
  if (kind != Kind::None || arguments.variogram.isAskedFor()) {
    FieldInterpolator interpolator(
        view,
        indices,
        parameters,
        options.threads(),
        report,
        kind == Kind::None ? pcl_uvol::detail::ExpectedQueries()
                           : expectQueries(arguments, lattice ? &*lattice : nullptr));
    interpolator.setCells(cells);
    const bool is_stretched = (parameters.scale != 1.0f).any();
    for (const Fact& fact : arguments.variogram.write(interpolator, is_stretched))
      facts.push_back(fact);
    if (kind != Kind::None) {
      AnswerSummary summary(view, own, interpolator.getNames());
      const uvol_tools::Probe probe{options,
                                    arguments.queries,
                                    lattice,
                                    arguments.picture,
                                    step ? &step->pictures : nullptr,
                                    arguments.input,
                                    arguments.output,
                                    load,
                                    arguments.ascii,
                                    samples,
                                    boxed.getSides(),
                                    parameters,
                                    interpolator};
      const Facts found = uvol_tools::runProbe(probe, summary, report);
      uvol_tools::append(facts, found);
      addRanges(summary, facts);
      summary.warn(report);
    }
  }
  if (boxed.isPeriodic())
    facts.push_back(uvol_tools::describeBox(
        pcl_uvol::toSampleBox(boxed.getBox(), boxed.getOrigin())));
  total.reset();
  facts.push_back(uvol_tools::describeMemory());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_probe", argc, argv, run);
}
