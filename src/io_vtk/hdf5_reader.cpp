// SPDX-License-Identifier: BSD-3-Clause
// Points in files of HDF5: snapshots of Gadget's family and of Phantom, and groups of
// tables of the same length.
#include "common/printable.h"
#include "io/formats.h"
#include "io/hdf5_names.h"
#include "io/position_tables.h"
#include "io/snapshot.h"
#include "io_vtk/hdf5_group.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <sstream>
#include <system_error>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::size_t most_groups = 1000;

double
firstOf(const std::vector<double>& numbers, double otherwise)
{
  return numbers.empty() ? otherwise : numbers[0];
}

/** Counts of an attribute; those that are none are 0. */
std::vector<std::uint64_t>
countsIn(const std::vector<double>& numbers)
{
  std::vector<std::uint64_t> counts;
  for (const double number : numbers)
    counts.push_back(number >= 0.0 && number < 1e15 ? static_cast<std::uint64_t>(number)
                                                    : 0);
  return counts;
}

bool
isGadgetFamily(const Hdf5File& file)
{
  return !file.readAttribute("/Header", "NumPart_ThisFile").empty();
}

/** The particles of one kind in one file. */
std::unique_ptr<RecordSource>
openKind(const std::string& path, std::size_t kind, std::vector<Message> notes)
{
  const Hdf5File file(path);
  const std::string group = "/PartType" + std::to_string(kind);
  const auto here = countsIn(file.readAttribute("/Header", "NumPart_ThisFile"));
  if (kind >= here.size() || here[kind] == 0)
    return std::make_unique<ColumnSource>(
        0, std::vector<NamedColumn>(), std::move(notes));
  Hdf5Group reader(file, group);
  if (!reader.findCoordinates())
    throwUnreadable(
        path, {"missing_part", "the table of coordinates of " + quoteText(group)});
  if (reader.getRows() != here[kind])
    throwUnreadable(
        path,
        {"wrong_count", quoteText(group), reader.getRows(), "particles", here[kind]});
  reader.takeFields(group);
  const auto masses = file.readAttribute("/Header", "MassTable");
  auto& columns = reader.getColumns();
  const bool has_masses =
      std::any_of(columns.begin(), columns.end(), [](const NamedColumn& c) {
        return c.names[0] == "Masses";
      });
  if (kind < masses.size() && masses[kind] > 0.0 && !has_masses)
    columns.push_back({{"Masses"}, Type::FLOAT64, 1, makeConstant(masses[kind])});
  return reader.open(std::move(notes));
}

/** What is told of the cosmology: GADGET-4 has most of it among its parameters. */
CosmologyHeader
readCosmology(const Hdf5File& file)
{
  const auto find = [&](std::initializer_list<const char*> names) {
    for (const char* const group : {"/Header", "/Parameters"})
      for (const char* const name : names)
        if (const auto numbers = file.readAttribute(group, name); !numbers.empty())
          return std::optional<double>(numbers[0]);
    return std::optional<double>();
  };
  const double redshift = find({"Redshift"}).value_or(0.0);
  const bool is_cosmological =
      redshift > 0.0 || find({"Omega0", "Omega_m"}).value_or(0.0) > 0.0;
  return {redshift, is_cosmological ? find({"HubbleParam"}) : std::nullopt};
}

std::unique_ptr<RecordSource>
openGadgetFamily(const Hdf5File& file, const LoadOptions& options)
{
  const std::string& path = file.getPath();
  const auto number = [&](const char* name, double otherwise) {
    return firstOf(file.readAttribute("/Header", name), otherwise);
  };
  const double files = number("NumFilesPerSnapshot", 1.0);
  const auto parts = listSnapshotFiles(
      path, files >= 1.0 && files < 1e9 ? static_cast<std::size_t>(files) : 1);
  auto total = countsIn(file.readAttribute("/Header", "NumPart_Total"));
  if (parts.size() == 1 || total.empty())
    total = countsIn(file.readAttribute("/Header", "NumPart_ThisFile"));
  std::vector<Message> notes;
  const std::size_t kind =
      chooseKind(path, listGadgetKinds(total), options.particles, notes);
  noteHeader(readCosmology(file), notes);
  std::unique_ptr<RecordSource> source;
  if (parts.size() == 1)
    source = openKind(path, kind, std::move(notes));
  else
    source = std::make_unique<PartsSource>(
        parts.size(),
        [parts, kind, notes](std::size_t i) { return openKind(parts[i], kind, notes); },
        [&](std::size_t i) { return parts[i]; });
  source->setBox(toBox(file.readAttribute("/Header", "BoxSize")));
  source->setTime(number("Time", std::numeric_limits<double>::quiet_NaN()));
  return source;
}

/** The groups of a file, the outer ones first. */
std::vector<std::string>
listGroups(const Hdf5File& file)
{
  std::vector<std::string> groups{"/"};
  for (std::size_t i = 0; i < groups.size() && groups.size() < most_groups; ++i)
    for (const std::string& name : file.list(groups[i])) {
      const std::string inner = joinNames(groups[i], name);
      if (std::count(inner.begin(), inner.end(), '/') < 8 && file.hasGroup(inner))
        groups.push_back(inner);
    }
  return groups;
}

std::unique_ptr<RecordSource>
openGroup(Hdf5Group& reader, const std::string& group, std::vector<Message> notes)
{
  reader.takeFields(group);
  reader.takeFields(joinNames(group, "PointData")); // VTKHDF without its type
  return reader.open(std::move(notes));
}

/** The first group with coordinates under usual names. */
std::unique_ptr<RecordSource>
openAnyGroup(const Hdf5File& file)
{
  std::vector<std::string> found;
  for (const std::string& group : listGroups(file))
    if (Hdf5Group(file, group).findCoordinates())
      found.push_back(group);
  if (found.empty())
    throwUnreadable(file.getPath(), {"no_usual_coordinates", false});
  std::vector<Message> notes;
  if (found.size() > 1)
    notes.push_back({"several_groups",
                     {{"group", shortenText(found[0])},
                      {"others", found.size() - 1},
                      {"other", printable(found[1])}}});
  Hdf5Group reader(file, found[0]);
  reader.findCoordinates();
  return openGroup(reader, found[0], std::move(notes));
}

/** "/group", "/group/positions" or "/group/x,y,z". */
std::unique_ptr<RecordSource>
openInside(const Hdf5File& file, const std::string& inside)
{
  if (file.hasGroup(inside)) {
    Hdf5Group reader(file, inside);
    if (!reader.findCoordinates())
      throwUnreadable(file.getPath(),
                      {"no_usual_coordinates", true, shortenText(inside)});
    return openGroup(reader, inside, {});
  }
  const std::size_t slash = inside.rfind('/');
  const std::string group = slash == 0 ? "/" : inside.substr(0, slash);
  std::vector<std::string> names;
  std::istringstream words(inside.substr(slash + 1));
  for (std::string word; std::getline(words, word, ',');)
    names.push_back(word);
  if (names.size() != 1 && names.size() != 3)
    throwUnreadable(file.getPath(), {"not_coordinate_tables", shortenText(inside)});
  Hdf5Group reader(file, group);
  reader.takeCoordinates(names);
  return openGroup(reader, group, {});
}

} // namespace

std::unique_ptr<RecordSource>
openHdf5(const std::string& path, const LoadOptions& options)
{
  const Hdf5Name name = splitHdf5Name(path);
  const Hdf5File file(name.file);
  const bool is_gadget = isGadgetFamily(file);
  if (name.inside.empty() && is_gadget)
    return openGadgetFamily(file, options);
  if (name.inside.empty())
    if (auto phantom = openPhantom(file, options.particles))
      return phantom;
  if (!options.particles.empty())
    throwUnreadable(path, "unknown_snapshot");
  if (auto data = openVtkHdf(file, name.inside.empty() ? vtkhdf_group : name.inside))
    return data;
  return name.inside.empty() ? openAnyGroup(file) : openInside(file, name.inside);
}

} // namespace io
} // namespace pcl_uvol
