// SPDX-License-Identifier: BSD-3-Clause
// What a file of samples or a volume holds, before work is done with it.
#include "common/number_range.h"
#include "common/scalar_field.h"
#include "pipeline/dataset_info.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/sampling_fact.h"
#include "shared/scale_option.h"
#include "shared/series.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/volume.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace {

using pcl_uvol::Report;
using pcl_uvol::ValueStatistics;
using uvol_tools::Fact;
using uvol_tools::Facts;
using uvol_tools::Options;
using uvol_tools::toNumbers;

struct Arguments {
  std::string input, field, where, scale;
  uvol_tools::InputOptions reading;
};

template <typename Numbers>
std::string
joined(const Numbers& numbers, const char* separator)
{
  std::ostringstream text;
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
  std::ostringstream text;
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
    return pcl_uvol::ScalarField::defaultName(dataset.cloud.fields);
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
  for (const auto& field : dataset.cloud.fields)
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

/** Bounds and spacing. */
void
addPositions(const std::string& path,
             const pcl_uvol::Dataset& dataset,
             const Eigen::Array3f& scale,
             unsigned threads,
             Facts& facts,
             Report& report)
{
  const auto positions =
      pcl_uvol::describePositions(dataset, scale, threads, report.progress);
  report.warnings.insert(
      report.warnings.end(), positions.warnings.begin(), positions.warnings.end());
  if (positions.non_finite == dataset.cloud.width)
    report.warnings.push_back(path + " has no point with finite x, y, z.");
  else {
    facts.emplace_back(
        "lower corner", joined(positions.lower, " "), toNumbers(positions.lower));
    facts.emplace_back(
        "upper corner", joined(positions.upper, " "), toNumbers(positions.upper));
    const std::vector<double> spacing{
        positions.spacing_min, positions.spacing_median, positions.spacing_max};
    facts.push_back(
        Fact("distance to the nearest sample (min, median, max)", joined(spacing, ", "))
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

Facts
describeCloud(const Options& options, const Arguments& arguments, Report& report)
{
  const unsigned threads = options.threads();
  pcl_uvol::LoadOptions load = arguments.reading.makeLoadOptions();
  load.needs_coordinates = false;
  pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(arguments.input, load);
  report.warnings = dataset.notes;
  if (!arguments.where.empty())
    report.count("removed_by_where",
                 pcl_uvol::selectRows(dataset, arguments.where, {threads, ""}, report));
  auto fields = dataset.cloud.fields;
  if (!dataset.has_coordinates) // x, y and z stand in front of those of the file
    fields.erase(fields.begin(), fields.begin() + 3);
  Facts facts{{"file", arguments.input}, {"fields", listFields(fields)}};
  report.count("points", dataset.cloud.width);
  std::string chosen = chosenField(arguments, dataset);
  if (dataset.cloud.width == 0) {
    report.warnings.push_back(arguments.input + " has no points.");
    return facts;
  }
  if (dataset.has_coordinates)
    addPositions(arguments.input,
                 dataset,
                 uvol_tools::ScaleOption(arguments.scale)
                     .resolveScale(pcl_uvol::viewOf(dataset.cloud)),
                 threads,
                 facts,
                 report);
  else
    report.warnings.push_back(arguments.input +
                              " names no columns of coordinates: -xyz chooses them.");
  addRanges(dataset, facts);
  uvol_tools::addField(dataset, chosen, options, report);
  if (!chosen.empty()) {
    const auto statistics = pcl_uvol::describeValues(pcl_uvol::readFieldValues(
        dataset, pcl_uvol::ScalarField(dataset.cloud.fields, chosen)));
    facts.emplace_back("field", chosen);
    facts.push_back(describeRange("histogram of " + chosen, statistics).withoutJson());
    addHistogram(statistics, facts);
  }
  return facts;
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options("uvol_info",
                  "in.pcd [options]",
                  "Tells what a file of samples (pcd ply csv txt vtk vtp "
                  "vtu vts h5, Gadget) or a volume (nrrd "
                  "nhdr vti mha mhd) holds.");
  options.file("in", arguments.input);
  options.group("Input");
  options.text(
      "field",
      "name",
      arguments.field,
      "scalar field to draw a histogram of, or an expression: log10(rho), Q(vel)");
  options.text(
      "where", "expr", arguments.where, "look only at the points it holds for");
  options.text("scale",
               "sx,sy,sz|auto",
               arguments.scale,
               "measure spacings in a stretched space; auto: equal spread per axis");
  arguments.reading.declare(options);
  uvol_tools::declareSeries(options);
  if (!options.parse(argc, argv))
    return 0;
  Report report;
  const Facts facts = pcl_uvol::isVolumeFile(arguments.input)
                          ? describeVolume(arguments.input, report)
                          : describeCloud(options, arguments, report);
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_info", argc, argv, run);
}
