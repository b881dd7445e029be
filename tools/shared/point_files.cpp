// SPDX-License-Identifier: BSD-3-Clause
#include "shared/point_files.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/held_fields.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <optional>
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

/** "auto", or "lon,lat" with a unit behind it or none; "": no map. */
std::optional<pcl_uvol::MapProjection>
parseMap(const std::string& text)
{
  if (text.empty())
    return std::nullopt;
  pcl_uvol::MapProjection map;
  if (text == "auto")
    return map;
  std::vector<std::string> parts;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');)
    parts.push_back(word);
  if (parts.size() == 3 && (parts[2] == "m" || parts[2] == "km")) {
    map.per_kilometre = parts[2] == "m" ? 1000.0 : 1.0;
    parts.pop_back();
  }
  if (parts.size() != 2 || text.back() == ',' ||
      !pcl_uvol::parseNumber(parts[0], map.longitude) ||
      !pcl_uvol::parseNumber(parts[1], map.latitude) ||
      !(std::abs(map.longitude) <= 360.0) || !(std::abs(map.latitude) < 90.0))
    throw UsageError(
        "-map takes auto, or longitude (-360 to 360) and latitude (between -90 and "
        "90) in degrees, then m or km, as in -71.5,41,km, not " +
        pcl_uvol::quoteText(text) + ".");
  return map;
}

/** The map of the command. */
struct CommandMap {
  std::optional<pcl_uvol::MapProjection> map;
  std::string first; ///< file that was read; "": none
};

CommandMap&
getCommandMap()
{
  static CommandMap command; // there is one command in a process
  return command;
}

} // namespace

void
InputOptions::declare(Options& options)
{
  options_ = &options;
  options.text("where",
               "expr",
               where_,
               "condition that points must meet: \"experiment=1 && T>4\"");
  options.text("xyz",
               "x,y,z",
               xyz_,
               "coordinate columns of a text file, also of -points: names or "
               "zero-based numbers (default: by usual names)");
  options
      .text("map",
            "auto|lon,lat",
            map_,
            "map longitude and latitude also of tables to kilometres or metres around "
            "this origin (auto: their median); m or km may follow")
      .rare();
  options
      .text("particles",
            "kind",
            particles_,
            "particle type of a snapshot: gas, dm, disk, bulge, stars, bh, or a number "
            "(default: gas, otherwise the first type)")
      .rare();
  options
      .flag("cells",
            cells_,
            "use cell centres with cell data instead of points (VTK, Exodus, EnSight, "
            "OpenFOAM)")
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
  options.map = parseMap(map_);
  return options;
}

pcl_uvol::LoadOptions
onMapOfCommand(pcl_uvol::LoadOptions options)
{
  if (const auto& map = getCommandMap().map)
    options.map = map;
  return options;
}

void
keepMap(const std::string& path,
        const pcl_uvol::Dataset& points,
        const pcl_uvol::LoadOptions& options,
        pcl_uvol::Report& report)
{
  CommandMap& command = getCommandMap();
  const auto map = pcl_uvol::findMap(points);
  if (map && !options.map && !command.first.empty())
    report.warn("only_one_mapped", {{"path", path}, {"other", command.first}});
  if (!map && options.map && !options.map->isComplete())
    report.warn("no_longitudes", {{"path", path}});
  else if (!map && options.map && command.map)
    report.warn("not_on_map", {{"path", path}, {"other", command.first}});
  if (!command.map)
    command.map = map;
  if (command.first.empty())
    command.first = path;
}

void
declareField(Options& options, std::string& field)
{
  field.clear();
  options.text("field",
               "name",
               field,
               "scalar field: density, vel[1], |vel|, |vx,vy,vz|, or an expression: "
               "log10(rho), rho*u, |grad(rho)|, Q(vel) (default: intensity, else the "
               "only candidate)");
}

pcl_uvol::Dataset
loadMesh(const std::string& path,
         std::vector<pcl_uvol::Triangle>& triangles,
         pcl_uvol::Report& report)
{
  const pcl_uvol::StepTimer timer(report, "read");
  const pcl_uvol::LoadOptions options = onMapOfCommand({});
  pcl_uvol::Dataset mesh = pcl_uvol::loadMesh(path, triangles, options.map);
  if (options.map) // says that the mesh was moved onto it
    report.warn(mesh.notes);
  keepMap(path, mesh, options, report);
  return mesh;
}

pcl_uvol::Dataset
loadPoints(const std::string& path,
           pcl_uvol::Report& report,
           const pcl_uvol::LoadOptions& options,
           const std::string& where,
           unsigned threads,
           std::size_t* in_file)
{
  const pcl_uvol::StepTimer timer(report, "read");
  const pcl_uvol::LoadOptions on_map = onMapOfCommand(options);
  pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(path, on_map);
  report.warn(dataset.notes);
  keepMap(path, dataset, on_map, report);
  if (in_file)
    *in_file = dataset.cloud.width;
  if (!where.empty())
    report.count("removed_by_where",
                 pcl_uvol::selectRows(dataset, where, {threads, ""}, report));
  if (dataset.cloud.width == 0)
    throw where.empty() ? pcl_uvol::InvalidArgument("no_points", {{"path", path}})
                        : pcl_uvol::InvalidArgument("no_points_where",
                                                    {{"path", path}, {"where", where}});
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
  report.warn(pcl_uvol::describeLosses(path, dataset));
}

std::string
numberedPath(const std::string& path, std::uint64_t number, std::size_t digits)
{
  const std::filesystem::path whole(path);
  std::ostringstream name;
  name << whole.stem().string() << '_' << std::setw(static_cast<int>(digits))
       << std::setfill('0') << number << whole.extension().string();
  return (whole.parent_path() / name.str()).string();
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
