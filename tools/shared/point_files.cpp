// SPDX-License-Identifier: BSD-3-Clause
#include "shared/point_files.h"

#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/held_fields.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace uvol_tools {

namespace {

/** Names or numbers of -xyz; "": none. */
std::array<std::string, 3>
parseColumns(const std::string& columns)
{
  std::array<std::string, 3> parsed;
  if (columns.empty())
    return parsed;
  std::istringstream words(columns);
  std::size_t count = 0;
  for (std::string word; std::getline(words, word, ',');)
    if (++count <= parsed.size())
      parsed[count - 1] = word;
  if (count != parsed.size() || columns.back() == ',' ||
      std::find(parsed.begin(), parsed.end(), "") != parsed.end())
    throw UsageError(
        "-xyz takes three columns, as in -xyz lon,lat,depth or -xyz 0,1,2, "
        "not " +
        pcl_uvol::quoteText(columns) + ".");
  return parsed;
}

} // namespace

void
InputOptions::declare(Options& options)
{
  options_ = &options;
  options.text("where",
               "expr",
               where_,
               "use only the points for which it holds: \"experiment=1 && T>4\"");
  options.text("xyz",
               "x,y,z",
               xyz_,
               "columns of a text file that hold the coordinates, by names or numbers "
               "from 0 (default: by usual names)");
  options
      .text("particles",
            "kind",
            particles_,
            "of a snapshot: gas, dm, disk, bulge, stars, bh, or a number (default: "
            "gas, else the first kind there is)")
      .rare();
  options
      .flag("cells",
            cells_,
            "of a file of VTK, Exodus, EnSight or OpenFOAM: take the centres of cells "
            "with their data instead of points")
      .rare();
}

pcl_uvol::LoadOptions
InputOptions::makeLoadOptions() const
{
  pcl_uvol::LoadOptions options;
  options.may_mix_units = options_->given("scale");
  options.xyz_columns = parseColumns(xyz_);
  options.particles = particles_;
  options.cells = cells_;
  return options;
}

pcl_uvol::Dataset
loadPoints(const std::string& path,
           pcl_uvol::Report& report,
           const pcl_uvol::LoadOptions& options,
           const std::string& where,
           unsigned threads)
{
  const pcl_uvol::StepTimer timer(report, "read");
  pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(path, options);
  report.warnings.insert(
      report.warnings.end(), dataset.notes.begin(), dataset.notes.end());
  if (!where.empty())
    report.count("removed_by_where",
                 pcl_uvol::selectRows(dataset, where, {threads, ""}, report));
  if (dataset.cloud.width == 0)
    throw pcl_uvol::InvalidArgument(
        path + " has no points" + (where.empty() ? "." : " for which " + where + "."));
  return dataset;
}

std::vector<std::string>
parseFieldNames(const std::string& option,
                const std::string& value,
                const pcl_uvol::Dataset& points)
{
  const std::vector<std::string> parts = parseNames(option, value);
  std::vector<std::string> names;
  for (std::size_t first = 0; first < parts.size();) {
    std::string joined = parts[first], name = joined;
    std::size_t next = first + 1;
    for (std::size_t i = next; i < parts.size(); ++i) {
      joined += ',' + parts[i];
      if (!pcl_uvol::findField(points.cloud.fields, joined))
        continue;
      name = joined;
      next = i + 1;
    }
    names.push_back(name);
    first = next;
  }
  return names;
}

namespace {

void
resolveField(pcl_uvol::Dataset& points,
             std::string& name,
             const pcl_uvol::DerivedFieldOptions& options,
             pcl_uvol::Report& report)
{
  if (!name.empty())
    name = pcl_uvol::addDerivedField(points, name, options, report);
}

} // namespace

void
addField(pcl_uvol::Dataset& samples,
         std::string& name,
         const Options& options,
         pcl_uvol::Report& report,
         const std::array<double, 3>& periodic)
{
  resolveField(samples, name, {options.threads(), "", periodic}, report);
}

void
addField(pcl_uvol::Dataset& points,
         std::string& name,
         const std::string& because,
         const Options& options,
         pcl_uvol::Report& report)
{
  resolveField(points, name, {options.threads(), because, {}}, report);
}

void
warnOfLosses(const std::string& path,
             const pcl_uvol::Dataset& dataset,
             pcl_uvol::Report& report)
{
  const auto losses = pcl_uvol::describeLosses(path, dataset);
  report.warnings.insert(report.warnings.end(), losses.begin(), losses.end());
}

void
savePoints(const std::string& path,
           const pcl_uvol::Dataset& dataset,
           const pcl_uvol::SaveOptions& options,
           pcl_uvol::Report& report)
{
  const pcl_uvol::StepTimer timer(report, "write");
  pcl_uvol::saveDataset(path, dataset, options);
  warnOfLosses(path, dataset, report);
}

} // namespace uvol_tools
