// SPDX-License-Identifier: BSD-3-Clause
// Points in files of HDF5: snapshots of Gadget's family and of Phantom, and groups of
// tables of the same length.
#include "common/numbers.h"
#include "common/printable.h"
#include "io/formats.h"
#include "io/hdf5_file.h"
#include "io/position_tables.h"
#include "io/snapshot.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::size_t most_groups = 1000;
constexpr std::size_t mask_rows = std::size_t(1) << 14;

std::string
join(const std::string& group, const std::string& name)
{
  return (group == "/" ? "" : group) + '/' + name;
}

/** The columns of the tables in a group. */
class GroupReader {
public:
  GroupReader(const Hdf5File& file, const std::string& group)
      : file_(file)
      , group_(group)
  {
  }

  /** Tables x, y, z by their names, or one of them.
   * \throws IOError unless they are coordinates */
  void
  takeCoordinates(const std::vector<std::string>& names);

  /** \return false if the group has no table with a usual name */
  bool
  findCoordinates();

  /** All other tables of as many rows. */
  void
  takeFields(const std::string& group);

  std::unique_ptr<ColumnSource>
  open(std::vector<std::string> notes)
  {
    notes.insert(notes.end(), notes_.begin(), notes_.end());
    return std::make_unique<ColumnSource>(rows_, std::move(columns_), std::move(notes));
  }

  std::uint64_t
  getRows() const
  {
    return rows_;
  }

  std::vector<NamedColumn>&
  getColumns()
  {
    return columns_;
  }

private:
  void
  add(const std::vector<std::string>& names,
      const std::string& dataset,
      const Hdf5Shape& shape);

  const Hdf5File& file_;
  std::string group_;
  std::uint64_t rows_ = 0;
  std::vector<std::string> taken_;
  std::vector<NamedColumn> columns_;
  std::vector<std::string> notes_;
};

void
GroupReader::add(const std::vector<std::string>& names,
                 const std::string& dataset,
                 const Hdf5Shape& shape)
{
  columns_.push_back({names,
                      shape.datatype,
                      static_cast<std::size_t>(shape.components),
                      file_.openColumn(dataset)});
}

void
GroupReader::takeCoordinates(const std::vector<std::string>& names)
{
  const std::size_t components = names.size() == 1 ? 3 : 1;
  constexpr const char* axes[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string dataset = join(group_, names[i]);
    const auto shape = file_.findShape(dataset);
    if (!shape || shape->components != components)
      throwUnreadable(file_.getPath(),
                      quoteText(dataset) + " is no table of " +
                          (components == 3 ? "three coordinates per point"
                                           : "one coordinate per point"));
    if (i > 0 && shape->rows != rows_)
      throwUnreadable(file_.getPath(),
                      quoteText(dataset) + " has " + std::to_string(shape->rows) +
                          " rows, but " + quoteText(taken_.back()) + " has " +
                          std::to_string(rows_));
    rows_ = shape->rows;
    taken_.push_back(dataset);
    add(components == 3 ? std::vector<std::string>(std::begin(axes), std::end(axes))
                        : std::vector<std::string>{axes[i]},
        dataset,
        *shape);
  }
}

bool
GroupReader::findCoordinates()
{
  std::vector<NumberTable> tables;
  for (const std::string& name : file_.list(group_))
    if (const auto shape = file_.findShape(join(group_, name)))
      tables.push_back({name, shape->rows, shape->components});
  std::vector<std::string> names;
  for (const std::size_t table : findPositionTables(tables))
    names.push_back(tables[table].name);
  takeCoordinates(names);
  return !names.empty();
}

void
GroupReader::takeFields(const std::string& group)
{
  for (const std::string& name : file_.list(group)) {
    const std::string dataset = join(group, name);
    const auto shape = file_.findShape(dataset);
    if (std::find(taken_.begin(), taken_.end(), dataset) != taken_.end() || !shape ||
        shape->rows != rows_)
      continue; // a group, a table of something else
    if (shape->components > most_table_components)
      notes_.push_back("The table " + quoteText(dataset) + " has " +
                       std::to_string(shape->components) +
                       " numbers per point and is left out.");
    else
      add({name}, dataset, *shape);
  }
}

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
openKind(const std::string& path, std::size_t kind, std::vector<std::string> notes)
{
  const Hdf5File file(path);
  const std::string group = "/PartType" + std::to_string(kind);
  const auto here = countsIn(file.readAttribute("/Header", "NumPart_ThisFile"));
  if (kind >= here.size() || here[kind] == 0)
    return std::make_unique<ColumnSource>(
        0, std::vector<NamedColumn>(), std::move(notes));
  GroupReader reader(file, group);
  if (!reader.findCoordinates())
    throwUnreadable(path,
                    "it is truncated or damaged: " + quoteText(group) +
                        " has no coordinates");
  if (reader.getRows() != here[kind])
    throwUnreadable(path,
                    "it is damaged: its header promises " + std::to_string(here[kind]) +
                        " particles of kind " + std::to_string(kind) + ", but " +
                        quoteText(group) + " has " + std::to_string(reader.getRows()));
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
  std::vector<std::string> notes;
  const std::size_t kind =
      chooseKind(path, listGadgetKinds(total), options.particles, notes);
  const double omega = number("Omega0", number("Omega_m", 0.0));
  noteHeader({number("Redshift", 0.0),
              omega > 0.0 ? number("HubbleParam", 1.0) : 1.0,
              number("BoxSize", 0.0)},
             notes);
  if (parts.size() == 1)
    return openKind(path, kind, std::move(notes));
  return std::make_unique<PartsSource>(
      parts.size(),
      [parts, kind, notes](std::size_t i) { return openKind(parts[i], kind, notes); },
      [&](std::size_t i) { return parts[i]; });
}

/** rho = m (hfact / h)^3 of Phantom's particles (Price et al. 2018, section 2.1). */
class PhantomDensity : public FileColumn {
public:
  /** \param kinds null: all particles are of the first kind */
  PhantomDensity(std::unique_ptr<FileColumn> lengths,
                 std::uint8_t length_type,
                 std::unique_ptr<FileColumn> kinds,
                 std::vector<double> masses,
                 double factor)
      : lengths_(std::move(lengths))
      , length_{0, length_type}
      , length_bytes_(datatypeSize(length_type))
      , kinds_(std::move(kinds))
      , masses_(std::move(masses))
      , factor_(factor)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    buffer_.resize(count * length_bytes_);
    lengths_->read(first, count, buffer_.data());
    kind_buffer_.assign(count, 1);
    if (kinds_)
      kinds_->read(first, count, reinterpret_cast<std::uint8_t*>(kind_buffer_.data()));
    for (std::size_t i = 0; i < count; ++i, tuples += sizeof(double)) {
      const auto kind = static_cast<std::size_t>(std::abs(int(kind_buffer_[i])));
      const double ratio = factor_ / length_.read(buffer_.data() + i * length_bytes_);
      const double density = kind >= 1 && kind <= masses_.size()
                                 ? masses_[kind - 1] * ratio * ratio * ratio
                                 : std::numeric_limits<double>::quiet_NaN();
      std::memcpy(tuples, &density, sizeof(density));
    }
  }

private:
  std::unique_ptr<FileColumn> lengths_;
  FieldComponent length_;
  std::size_t length_bytes_;
  std::unique_ptr<FileColumn> kinds_;
  std::vector<double> masses_;
  double factor_;
  std::vector<std::uint8_t> buffer_;
  std::vector<std::int8_t> kind_buffer_;
};

/** Kinds of Phantom's particles that have names here. */
const std::map<int, const char*> phantom_kinds{{1, "gas"},
                                               {2, "dust"},
                                               {3, "boundary"},
                                               {4, "stars"},
                                               {5, "dm"},
                                               {6, "bulge"},
                                               {7, "dust"}};

/** Reads a column of one number per row to the end. */
template <typename Take>
void
forEach(FileColumn& column, std::uint8_t datatype, std::uint64_t rows, const Take& take)
{
  const std::size_t bytes = datatypeSize(datatype);
  const FieldComponent number{0, datatype};
  std::vector<std::uint8_t> block(mask_rows * bytes);
  for (std::uint64_t first = 0; first < rows; first += mask_rows) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(mask_rows, rows - first));
    column.read(first, count, block.data());
    for (std::size_t i = 0; i < count; ++i)
      take(first + i, number.read(block.data() + i * bytes));
  }
}

/** Snapshots of Phantom: all particles in one group, their kinds in a table. */
class PhantomReader {
public:
  PhantomReader(const Hdf5File& file, const LoadOptions& options)
      : file_(file)
      , options_(options)
      , reader_(file, group_)
  {
  }

  static bool
  isPhantom(const Hdf5File& file)
  {
    return file.findShape("/particles/xyz") && file.findShape("/particles/h") &&
           !file.readNumbers("/header/hfact").empty();
  }

  std::unique_ptr<RecordSource>
  open();

private:
  void
  addDensity();
  bool
  hasKinds() const;
  std::vector<std::uint64_t>
  chooseRows(std::vector<std::string>& notes) const;

  const std::string group_ = "/particles";
  const Hdf5File& file_;
  const LoadOptions& options_;
  GroupReader reader_;
};

bool
PhantomReader::hasKinds() const
{
  const auto shape = file_.findShape("/particles/itype");
  return shape && shape->datatype == Type::INT8 && shape->components == 1 &&
         shape->rows == reader_.getRows();
}

void
PhantomReader::addDensity()
{
  const auto masses = file_.readNumbers("/header/massoftype");
  const auto factor = file_.readNumbers("/header/hfact");
  const auto shape = file_.findShape("/particles/h");
  if (masses.empty() || shape->components != 1 || shape->rows != reader_.getRows() ||
      file_.findShape("/particles/rho"))
    return;
  reader_.getColumns().push_back(
      {{"rho"},
       Type::FLOAT64,
       1,
       std::make_unique<PhantomDensity>(
           file_.openColumn("/particles/h"),
           shape->datatype,
           hasKinds() ? file_.openColumn("/particles/itype") : nullptr,
           masses,
           factor[0])});
}

/** Particles of the kind asked for, else all that are not dead (h <= 0). */
std::vector<std::uint64_t>
PhantomReader::chooseRows(std::vector<std::string>& notes) const
{
  const std::uint64_t rows = reader_.getRows();
  std::vector<bool> kept(rows, true);
  const auto shape = file_.findShape("/particles/h");
  std::uint64_t dead = 0;
  forEach(*file_.openColumn("/particles/h"),
          shape->datatype,
          rows,
          [&](std::uint64_t row, double length) {
            kept[row] = length > 0.0;
            dead += length > 0.0 ? 0 : 1;
          });
  if (dead > 0)
    notes.push_back(std::to_string(dead) + " dead particles (h <= 0) are left out.");
  std::map<int, std::uint64_t> counts;
  std::vector<std::int8_t> kinds(rows, 1);
  if (hasKinds())
    forEach(*file_.openColumn("/particles/itype"),
            Type::INT8,
            rows,
            [&](std::uint64_t row, double kind) {
              kinds[row] = static_cast<std::int8_t>(kind);
            });
  for (std::uint64_t row = 0; row < rows; ++row)
    counts[kinds[row]] += kept[row];
  if (!options_.particles.empty()) {
    std::vector<ParticleKind> list;
    for (const auto& [kind, count] : counts)
      if (kind >= 0)
        list.push_back({static_cast<std::size_t>(kind),
                        phantom_kinds.count(kind) ? phantom_kinds.at(kind) : "",
                        count});
    const std::size_t kind =
        chooseKind(file_.getPath(), list, options_.particles, notes);
    for (std::uint64_t row = 0; row < rows; ++row)
      kept[row] = kept[row] && kinds[row] == static_cast<int>(kind);
  }
  std::vector<std::uint64_t> chosen;
  for (std::uint64_t row = 0; row < rows; ++row)
    if (kept[row])
      chosen.push_back(row);
  return chosen;
}

std::unique_ptr<RecordSource>
PhantomReader::open()
{
  reader_.takeCoordinates({"xyz"});
  const auto lengths = file_.findShape("/particles/h");
  if (lengths->rows != reader_.getRows() || lengths->components != 1)
    throwUnreadable(file_.getPath(),
                    "it is damaged: there are " + std::to_string(reader_.getRows()) +
                        " particles, but h has " + std::to_string(lengths->rows) +
                        " rows");
  reader_.takeFields(group_);
  addDensity();
  std::vector<std::string> notes;
  std::vector<std::uint64_t> rows = chooseRows(notes);
  const std::uint64_t all = reader_.getRows();
  auto source = reader_.open(std::move(notes));
  if (rows.size() == all)
    return source;
  return std::make_unique<SelectedSource>(std::move(source), std::move(rows));
}

/** The groups of a file, the outer ones first. */
std::vector<std::string>
listGroups(const Hdf5File& file)
{
  std::vector<std::string> groups{"/"};
  for (std::size_t i = 0; i < groups.size() && groups.size() < most_groups; ++i)
    for (const std::string& name : file.list(groups[i])) {
      const std::string inner = join(groups[i], name);
      if (std::count(inner.begin(), inner.end(), '/') < 8 && file.hasGroup(inner))
        groups.push_back(inner);
    }
  return groups;
}

std::unique_ptr<RecordSource>
openGroup(GroupReader& reader, const std::string& group, std::vector<std::string> notes)
{
  reader.takeFields(group);
  reader.takeFields(join(group, "PointData")); // VTKHDF
  return reader.open(std::move(notes));
}

/** The first group with coordinates under usual names. */
std::unique_ptr<RecordSource>
openAnyGroup(const Hdf5File& file)
{
  std::vector<std::string> found;
  for (const std::string& group : listGroups(file))
    if (GroupReader(file, group).findCoordinates())
      found.push_back(group);
  if (found.empty())
    throwUnreadable(
        file.getPath(),
        "it is no snapshot, and no group of it has tables of coordinates "
        "with a usual name (x, y, z or Coordinates, positions, pos); behind "
        "the file they can be named, as in file.h5:/group/x,y,z");
  std::vector<std::string> notes;
  if (found.size() > 1)
    notes.push_back(
        "Points are read from " + quoteText(found[0]) + "; " +
        std::to_string(found.size() - 1) +
        " other groups hold points too, as in file.h5:" + printable(found[1]) + ".");
  GroupReader reader(file, found[0]);
  reader.findCoordinates();
  return openGroup(reader, found[0], std::move(notes));
}

/** "/group", "/group/positions" or "/group/x,y,z". */
std::unique_ptr<RecordSource>
openInside(const Hdf5File& file, const std::string& inside)
{
  if (file.hasGroup(inside)) {
    GroupReader reader(file, inside);
    if (!reader.findCoordinates())
      throwUnreadable(file.getPath(),
                      "the group " + quoteText(inside) +
                          " has no tables of coordinates with a usual name; name them, "
                          "as in file.h5:/group/x,y,z");
    return openGroup(reader, inside, {});
  }
  const std::size_t slash = inside.rfind('/');
  const std::string group = slash == 0 ? "/" : inside.substr(0, slash);
  std::vector<std::string> names;
  std::istringstream words(inside.substr(slash + 1));
  for (std::string word; std::getline(words, word, ',');)
    names.push_back(word);
  if (names.size() != 1 && names.size() != 3)
    throwUnreadable(file.getPath(),
                    quoteText(inside) +
                        " names neither a group, nor one table of positions, nor "
                        "three of coordinates");
  GroupReader reader(file, group);
  reader.takeCoordinates(names);
  return openGroup(reader, group, {});
}

} // namespace

Hdf5Name
splitHdf5Name(const std::string& path)
{
  const std::size_t colon = path.find(":/");
  if (colon == std::string::npos ||
      !std::filesystem::is_regular_file(path.substr(0, colon)))
    return {path, ""};
  return {path.substr(0, colon), path.substr(colon + 1)};
}

std::unique_ptr<RecordSource>
openHdf5(const std::string& path, const LoadOptions& options)
{
  const Hdf5Name name = splitHdf5Name(path);
  const Hdf5File file(name.file);
  const bool is_gadget = isGadgetFamily(file);
  if (name.inside.empty() && is_gadget)
    return openGadgetFamily(file, options);
  if (name.inside.empty() && PhantomReader::isPhantom(file))
    return PhantomReader(file, options).open();
  if (!options.particles.empty())
    throwUnreadable(
        path, "-particles chooses from snapshots, and this is none that is known");
  return name.inside.empty() ? openAnyGroup(file) : openInside(file, name.inside);
}

} // namespace io
} // namespace pcl_uvol
