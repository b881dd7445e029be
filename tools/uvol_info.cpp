// SPDX-License-Identifier: BSD-3-Clause
// What files of samples and volumes hold, before work is done with them.
#include "common/number_range.h"
#include "common/numbers.h"
#include "common/printable.h"
#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "pipeline/dataset_info.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/sampling_fact.h"
#include "shared/scale_option.h"
#include "shared/series.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <set>

namespace {

using pcl_uvol::Report;
using pcl_uvol::ValueStatistics;
using uvol_tools::Fact;
using uvol_tools::Facts;
using uvol_tools::Options;
using uvol_tools::toNumbers;

struct Arguments {
  uvol_tools::ScaleOption scale;
  std::vector<std::string> inputs;
  std::string field, output;
  uvol_tools::InputOptions reading;
};

template <typename Numbers>
std::string
joined(const Numbers& numbers, const char* separator)
{
  uvol_tools::FactText text;
  text.precision(10);
  bool first = true;
  for (const auto& number : numbers) {
    text << (first ? "" : separator) << number;
    first = false;
  }
  return text.str();
}

std::string
findRange(const ValueStatistics& statistics)
{
  if (statistics.finite == 0)
    return "no finite value";
  const std::vector<std::string> numbers =
      pcl_uvol::describeNumbers({statistics.min, statistics.max, statistics.mean});
  uvol_tools::FactText text;
  text << numbers[0] << " to " << numbers[1] << ", mean " << numbers[2];
  if (statistics.missing > 0)
    text << ", " << statistics.missing << " missing";
  return text.str();
}

/** The range of values as a fact of that name. */
Fact
describeRange(const std::string& name, const ValueStatistics& statistics)
{
  const bool is_known = statistics.finite > 0;
  const auto number = [&](double value) {
    return is_known ? Fact::Numbers{value}
                    : Fact::Numbers{std::numeric_limits<double>::quiet_NaN()};
  };
  return {name,
          findRange(statistics),
          Fact::Members{{"min", number(statistics.min)},
                        {"max", number(statistics.max)},
                        {"mean", number(statistics.mean)},
                        {"missing", {static_cast<double>(statistics.missing)}}}};
}

/** A bar per bin, as long as its share of the fullest one. */
void
addHistogram(const ValueStatistics& statistics, Facts& facts)
{
  constexpr double longest = 40.0;
  const auto fullest =
      *std::max_element(statistics.histogram.begin(), statistics.histogram.end());
  const double width = (statistics.max - statistics.min) /
                       static_cast<double>(statistics.histogram.size());
  std::vector<double> starts;
  for (std::size_t bin = 0; bin < statistics.histogram.size(); ++bin)
    starts.push_back(statistics.min + width * static_cast<double>(bin));
  const std::vector<std::string> from = pcl_uvol::describeNumbers(starts);
  for (std::size_t bin = 0; bin < statistics.histogram.size() && fullest > 0; ++bin) {
    const std::uint64_t count = statistics.histogram[bin];
    const auto length = static_cast<std::size_t>(longest * static_cast<double>(count) /
                                                 static_cast<double>(fullest));
    facts.push_back(
        Fact("  from " + from[bin],
             std::string(length, '#') + (length > 0 ? " " : "") + std::to_string(count))
            .withoutJson());
    if (width == 0.0)
      break;
  }
  facts.emplace_back("histogram", "", toNumbers(statistics.histogram));
  if (statistics.isovalues.empty())
    return;
  facts.push_back(Fact("suggested isovalues (quantiles 0.25, 0.5, 0.75, 0.95 of the "
                       "values between the extremes)",
                       joined(statistics.isovalues, ","))
                      .withoutJson());
  facts.emplace_back("isovalues", "", statistics.isovalues);
}

Facts
describeVolume(const std::string& path, Report& report)
{
  const pcl_uvol::Volume volume = pcl_uvol::loadVolume(path);
  Facts facts{{"file", path},
              {"size", joined(volume.dims, " x "), toNumbers(volume.dims)},
              {"spacing", joined(volume.spacing, " "), toNumbers(volume.spacing)},
              {"origin", joined(volume.origin, " "), toNumbers(volume.origin)}};
  const auto statistics = pcl_uvol::describeValues(
      std::vector<double>(volume.values.begin(), volume.values.end()));
  const Fact range = describeRange(volume.name, statistics);
  facts.push_back(range.withoutJson());
  facts.emplace_back("ranges", Facts{range});
  addHistogram(statistics, facts);
  report.count("points", volume.values.size());
  return facts;
}

/** The field to look at closely: the one named, else the default where there is one. */
std::string
chosenField(const Arguments& arguments, const pcl_uvol::Dataset& dataset)
{
  if (!arguments.field.empty())
    return arguments.field;
  try {
    return pcl_uvol::chooseField(dataset, "");
  }
  catch (const pcl_uvol::InvalidArgument&) {
    return {}; // none, or several: the list of ranges tells
  }
}

/** More than these numbers per point nobody reads one by one. */
constexpr std::size_t most_listed = 200;

std::string
listFields(const std::vector<pcl::PCLPointField>& fields)
{
  std::string list;
  for (std::size_t i = 0; i < std::min(fields.size(), most_listed); ++i)
    list += (i > 0 ? ", " : "") + pcl_uvol::describeFields({fields[i]});
  return fields.size() > most_listed
             ? list + " and " + std::to_string(fields.size() - most_listed) + " more"
             : list;
}

/** What each number of a point ranges over. */
void
addRanges(const pcl_uvol::Dataset& dataset, Facts& facts)
{
  std::size_t numbers = 0;
  Facts ranges;
  for (const auto& field : pcl_uvol::listNumberFields(dataset))
    if (field.name != "x" && field.name != "y" && field.name != "z")
      for (std::size_t k = 0; k < field.count; ++k) {
        if (++numbers > most_listed)
          continue;
        const std::string name =
            field.count > 1 ? field.name + "[" + std::to_string(k) + "]" : field.name;
        ranges.push_back(describeRange(
            name,
            pcl_uvol::describeValues(pcl_uvol::readFieldValues(
                dataset, pcl_uvol::ScalarField(dataset.cloud.fields, name)))));
        facts.push_back(ranges.back().withoutJson());
      }
  facts.emplace_back("ranges", ranges);
  if (numbers > most_listed)
    facts.emplace_back("further numbers per point",
                       static_cast<double>(numbers - most_listed));
}

/** The names in a column of them, ascending. */
std::vector<std::string>
listNames(const pcl_uvol::Dataset& dataset,
          const std::string& field,
          const std::vector<std::string>& names)
{
  std::set<std::string> found;
  for (const double label : pcl_uvol::readFieldValues(
           dataset, pcl_uvol::ScalarField(dataset.cloud.fields, field)))
    found.insert(pcl_uvol::nameOfLabel(names, label));
  found.erase("");
  return {found.begin(), found.end()};
}

void
addNames(const pcl_uvol::Dataset& dataset, Facts& facts)
{
  constexpr std::size_t most_shown = 5;
  Facts counts;
  for (const auto& [field, all] : dataset.labels) {
    const std::vector<std::string> names = listNames(dataset, field, all);
    const bool is_cut = names.size() > most_shown;
    std::string text = pcl_uvol::describeCount(names.size(), "name", "names");
    for (std::size_t i = 0; i < (is_cut ? most_shown - 1 : names.size()); ++i)
      text += (i > 0 ? ", " : ": ") + pcl_uvol::shortenText(names[i]);
    if (is_cut)
      text += " ... " + pcl_uvol::shortenText(names.back());
    facts.push_back(Fact(field, text).withoutJson());
    counts.emplace_back(field, static_cast<double>(names.size()));
  }
  if (!counts.empty())
    facts.emplace_back("names", counts);
}

/** Bounds and spacing. */
void
addPositions(const std::string& path,
             const pcl_uvol::Dataset& dataset,
             const pcl_uvol::detail::Stretch& stretch,
             unsigned threads,
             Facts& facts,
             Report& report)
{
  const auto positions =
      pcl_uvol::describePositions(dataset, stretch, threads, report.progress);
  report.warn(positions.warnings);
  if (positions.non_finite == dataset.cloud.width)
    report.warn("no_finite_points", {{"path", path}});
  else {
    facts.emplace_back(
        "lower corner", joined(positions.lower, " "), toNumbers(positions.lower));
    facts.emplace_back(
        "upper corner", joined(positions.upper, " "), toNumbers(positions.upper));
    const std::vector<double> spacing{
        positions.spacing_min, positions.spacing_median, positions.spacing_max};
    if (positions.non_finite + positions.duplicates + 1 < dataset.cloud.width)
      facts.push_back(Fact("distance to the nearest sample (min, median, max)",
                           joined(spacing, ", "))
                          .withoutJson());
    facts.emplace_back("spacing",
                       "",
                       Fact::Members{{"min", {spacing[0]}},
                                     {"median", {spacing[1]}},
                                     {"max", {spacing[2]}}});
    facts.push_back(uvol_tools::describeSampling(positions.sampling));
  }
  report.count("non_finite", positions.non_finite);
  report.count("duplicates", positions.duplicates);
}

/** Write the points with what the sampling is like around each. */
void
saveSampling(const std::string& input,
             const std::string& output,
             const pcl_uvol::detail::Stretch& stretch,
             unsigned threads,
             pcl_uvol::Dataset& dataset,
             Report& report)
{
  if (!dataset.has_coordinates)
    throw pcl_uvol::InvalidArgument("no_coordinates_to_sample", {{"path", input}});
  {
    const pcl_uvol::StepTimer timer(report, "sampling");
    pcl_uvol::addSamplingFields(dataset, stretch, threads, report.progress);
  }
  uvol_tools::savePoints(output, dataset, {}, report);
}

Facts
describeCloud(const Options& options,
              const Arguments& arguments,
              const std::string& input,
              Report& report)
{
  const unsigned threads = options.threads();
  pcl_uvol::LoadOptions load = arguments.reading.makeLoadOptions();
  load.needs_coordinates = false;
  load = uvol_tools::onMapOfCommand(load);
  pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(input, load);
  report.warnings = dataset.notes;
  uvol_tools::keepMap(input, dataset, load, report);
  if (!arguments.reading.getWhere().empty())
    report.count("removed_by_where",
                 pcl_uvol::selectRows(
                     dataset, arguments.reading.getWhere(), {threads, ""}, report));
  auto fields = dataset.cloud.fields;
  if (!dataset.has_coordinates) // x, y and z stand in front of those of the file
    fields.erase(fields.begin(), fields.begin() + 3);
  Facts facts{{"file", input}, {"fields", listFields(fields)}};
  report.count("points", dataset.cloud.width);
  std::string chosen = chosenField(arguments, dataset);
  if (dataset.cloud.width == 0) {
    report.warn("no_points_in_file", {{"path", input}});
    return facts;
  }
  pcl_uvol::detail::Stretch stretch;
  if (dataset.has_coordinates) {
    Facts facts_of_scale;
    stretch = arguments.scale.resolve(
        pcl_uvol::viewOf(dataset.cloud), "", threads, report, facts_of_scale);
    uvol_tools::append(facts, facts_of_scale);
    addPositions(input, dataset, stretch, threads, facts, report);
  }
  else
    report.warn("no_coordinate_columns", {{"path", input}});
  addRanges(dataset, facts);
  addNames(dataset, facts);
  uvol_tools::addField(dataset, chosen, options, report);
  if (!chosen.empty()) {
    const auto statistics = pcl_uvol::describeValues(pcl_uvol::readFieldValues(
        dataset, pcl_uvol::ScalarField(dataset.cloud.fields, chosen)));
    facts.emplace_back("field", chosen);
    facts.push_back(describeRange("histogram of " + chosen, statistics).withoutJson());
    addHistogram(statistics, facts);
  }
  if (!arguments.output.empty())
    saveSampling(input, arguments.output, stretch, threads, dataset, report);
  return facts;
}

void
checkOutput(const Arguments& arguments)
{
  if (arguments.output.empty())
    return;
  if (arguments.inputs.size() > 1)
    throw uvol_tools::UsageError("-out is for one file, and there are " +
                                 std::to_string(arguments.inputs.size()) + ".");
  if (pcl_uvol::isVolumeFile(arguments.inputs[0]))
    throw uvol_tools::UsageError("-out is for samples, and " + arguments.inputs[0] +
                                 " is a volume.");
  pcl_uvol::checkSavePath(arguments.output);
}

/** Tell of each file, of those behind one that fails as well.
 * \return the exit code of the first one that fails */
int
describeAll(const Options& options, const Arguments& arguments)
{
  int exit_code = 0;
  const char* before = "";
  for (const std::string& input : arguments.inputs) {
    uvol_tools::nameFile(input);
    const int outcome = uvol_tools::runTool("uvol_info", [&] {
      Report report;
      const Facts facts = pcl_uvol::isVolumeFile(input)
                              ? describeVolume(input, report)
                              : describeCloud(options, arguments, input, report);
      std::cout << before;
      uvol_tools::printReport(options, report, facts);
      before = options.json() ? "" : "\n";
      return 0;
    });
    exit_code = exit_code == 0 ? outcome : exit_code;
  }
  return exit_code;
}

int
run(int argc, char** argv, uvol_tools::SeriesStep* /*step*/)
{
  Arguments arguments;
  Options options(
      "uvol_info",
      "in.pcd [more.pcd...] [options]",
      "Summarise files of samples (pcd ply csv txt vtk vtp vtu vts h5, Gadget) or "
      "volumes (nrrd nhdr vti mha mhd).");
  options.files("in", arguments.inputs);
  options.group("Input");
  options.text(
      "field",
      "name",
      arguments.field,
      "scalar field to draw a histogram of, or an expression: log10(rho), Q(vel)");
  arguments.scale.declare(options, "spacings", uvol_tools::AutomaticScale::Spacing);
  arguments.reading.declare(options);
  uvol_tools::declareSeries(options);
  options.group("Output");
  options.output("out",
                 "out.csv",
                 arguments.output,
                 "write the samples with the fields local_dimension (isolated, line, "
                 "sheet, volume), spacing_along and spacing_across");
  if (!options.parse(argc, argv))
    return 0;
  arguments.scale.finish(options);
  checkOutput(arguments);
  return describeAll(options, arguments);
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_info", argc, argv, run);
}
