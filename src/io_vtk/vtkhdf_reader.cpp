// SPDX-License-Identifier: BSD-3-Clause
// Points, images and polygons of VTKHDF, the files of VTK in HDF5 (VTK's documentation,
// "VTKHDF format specification", versions 1.0 to 2.x).
#include "common/printable.h"
#include "common/records.h"
#include "io/hdf5_names.h"
#include "io/mesh_readers.h"
#include "io/position_tables.h"
#include "io_vtk/hdf5_group.h"
#include "io_vtk/sample_topology.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pcl_uvol {
namespace io {

namespace {

using Type = pcl::PCLPointField;

/** Numbers of a table that are converted together. */
constexpr std::uint64_t numbers_at_once = 1u << 14;

/** Rows of a column from one of them on. */
class ShiftedColumn : public FileColumn {
public:
  ShiftedColumn(std::unique_ptr<FileColumn> column, std::uint64_t first)
      : column_(std::move(column))
      , first_(first)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    column_->read(first_ + first, count, tuples);
  }

  std::uint64_t
  heldBytes() const override
  {
    return column_->heldBytes();
  }

private:
  std::unique_ptr<FileColumn> column_;
  std::uint64_t first_;
};

/** Tuples that rows of a table hold several of: layers of a lattice. */
class LayeredColumn : public FileColumn {
public:
  LayeredColumn(std::unique_ptr<FileColumn> rows,
                std::uint64_t tuples_of_row,
                std::size_t tuple_bytes)
      : rows_(std::move(rows))
      , tuples_of_row_(tuples_of_row)
      , tuple_bytes_(tuple_bytes)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    while (count > 0) {
      const std::uint64_t row = first / tuples_of_row_, within = first % tuples_of_row_;
      if (row_.empty() || row != held_row_) {
        row_.resize(tuples_of_row_ * tuple_bytes_);
        rows_->read(row, 1, row_.data());
        held_row_ = row;
      }
      const auto now = static_cast<std::size_t>(
          std::min<std::uint64_t>(count, tuples_of_row_ - within));
      std::copy_n(row_.data() + within * tuple_bytes_, now * tuple_bytes_, tuples);
      first += now;
      count -= now;
      tuples += now * tuple_bytes_;
    }
  }

  std::uint64_t
  heldBytes() const override
  {
    return rows_->heldBytes() + tuples_of_row_ * tuple_bytes_;
  }

private:
  std::unique_ptr<FileColumn> rows_;
  std::uint64_t tuples_of_row_;
  std::size_t tuple_bytes_;
  std::uint64_t held_row_ = 0;
  std::vector<std::uint8_t> row_;
};

/** Where the points of an image are. */
struct Lattice {
  std::array<std::uint64_t, 3> sizes{};
  std::array<double, 3> first{}, origin{}, spacing{};
  std::array<double, 9> direction{{1, 0, 0, 0, 1, 0, 0, 0, 1}}; ///< row by row

  std::uint64_t
  countPoints() const
  {
    return sizes[0] * sizes[1] * sizes[2];
  }
};

/** Places of a lattice, x fastest. */
class LatticeColumn : public FileColumn {
public:
  explicit LatticeColumn(const Lattice& lattice)
      : lattice_(lattice)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    const auto& sizes = lattice_.sizes;
    for (std::uint64_t point = first; point < first + count; ++point) {
      const std::array<std::uint64_t, 3> steps{
          {point % sizes[0], point / sizes[0] % sizes[1], point / sizes[0] / sizes[1]}};
      for (std::size_t row = 0; row < 3; ++row) {
        double coordinate = lattice_.origin[row];
        for (std::size_t axis = 0; axis < 3; ++axis)
          coordinate += lattice_.direction[3 * row + axis] * lattice_.spacing[axis] *
                        (lattice_.first[axis] + static_cast<double>(steps[axis]));
        std::memcpy(tuples, &coordinate, sizeof(coordinate));
        tuples += sizeof(coordinate);
      }
    }
  }

private:
  Lattice lattice_;
};

/** The part of a file that its first time has. */
struct Step {
  std::uint64_t first_part = 0, parts = 0;
  std::uint64_t first_point = 0;
};

/** Reads a group of VTKHDF. */
class VtkHdfReader {
public:
  VtkHdfReader(const Hdf5File& file, std::string group)
      : file_(file)
      , path_(file.getPath())
      , group_(std::move(group))
  {
  }

  std::unique_ptr<RecordSource>
  openPoints();
  std::unique_ptr<RecordSource>
  openImage();
  std::vector<Triangle>
  readTriangles() const;
  void
  readCells(SampleTopology& topology) const;
  Lattice
  readLattice() const;

private:
  std::string
  inside(const std::string& name) const
  {
    return joinNames(group_, name);
  }
  std::vector<double>
  readNumbers(const std::string& name, std::uint64_t first, std::uint64_t count) const;
  std::vector<double>
  readEnds(const std::string& name, std::uint64_t first, std::uint64_t cells) const;
  std::uint64_t
  firstCount(const std::string& name) const;
  std::uint64_t
  readRows(const std::string& name) const;
  Step
  findStep() const;
  void
  addColumn(const std::string& name,
            const Hdf5Shape& shape,
            std::size_t components,
            std::unique_ptr<FileColumn> column);
  void
  addFields(std::uint64_t points);
  void
  addLayers(const Lattice& lattice);
  void
  noteCells();
  std::unique_ptr<RecordSource>
  open(std::uint64_t points)
  {
    return std::make_unique<ColumnSource>(
        points, std::move(columns_), std::move(notes_));
  }

  const Hdf5File& file_;
  const std::string& path_;
  std::string group_;
  std::vector<NamedColumn> columns_;
  std::vector<Message> notes_;
};

/** The numbers of a table of one per row.
 * \throws IOError where it has fewer */
std::vector<double>
VtkHdfReader::readNumbers(const std::string& name,
                          std::uint64_t first,
                          std::uint64_t count) const
{
  const std::string table = inside(name);
  const auto shape = file_.findShape(table);
  if (!shape || shape->components != 1 || first > shape->rows ||
      count > shape->rows - first)
    throwUnreadable(path_,
                    {"missing_part",
                     "the table " + quoteText(table) + " of " + std::to_string(count) +
                         " numbers"});
  const auto column = file_.openColumn(table);
  const std::size_t size = datatypeSize(shape->datatype);
  std::vector<std::uint8_t> bytes;
  std::vector<double> numbers;
  while (count > 0) {
    const auto now = static_cast<std::size_t>(std::min(count, numbers_at_once));
    bytes.resize(now * size);
    column->read(first, now, bytes.data());
    for (std::size_t i = 0; i < now; ++i)
      numbers.push_back(
          FieldComponent{0, shape->datatype}.read(bytes.data() + i * size));
    first += now;
    count -= now;
  }
  return numbers;
}

/** Where the cells of a part end among its corners. */
std::vector<double>
VtkHdfReader::readEnds(const std::string& name,
                       std::uint64_t first,
                       std::uint64_t cells) const
{
  std::vector<double> ends = readNumbers(name, first, cells + 1);
  if (ends[0] != 0.0)
    throwUnreadable(path_, {"disagreeing_parts", "the offsets of its cells"});
  ends.erase(ends.begin());
  return ends;
}

/** What a table of the first time begins with; 0 where there is none. */
std::uint64_t
VtkHdfReader::firstCount(const std::string& name) const
{
  if (!file_.findShape(inside(name)))
    return 0;
  const double number = readNumbers(name, 0, 1)[0];
  if (!(number >= 0.0 && number <= UINT32_MAX))
    throwUnreadable(path_, {"invalid_part", "the count of " + quoteText(inside(name))});
  return static_cast<std::uint64_t>(number);
}

std::uint64_t
VtkHdfReader::readRows(const std::string& name) const
{
  const auto shape = file_.findShape(inside(name));
  return shape ? shape->rows : 0;
}

Step
VtkHdfReader::findStep() const
{
  Step step;
  step.parts = readRows("NumberOfPoints");
  if (!file_.hasGroup(inside("Steps")))
    return step;
  if (file_.findShape(inside("Steps/NumberOfParts")))
    step.parts = firstCount("Steps/NumberOfParts");
  step.first_part = firstCount("Steps/PartOffsets");
  step.first_point = firstCount("Steps/PointOffsets");
  return step;
}

void
VtkHdfReader::addColumn(const std::string& name,
                        const Hdf5Shape& shape,
                        std::size_t components,
                        std::unique_ptr<FileColumn> column)
{
  std::string attribute = file_.readText(inside("PointData/" + name), "Attribute");
  std::transform(attribute.begin(),
                 attribute.end(),
                 attribute.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::vector<std::string> names{name};
  if (attribute == "normals" && components == normal_names.size())
    names.assign(normal_names.begin(), normal_names.end());
  columns_.push_back({std::move(names), shape.datatype, components, std::move(column)});
}

/** Data of the points of the first time. */
void
VtkHdfReader::addFields(std::uint64_t points)
{
  for (const std::string& name : file_.list(inside("PointData"))) {
    const std::string table = inside("PointData/" + name);
    const auto shape = file_.findShape(table);
    const std::uint64_t first = firstCount("Steps/PointDataOffsets/" + name);
    if (!shape)
      notes_.push_back({"array_without_numbers", {{"array", shortenText(name)}}});
    else if (shape->components > most_table_components)
      notes_.push_back(
          {"wide_array",
           {{"array", shortenText(name)}, {"components", shape->components}}});
    else if (first > shape->rows || points > shape->rows - first)
      notes_.push_back({"unfitting_array",
                        {{"array", shortenText(name)},
                         {"tuples", shape->rows},
                         {"points", points}}});
    else
      addColumn(name,
                *shape,
                static_cast<std::size_t>(shape->components),
                std::make_unique<ShiftedColumn>(file_.openColumn(table), first));
  }
}

void
VtkHdfReader::noteCells()
{
  if (file_.list(inside("PointData")).empty() &&
      !file_.list(inside("CellData")).empty())
    notes_.push_back({"only_cell_data", {}});
}

std::unique_ptr<RecordSource>
VtkHdfReader::openPoints()
{
  const std::string table = inside("Points");
  const auto shape = file_.findShape(table);
  if (!shape || shape->components != 3)
    throwUnreadable(
        path_,
        {"missing_part",
         "the table " + quoteText(table) + " of three coordinates per point"});
  const Step step = findStep();
  double points = 0.0;
  for (const double count : readNumbers("NumberOfPoints", step.first_part, step.parts))
    points += count >= 0.0 ? count : INFINITY;
  const bool is_series = file_.hasGroup(inside("Steps"));
  if (!(points <= UINT32_MAX) || step.first_point > shape->rows ||
      static_cast<std::uint64_t>(points) > shape->rows - step.first_point ||
      (!is_series && static_cast<std::uint64_t>(points) < shape->rows))
    throwUnreadable(path_,
                    {"wrong_count", quoteText(table), shape->rows, "points", points});
  const auto count = static_cast<std::uint64_t>(points);
  const auto steps = file_.readAttribute(inside("Steps"), "NSteps");
  if (!steps.empty() && steps[0] > 1.0)
    notes_.push_back({"first_time", {{"times", std::round(std::min(steps[0], 1e15))}}});
  columns_.push_back(
      {{"x", "y", "z"},
       shape->datatype,
       3,
       std::make_unique<ShiftedColumn>(file_.openColumn(table), step.first_point)});
  addFields(count);
  noteCells();
  return open(count);
}

Lattice
VtkHdfReader::readLattice() const
{
  const auto numbers = [&](const char* name, std::size_t count) {
    auto found = file_.readAttribute(group_, name);
    if (found.size() != count)
      throwUnreadable(path_,
                      {"missing_part",
                       std::string(name) + " of " + std::to_string(count) +
                           " numbers in its image"});
    return found;
  };
  Lattice lattice;
  const auto extent = numbers("WholeExtent", 6), origin = numbers("Origin", 3),
             spacing = numbers("Spacing", 3);
  std::uint64_t points = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = extent[2 * axis + 1] - extent[2 * axis] + 1.0;
    if (!(size >= 1.0 && size * static_cast<double>(points) <= UINT32_MAX))
      throwUnreadable(path_, {"invalid_part", "the extent of its image"});
    lattice.sizes[axis] = static_cast<std::uint64_t>(size);
    points *= lattice.sizes[axis];
    lattice.first[axis] = extent[2 * axis];
    lattice.origin[axis] = origin[axis];
    lattice.spacing[axis] = spacing[axis];
  }
  if (!file_.readAttribute(group_, "Direction").empty()) {
    const auto direction = numbers("Direction", 9);
    std::copy(direction.begin(), direction.end(), lattice.direction.begin());
  }
  return lattice;
}

/** Data of the points of an image, a layer of it in each row of a table. */
void
VtkHdfReader::addLayers(const Lattice& lattice)
{
  const std::uint64_t of_layer = lattice.sizes[0] * lattice.sizes[1];
  for (const std::string& name : file_.list(inside("PointData"))) {
    const std::string table = inside("PointData/" + name);
    const auto shape = file_.findShape(table);
    if (!shape)
      notes_.push_back({"array_without_numbers", {{"array", shortenText(name)}}});
    else if (shape->rows != lattice.sizes[2] || shape->components % of_layer != 0 ||
             shape->components / of_layer > most_table_components)
      notes_.push_back({"unfitting_layers",
                        {{"array", shortenText(name)},
                         {"layers", shape->rows},
                         {"numbers", shape->components},
                         {"needed", lattice.sizes[2]},
                         {"points", of_layer}}});
    else {
      const auto components = static_cast<std::size_t>(shape->components / of_layer);
      addColumn(
          name,
          *shape,
          components,
          std::make_unique<LayeredColumn>(file_.openColumn(table),
                                          of_layer,
                                          components * datatypeSize(shape->datatype)));
    }
  }
}

std::unique_ptr<RecordSource>
VtkHdfReader::openImage()
{
  if (file_.hasGroup(inside("Steps")))
    throwUnreadable(path_, {"several_times", "images", ".vti"});
  const Lattice lattice = readLattice();
  columns_.push_back(
      {{"x", "y", "z"}, Type::FLOAT64, 3, std::make_unique<LatticeColumn>(lattice)});
  noteCells();
  addLayers(lattice);
  if (columns_.size() == 1) // nothing but memory would bound the points
    throwUnreadable(path_, {"nothing_inside", "numbers at the points of its image"});
  return open(lattice.countPoints());
}

std::vector<Triangle>
VtkHdfReader::readTriangles() const
{
  if (file_.hasGroup(inside("Steps")))
    throwUnreadable(path_, {"several_times", "meshes", ".vtp"});
  const std::uint64_t parts = readRows("NumberOfPoints");
  const auto points = readNumbers("NumberOfPoints", 0, parts);
  std::vector<Triangle> triangles;
  if (!file_.hasGroup(inside("Polygons")))
    return triangles;
  const auto polygons = readNumbers("Polygons/NumberOfCells", 0, parts);
  std::uint64_t point = 0, end = 0, corner = 0;
  for (std::size_t part = 0; part < points.size(); ++part) {
    if (!(polygons[part] >= 0.0 && polygons[part] < 0x1p53))
      throwUnreadable(path_, {"invalid_part", "a count of its polygons"});
    const auto count = static_cast<std::uint64_t>(polygons[part]);
    const std::vector<double> ends = readEnds("Polygons/Offsets", end, count);
    end += count + 1;
    const std::uint64_t corners = countCorners(path_, ends);
    addFans(path_,
            ends,
            readNumbers("Polygons/Connectivity", corner, corners),
            static_cast<std::uint64_t>(points[part]),
            point,
            triangles);
    corner += corners;
    point += static_cast<std::uint64_t>(points[part]);
  }
  return triangles;
}

void
VtkHdfReader::readCells(SampleTopology& topology) const
{
  const Step step = findStep();
  const auto counts = [&](const char* name) {
    return readNumbers(name, step.first_part, step.parts);
  };
  const auto points = counts("NumberOfPoints"), cells = counts("NumberOfCells"),
             corners = counts("NumberOfConnectivityIds");
  std::uint64_t cell = firstCount("Steps/CellOffsets"),
                corner = firstCount("Steps/ConnectivityIdOffsets"), point = 0;
  std::uint64_t offset = cell + step.first_part; // each part has one more than cells
  for (std::size_t part = 0; part < points.size(); ++part) {
    for (const double count : {points[part], cells[part], corners[part]})
      if (!(count >= 0.0 && count <= UINT32_MAX))
        throwUnreadable(path_, {"invalid_part", "a count of its parts"});
    const auto cell_count = static_cast<std::uint64_t>(cells[part]),
               corner_count = static_cast<std::uint64_t>(corners[part]);
    const std::vector<double> ends = readEnds("Offsets", offset, cell_count);
    if (countCorners(path_, ends) != corner_count)
      throwUnreadable(path_, {"disagreeing_parts", "the offsets of its cells"});
    const std::uint64_t before = topology.corners.size();
    for (const double end : ends)
      topology.ends.push_back(before + static_cast<std::uint64_t>(end));
    for (const double type : readNumbers("Types", cell, cell_count)) {
      if (!(type >= 0.0 && type <= UINT8_MAX))
        throwUnreadable(path_, {"invalid_part", "a type of its cells"});
      topology.types.push_back(static_cast<unsigned char>(type));
    }
    for (const double own : readNumbers("Connectivity", corner, corner_count)) {
      if (!(own >= 0.0 && own < points[part]))
        throwUnreadable(path_, {"missing_target", "a cell", "a point"});
      topology.corners.push_back(point + static_cast<std::uint64_t>(own));
    }
    cell += cell_count;
    offset += cell_count + 1;
    corner += corner_count;
    point += static_cast<std::uint64_t>(points[part]);
  }
  topology.points = point;
}

bool
isReadType(const std::string& type)
{
  return type == "PolyData" || type == "UnstructuredGrid" || type == "ImageData";
}

[[noreturn]] void
throwOtherType(const Hdf5File& file, const std::string& group, const std::string& type)
{
  std::string part;
  for (const std::string& name : file.list(group))
    if (isReadType(file.readText(joinNames(group, name), "Type"))) {
      part = shortenText(joinNames(group, name));
      break;
    }
  throwUnreadable(file.getPath(),
                  {"vtkhdf_type", shortenText(type), !part.empty(), part});
}

} // namespace

std::unique_ptr<RecordSource>
openVtkHdf(const Hdf5File& file, const std::string& group)
{
  const std::string root = vtkhdf_group;
  const std::string type =
      group.compare(0, root.size(), root) == 0 ? file.readText(group, "Type") : "";
  if (type.empty())
    return nullptr;
  if (!isReadType(type))
    throwOtherType(file, group, type);
  VtkHdfReader reader(file, group);
  return type == "ImageData" ? reader.openImage() : reader.openPoints();
}

std::vector<Triangle>
readVtkHdfTriangles(const std::string& path)
{
  const Hdf5File file(path);
  if (file.readText(vtkhdf_group, "Type") != "PolyData")
    return {};
  return VtkHdfReader(file, vtkhdf_group).readTriangles();
}

SampleTopology
readVtkHdfTopology(const std::string& path)
{
  const Hdf5Name name = splitHdf5Name(path);
  const Hdf5File file(name.file);
  const std::string group = name.inside.empty() ? vtkhdf_group : name.inside;
  const std::string type = file.readText(group, "Type");
  const VtkHdfReader reader(file, group);
  SampleTopology topology;
  if (type == "ImageData") {
    const Lattice lattice = reader.readLattice();
    topology.lattices.push_back(lattice.sizes);
    topology.points = lattice.countPoints();
  }
  if (type == "UnstructuredGrid")
    reader.readCells(topology);
  return topology;
}

} // namespace io
} // namespace pcl_uvol
